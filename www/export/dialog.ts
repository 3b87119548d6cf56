/** Everything that can be taken away, in one place: each thing with a line on what it is, and all of it as one zip. */

import { make } from "../dom";
import { count } from "../format";
import { button, openSheet, type Sheet } from "../intake/dialog";
import { stagePicture } from "../stage/snapshot";
import { store } from "../store";
import { later } from "../text/later";
import { awaited, viewOf } from "../views";
import { bibliography, CITATIONS } from "./cite";
import { film, lengthOf, scenes } from "./film";
import { fileOf, missing, nameOf, pictureOf, shots, stem, type Bytes } from "./gather";
import { MEASURES, readme, SURFACE, type Item } from "./items";
import { zipper } from "./zip";

const { exporting, solveFilm } = later;

export function openExport(): void {
  const given = new AbortController();
  const sheet = openSheet("export-sheet", exporting.title, () => {
    given.abort();
    unwatch.forEach((end) => end());
  });
  const { body, foot, say } = sheet;
  sheet.dialog.classList.add("export");
  let working = false;
  /** One thing at a time; what it comes to is said. */
  const doing = (work: () => Promise<string | null>) => async () => {
    if (working) return say(exporting.oneAtATime);
    working = true;
    sheet.dialog.ariaBusy = "true";
    say(exporting.writing);
    let done: string | null = null;
    try {
      done = await work();
    } catch (error) {
      done = exporting.failed((error as Error).message);
    }
    working = false;
    sheet.dialog.ariaBusy = "false";
    say(done ?? "");
  };
  /** Of a result, and so out of reach where there is none. */
  const ofResult: HTMLButtonElement[] = [];
  const fromResult = (name: string, what: string, work: () => Promise<string | null>) => {
    const press = named(button(name, doing(work)), what);
    ofResult.push(press);
    return press;
  };

  const reason = make("p", { class: "note reason", role: "note" });
  const [picture, stage] = pictures(doing);
  const length = make("span");
  body.append(
    reason,
    section(
      exporting.pictures,
      row(picture.title, picture.line, picture.select, picture.press),
      row(exporting.stage, stage.line, stage.press),
    ),
    section(exporting.measurements, ...MEASURES.map((item) => rowOf(item))),
    section(exporting.surface, rowOf(SURFACE)),
    section(
      exporting.film,
      row(
        exporting.solve,
        length,
        fromResult("WebM", exporting.solve, () => filmed(sheet, given.signal)),
      ),
    ),
    section(exporting.cite, ...CITATIONS.map((one) => citation(one, say))),
  );
  const all = fromResult(exporting.everything, "", () => everything(sheet, given.signal));
  all.classList.add("primary");
  foot.append(make("p", { class: "note" }, exporting.inIt), all);

  const unwatch = [
    store.watch(
      ({ catalogues, playing, frames, started, running, timeline }) => [
        ...[catalogues, playing, frames, started, running, timeline],
      ],
      (state) => {
        const why = missing(state);
        reason.textContent = why;
        reason.hidden = why === "";
        for (const one of ofResult) one.disabled = why !== "";
        picture.fill();
        length.textContent = filmLine();
      },
    ),
    store.watch(
      ({ frames, view, viewParams, pictured }) => [frames, view, viewParams, pictured],
      (state) => (stage.press.disabled = !state.frames || awaited(state)),
    ),
  ];

  function rowOf({ title, line, files }: Item): HTMLElement {
    const presses = files.map(({ name, label }) =>
      fromResult(label, title, async () => saved(await fileOf(name), name)),
    );
    return row(title, line, ...presses);
  }
}

/** A button's name says of what, for those who hear it alone. */
function named(press: HTMLButtonElement, what: string): HTMLButtonElement {
  if (what) press.prepend(make("span", { class: "visually-hidden" }, `${what}: `));
  return press;
}

function section(title: string, ...rows: HTMLElement[]): HTMLElement {
  return make("section", { class: "export-group" }, make("h3", {}, title), ...rows);
}

function row(title: string | Node, line: string | Node, ...controls: HTMLElement[]): HTMLElement {
  return make(
    "div",
    { class: "export-row" },
    make("div", { class: "export-what" }, make("p", {}, title), make("p", { class: "note" }, line)),
    make("div", { class: "export-controls" }, ...controls),
  );
}

type Doing = (work: () => Promise<string | null>) => () => Promise<void>;

