/** The built-in sequences and the pairs kept on this device, with a thumbnail each, and what the present one teaches. */

import { byId, make } from "../dom";
import { isOwn } from "../memory/names";
import { resume } from "../memory/remember";
import { playAgain } from "../recording/play";
import { thumbnailOf } from "../recording/recording";
import { openScene } from "../session";
import { store, type State } from "../store";
import { text } from "../text";

/** Stands for frames of the user's own in the list, until they have a name. */
const OWN = "";

export function mountSequence(): void {
  const select = byId<HTMLSelectElement>("scene");
  select.addEventListener("change", () => {
    const { memory } = store.state;
    const name = select.value;
    if (memory?.some(({ id }) => id === name)) void resume(name);
    // Where nothing has been found yet, the frame is what there is to see.
    else if (name !== OWN) void openScene(name);
  });
  // What was chosen last, though it may still be opening: arrow keys go on from there.
  const choosePresent = () => {
    const { source, opening, memory } = store.state;
    const shown = opening?.kind === "scene" ? opening : source;
    if (shown?.kind === "scene") select.value = shown.name;
    else select.value = memory?.find(({ id }) => isOwn(id))?.id ?? OWN;
  };
  store.watch(
    ({ catalogues, source, memory }) => [
      catalogues,
      source,
      memory
        ?.filter(({ id }) => isOwn(id))
        .map(({ id }) => id)
        .join(),
    ],
    (state) => {
      fill(select, state);
      choosePresent();
    },
  );
  store.watch(({ opening }) => [opening], choosePresent);
  store.watch(
    ({ title, lesson, width, height, source, focalFinding, focalFrom }) => [
      ...[title, lesson, width, height, source, focalFinding, focalFrom],
    ],
    ({ title, lesson, width, height, source, focalFinding, focalFrom }) => {
      byId("sequence-title").textContent = title;
      const note = source?.kind === "files" && source.note ? `${source.note} ` : "";
      byId("lesson").textContent =
        lesson ||
        (width > 0 ? note + text.sequence.size(width, height, focalFinding ?? focalFrom) : "");
    },
  );
  const replay = byId<HTMLButtonElement>("replay");
  replay.addEventListener("click", () => {
    const { source } = store.state;
    if (source?.kind === "scene") void playAgain(source);
  });
  store.watch(
    ({ source, frames, busy, running, playing }) => [source, frames, busy, running, playing],
    ({ source, frames, busy, running, playing }) => {
      replay.hidden = source?.kind !== "scene" || !thumbnailOf(source.name);
      replay.disabled = !frames || busy !== null || running || playing;
    },
  );
}

let addresses: string[] = [];

function fill(select: HTMLSelectElement, { catalogues, source, memory }: Readonly<State>): void {
  addresses.forEach((address) => URL.revokeObjectURL(address));
  addresses = [];
  const scenes = (catalogues?.scenes ?? []).map(({ name, title }) =>
    option(name, title, thumbnailOf(name)),
  );
  const own = (memory ?? []).filter(({ id }) => isOwn(id));
  const kept = own.map(({ id, title, thumbnail }) => {
    const address = thumbnail ? URL.createObjectURL(thumbnail) : undefined;
    if (address) addresses.push(address);
    return option(id, own.length > 1 ? title : text.sequence.own, address);
  });
  if (source?.kind === "files" && own.length === 0) kept.push(option(OWN, text.sequence.own));
  // Before the core has told what there is, the one that is playing.
  if (scenes.length === 0 && source?.kind === "scene") {
    scenes.push(option(source.name, store.state.title, thumbnailOf(source.name)));
  }
  select.replaceChildren(...kept, ...scenes);
}

/** Browsers that draw lists themselves show the picture, too; others the name alone. */
function option(value: string, title: string, thumbnail?: string): HTMLOptionElement {
  const element = make("option", { value, "aria-label": title });
  if (thumbnail) {
    element.append(
      make("img", { src: thumbnail, alt: "", width: 72, height: 54, loading: "lazy" }),
    );
  }
  element.append(make("span", {}, title));
  return element;
}
