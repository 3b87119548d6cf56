/** The two frames: which they are, and how one brings one's own (picker, drop, paste, camera). */

import { byId, icon, make } from "../dom";
import { chooseFrom, keep } from "../intake/reel";
import { inUse, openBoth, swap, takeFields } from "../intake/slots";
import { takeAll } from "../intake/take";
import { ENDINGS, takeSaid } from "../intake/truth";
import { ask } from "../session";
import { store, type Slot, type State } from "../store";
import { text } from "../text";

const words = text.frames;

// Formats that no browser has a media type for, by their endings.
const ACCEPT = `${ENDINGS},image/*,video/*,.pnm,.pgm,.ppm,.pbm,.pam,.mpo,.heic,.heif,.jxl,.mkv,.mov`;

export function mountFrames(): void {
  store.watch(
    ({ frames, slots, names, source, truth }) => [frames, slots, names, source, truth],
    render,
  );
  mountSources();
  mountPopover();
  mountDrop();
  document.addEventListener("paste", (event) => {
    const files = [...(event.clipboardData?.files ?? [])];
    if (files.length === 0) return;
    event.preventDefault();
    void takeAll(files, null);
  });
}

/** Stays open while a frame is missing, and goes once both are on the stage. */
function mountPopover(): void {
  const popover = byId("frames-panel");
  store.watch(
    ({ slots, source }) => [slots, source],
    (state) => {
      const [first, second] = state.slots;
      const missing = (first === null) !== (second === null);
      // A sequence or a pair that has been opened needs no more.
      if (missing || inUse(state) || (!first && !second)) popover.togglePopover(missing);
    },
  );
}

/** Where frames come from beside the two places: a clip or many pictures, the camera, the film at hand. */
function mountSources(): void {
  const input = byId<HTMLInputElement>("film-file");
  input.accept = ACCEPT;
  input.addEventListener("change", () => {
    void takeAll([...(input.files ?? [])], null);
    // The same file may be chosen again.
    input.value = "";
  });
  const truth = byId<HTMLInputElement>("truth-file");
  truth.accept = `${ENDINGS},.png`;
  truth.addEventListener("change", () => {
    void takeSaid([...(truth.files ?? [])]);
    truth.value = "";
  });
  store.watch(
    ({ source, slots }) => [source, slots],
    (state) => {
      byId("truth-pick").hidden = !inUse(state);
    },
  );
  byId("camera-open").addEventListener("click", async () => {
    const loaded = await ask(words.openingCamera, () => import("../intake/camera"));
    await loaded?.openCamera((film) => {
      keep(film);
      void chooseFrom(film);
    });
  });
  const again = byId("film-again");
  again.addEventListener("click", () => {
    const { reel } = store.state;
    if (reel) void chooseFrom(reel.film);
  });
  store.watch(
    ({ reel }) => [reel?.film],
    ({ reel }) => {
      again.hidden = reel === null;
    },
  );
}

function render(state: Readonly<State>): void {
  const { slots } = state;
  const own = slots[0] !== null || slots[1] !== null;
  const cards = ([0, 1] as const).map((side) => card(side, state, own));
  const swapper = make("button", { type: "button", class: "quiet icon-only", id: "swap" });
  swapper.append(icon("swap"), make("span", { class: "visually-hidden" }, words.swap));
  swapper.disabled = !own;
  swapper.addEventListener("click", () => void swap());
  const held = document.activeElement?.id;
  byId("slots").replaceChildren(cards[0]!, swapper, cards[1]!);
  if (held) document.getElementById(held)?.focus();
  const note = byId("slots-note");
  note.replaceChildren(explain(state, own));
  const interlaced = slots.find((slot) => slot?.interlaced);
  if (interlaced) {
    note.append(" ", words.interlaced(interlaced.name), " ", fieldsButton("fields", interlaced));
  }
  if (!own || inUse(state)) return;
  const discard = () => store.update({ slots: [null, null] });
  if (slots[0] && slots[1])
    note.append(
      " ",
      button("use", words.use, () => openBoth()),
    );
  note.append(" ", button("discard", words.discard, discard));
}

/** Offers the two moments of an interlaced frame. */
export const fieldsButton = (id: string, frame: Slot): HTMLElement =>
  button(id, words.takeFields, () => takeFields(frame));

function button(id: string, name: string, press: () => unknown): HTMLElement {
  const element = make("button", { type: "button", class: "quiet", id }, name);
  element.addEventListener("click", () => void press());
  return element;
}

function explain(state: Readonly<State>, own: boolean): string {
  const { slots, title } = state;
  if (!own) return words.bring;
  if (!slots[0] || !slots[1]) return words.missing(slots[0] ? 1 : 0, title);
  return inUse(state) ? words.inUse(truthNote(state)) : words.unused(title);
}

/** What is known to be true of them. */
function truthNote({ source, truth }: Readonly<State>): string {
  if (!truth || source?.kind !== "files" || !source.truth) return words.truthWanted;
  return words.truthFrom(source.truth.map(({ name }) => name).join(", "));
}

function card(side: 0 | 1, state: Readonly<State>, own: boolean): HTMLElement {
  const title = words.titles[side];
  const slot = state.slots[side];
  const picture = own ? slot?.picture : state.frames?.[side];
  const input = make("input", { type: "file", accept: ACCEPT, id: `file-${side}` });
  input.addEventListener("change", () => void takeAll([...(input.files ?? [])], side));
  input.multiple = true;
  const size = slot ? ` · ${slot.width}×${slot.height}` : "";
  return make(
    "div",
    { class: "slot" },
    make("h3", {}, title),
    // The frames of a sequence are on their way; one's own are still to be brought.
    picture ? thumbnail(picture) : make("div", { class: "empty" }, own ? words.empty : "…"),
    own
      ? make("span", { class: "name", title: slot?.name }, slot ? slot.name + size : "\u00a0")
      : null,
    make(
      "label",
      { class: "pick" },
      input,
      make("span", { class: "visually-hidden" }, `${title}: `),
      make("span", {}, words.choose),
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
  /** As far as a browser tells before the drop. */
  const holdsMany = (event: DragEvent) => {
    const types = [...(event.dataTransfer?.items ?? [])].map(({ type }) => type);
    return types.length > 2 || types.some((type) => /^video\/|^image\/gif/.test(type));
  };
  const mark = (side: number | null) =>
    sides.forEach((element, i) => element.classList.toggle("over", i === side));

  document.addEventListener("dragover", (event) => {
    if (!carriesFiles(event)) return;
    event.preventDefault();
    zone.hidden = false;
    const many = holdsMany(event);
    zone.classList.toggle("many", many);
    sides[0]!.textContent = many ? words.dropMany : words.titles[0];
    mark(many ? 0 : sideAt(event));
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