/** Any view at the frame's size, and the stage as it is on the screen. */
function pictures(doing: Doing) {
  const select = make("select", { id: "export-view" });
  const title = make("label", { for: select.id }, exporting.anyView);
  const press = named(
    button(
      "PNG",
      doing(async () => {
        const shot = shots(store.state).find((one) => nameOf(one) === select.value);
        return shot ? saved(await pictureOf(shot), nameOf(shot)) : null;
      }),
    ),
    exporting.anyView,
  );
  const fill = () => {
    const chosen = select.value || nameOf({ of: "found", kind: presentKind(), title: "" });
    const list = shots(store.state);
    select.replaceChildren(
      ...list.map((shot) =>
        make("option", { value: nameOf(shot), selected: nameOf(shot) === chosen }, shot.title),
      ),
    );
    press.disabled = list.length === 0;
  };
  const { view, width, height } = store.state;
  const whole = exporting.atSize(width, height);
  const stage = named(
    button(
      "PNG",
      doing(async () => {
        const blob = await stagePicture();
        return blob && savedAs(blob, `${stem(store.state)}-${view}.png`);
      }),
    ),
    exporting.stage,
  );
  stage.id = "save-view";
  const line = exporting.asOnScreen(viewOf(view).label);
  return [
    { select, title, press, fill, line: whole },
    { press: stage, line },
  ] as const;
}

/** The core's name of what is on the stage. */
function presentKind(): string {
  const { view, viewParams } = store.state;
  if (view === "relief") return "relief";
  return viewOf(view).kinds(viewParams)[0] ?? "segmentation";
}

function filmLine(): string {
  const list = scenes(store.state);
  if (list.length === 0) return solveFilm.noPasses;
  const seconds = Math.round(lengthOf(list));
  return solveFilm.about(list.length, seconds);
}

async function filmed({ say }: Sheet, signal: AbortSignal): Promise<string | null> {
  const made = await film(say, signal);
  return made instanceof Blob ? savedAs(made, `${stem(store.state)}-solve.webm`) : made;
}

async function everything({ say }: Sheet, signal: AbortSignal): Promise<string | null> {
  const { state } = store;
  const zip = await zipper();
  const add = async (name: string, get: () => Promise<Bytes | null>) => {
    if (signal.aborted) return false;
    say(exporting.writingFile(name));
    const bytes = await get();
    if (bytes) await zip.add(name, bytes);
    return bytes !== null;
  };
  for (const { name } of [...MEASURES, SURFACE].flatMap(({ files }) => files)) {
    if (!(await add(name, () => fileOf(name)))) return null;
  }
  for (const shot of shots(state)) {
    if (!(await add(`pictures/${nameOf(shot)}`, () => pictureOf(shot)))) return null;
  }
  const made = await film(say, signal);
  if (signal.aborted) return null;
  if (made instanceof Blob) await zip.add("solve.webm", new Uint8Array(await made.arrayBuffer()));
  const why = made instanceof Blob ? "" : (made ?? "");
  const text = (content: string) => new TextEncoder().encode(content);
  await zip.add("cite.bib", text(bibliography()));
  await zip.add("README.txt", text(readme(state.title, why)));
  return [savedAs(await zip.done(), `${stem(state)}.zip`), why].join(" ");
}

function citation(
  { id, title, bibtex }: (typeof CITATIONS)[number],
  say: (text: string) => void,
): HTMLElement {
  const text = make("pre", { id, role: "group", "aria-label": exporting.bibtex(title) }, bibtex);
  const copy = named(
    button(exporting.copy, async () => {
      try {
        await navigator.clipboard.writeText(bibtex);
        say(exporting.copied);
      } catch {
        // Not allowed, or no clipboard.
        getSelection()?.selectAllChildren(text);
        say(exporting.copyByHand);
      }
    }),
    title,
  );
  const what = row(title, "", copy);
  what.append(text);
  return what;
}

/** Says what was saved; `null` where there was nothing, which has been said. */
function saved(bytes: Bytes | null, name: string): string | null {
  return bytes && savedAs(new Blob([bytes]), `${stem(store.state)}-${name}`);
}

function savedAs(blob: Blob, name: string): string {
  const address = URL.createObjectURL(blob);
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 60_000);
  return exporting.saved(name, size(blob.size));
}

function size(bytes: number): string {
  if (bytes < 1e6) return exporting.kilobytes(count(Math.max(1, Math.round(bytes / 1e3))));
  return exporting.megabytes((bytes / 1e6).toFixed(1));
}
