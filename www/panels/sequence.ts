/** The built-in sequences, and what the present one teaches. */

import { byId, make } from "../dom";
import { openScene } from "../session";
import { store } from "../store";

/** Stands for frames of the user's own in the list. */
const OWN = "";

export function mountSequence(): void {
  const select = byId<HTMLSelectElement>("scene");
  select.addEventListener("change", () => {
    if (select.value !== OWN) void openScene(select.value);
  });
  // What was chosen last, though it may still be opening: arrow keys go on from there.
  const choosePresent = () => {
    const { source, opening } = store.state;
    const shown = opening?.kind === "scene" ? opening : source;
    select.value = shown?.kind === "scene" ? shown.name : OWN;
  };
  store.watch(
    ({ catalogues, source }) => [catalogues, source],
    ({ catalogues, source }) => {
      const options = (catalogues?.scenes ?? []).map(({ name, title }) =>
        make("option", { value: name }, title),
      );
      if (source?.kind === "files")
        options.unshift(make("option", { value: OWN }, "Your own frames"));
      select.replaceChildren(...options);
      choosePresent();
    },
  );
  store.watch(({ opening }) => [opening], choosePresent);
  store.watch(
    ({ title, lesson, width, height, source }) => [title, lesson, width, height, source],
    ({ title, lesson, width, height, source }) => {
      byId("sequence-title").textContent = title;
      const note = source?.kind === "files" && source.note ? `${source.note} ` : "";
      byId("lesson").textContent =
        lesson ||
        (width > 0
          ? `${note}${width} × ${height} pixels. Set the camera's focal length if you know it, or have it found.`
          : "");
    },
  );
}
