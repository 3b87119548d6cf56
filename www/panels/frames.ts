/**
 * The two frames: which they are, and how one brings one's own (picker, drop, paste).
 *
 * A first or second frame of one's own waits in its slot until its partner is there; only then are
 * both opened together, and until they prove good the stage keeps what it shows.
 */

import { byId, icon, make } from "../dom";
import { ask, open, overtaken } from "../session";
import { store, type Slot, type State } from "../store";

const ACCEPT = "image/png,image/jpeg,image/webp,image/bmp,image/tiff,.pnm,.pgm,.ppm,.pbm,.pam,.tif";

export function mountFrames(): void {
  store.watch(({ frames, slots, names, source }) => [frames, slots, names, source], render);
  mountDrop();
  document.addEventListener("paste", (event) => {
    const files = [...(event.clipboardData?.files ?? [])];
    if (files.length === 0) return;
    event.preventDefault();
    void takeAll(files, null);
  });
}

/** What was on the stage, or about to be, when files were chosen. */
type Before = Parameters<typeof overtaken>[0];

let taking: Promise<void> = Promise.resolve();

/** One file goes to `side` or the first empty slot; of several, the first two by name. One lot after another. */
function takeAll(files: File[], side: 0 | 1 | null): Promise<void> {
  const { source, opening } = store.state;
  taking = taking.then(() => takeLot(files, side, { source, opening }));
  return taking;
}

async function takeLot(files: File[], side: 0 | 1 | null, then: Before): Promise<void> {
  const chosen = files
    .toSorted((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }))
    .slice(0, 2);
  if (chosen.length === 0) return;
  const at = chosen.length === 2 ? 0 : (side ?? (store.state.slots[0] ? 1 : 0));
  // All are read before any takes its slot: beside one that is no image, its partner would be
  // paired with an older frame.
  const taken: Slot[] = [];
  for (const [i, file] of chosen.entries()) {
    const slot = await take(file, at + i === 0 ? "first frame" : "second frame");
    if (!slot) return;
    taken.push(slot);
  }
  store.update({
    slots: store.state.slots.toSpliced(at, taken.length, ...taken) as State["slots"],
  });
  // A sequence chosen while files were read is what is wanted.
  if (!overtaken(then)) await openBoth();
}

async function take(file: File, unnamed: string): Promise<Slot | null> {
  const name = file.name || unnamed;
  return ask(`Reading ${name}`, async (service) => {
    const bytes = new Uint8Array(await file.arrayBuffer().catch(() => gone(name)));
    return { name, bytes, ...(await service.preview({ name, bytes })) };
  });
}

function gone(name: string): never {
  throw new Error(`${name} cannot be read; it may be a folder, or have been moved or deleted`);
}

async function openBoth(): Promise<void> {
  const [first, second] = store.state.slots;
  if (!first || !second) return;
  // Copies, since the worker may be restarted and need them again.
  const file = ({ name, bytes }: Slot) => ({ name, bytes });
  await open({ kind: "files", first: file(first), second: file(second) }, "Opening your frames");
}

async function swap(): Promise<void> {
  const [first, second] = store.state.slots;
  store.update({ slots: [second, first] });
  await openBoth();
}

/** Whether the pair on the stage is the one in the slots. */
function inUse({ source, slots }: Readonly<State>): boolean {
  return (
    source?.kind === "files" &&
    source.first.bytes === slots[0]?.bytes &&
    source.second.bytes === slots[1]?.bytes
  );
}

function render(state: Readonly<State>): void {
  const { slots } = state;
  const own = slots[0] !== null || slots[1] !== null;
  const cards = ([0, 1] as const).map((side) => card(side, state, own));
  const swapper = make("button", { type: "button", class: "quiet icon-only", id: "swap" });
  swapper.append(icon("swap"), make("span", { class: "visually-hidden" }, "Swap the two frames"));
  swapper.disabled = !own;
  swapper.addEventListener("click", () => void swap());
  const held = document.activeElement?.id;
  byId("slots").replaceChildren(cards[0]!, swapper, cards[1]!);
  if (held) document.getElementById(held)?.focus();
  const note = byId("slots-note");
  note.replaceChildren(explain(state, own));
  if (!own || inUse(state)) return;
  const discard = () => store.update({ slots: [null, null] });
  if (slots[0] && slots[1]) note.append(" ", button("use", "Use them", openBoth));
  note.append(" ", button("discard", "Discard", discard));
}

function button(id: string, name: string, press: () => unknown): HTMLElement {
  const element = make("button", { type: "button", class: "quiet", id }, name);
  element.addEventListener("click", () => void press());
  return element;
}

function explain(state: Readonly<State>, own: boolean): string {
  if (!own) {
    return "Bring your own: choose, drop or paste two frames of one film, taken shortly after each other.";
  }
  const missing = state.slots[0] ? (state.slots[1] ? null : "second") : "first";
  if (missing) {
    return `The ${missing} frame is still missing. Until it is there, the stage keeps ${state.title || "what it shows"}.`;
  }
  return inUse(state)
    ? "These are your frames. Draw or find a curve on each thing that moves by itself, then run."
    : `These two are not in use; the stage keeps ${state.title}.`;
}

function card(side: 0 | 1, state: Readonly<State>, own: boolean): HTMLElement {
  const title = side === 0 ? "First" : "Second";
  const slot = state.slots[side];
  const picture = own ? slot?.picture : state.frames?.[side];
  const input = make("input", { type: "file", accept: ACCEPT, id: `file-${side}` });
  input.addEventListener("change", () => void takeAll([...(input.files ?? [])], side));
  input.multiple = true;
  const size = slot ? ` · ${slot.width}×${slot.height}` : "";
  return make(
    "div",
    { class: "slot" },
    make("h3", {}, `${title} frame`),
    picture ? thumbnail(picture) : make("div", { class: "empty" }, "missing"),
    own
      ? make("span", { class: "name", title: slot?.name }, slot ? slot.name + size : "\u00a0")
      : null,
    make(
      "label",
      { class: "pick" },
      input,
      make("span", { class: "visually-hidden" }, `${title} frame: `),
      make("span", {}, "Choose…"),
    ),
  );
}

function thumbnail(picture: ImageBitmap): HTMLCanvasElement {
  const canvas = make("canvas", { "aria-hidden": "true" });
  const factor = Math.min(1, 256 / Math.max(picture.width, picture.height, 1));
  canvas.width = Math.max(1, Math.round(picture.width * factor));
  canvas.height = Math.max(1, Math.round(picture.height * factor));
  if (picture.width > 0) {
    canvas.getContext("2d")!.drawImage(picture, 0, 0, canvas.width, canvas.height);
  }
  return canvas;
}

function mountDrop(): void {
  const zone = byId("dropzone");
  const sides = [...zone.querySelectorAll<HTMLElement>("[data-slot]")];
  const carriesFiles = (event: DragEvent) => event.dataTransfer?.types.includes("Files") ?? false;
  const sideAt = (event: DragEvent): 0 | 1 => {
    const box = zone.getBoundingClientRect();
    return event.clientX < box.left + box.width / 2 ? 0 : 1;
  };
  const mark = (side: number | null) =>
    sides.forEach((element, i) => element.classList.toggle("over", i === side));

  document.addEventListener("dragover", (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    zone.hidden = false;
    mark(sideAt(event));
  });
  document.addEventListener("dragleave", (event) => {
    if (event.relatedTarget === null) zone.hidden = true;
  });
  document.addEventListener("drop", (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    const side = sideAt(event);
    zone.hidden = true;
    void takeAll([...event.dataTransfer!.files], side);
  });
}
