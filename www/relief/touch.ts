/** A finger scrolls the page until it has tapped the relief; then it turns it, until something else is tapped. */

import { make } from "../dom";
import { text } from "../text";

export function mountTouch(place: HTMLElement): void {
  const note = make("p", { class: "tap", "aria-hidden": "true" }, text.relief.tap);
  place.append(note);
  const hold = (held: boolean) => place.classList.toggle("held", held);
  // Before the controls of the eye hear of it.
  place.addEventListener(
    "pointerdown",
    (event) => {
      const scrolls = event.pointerType === "touch" && !place.classList.contains("held");
      if (scrolls && event.target instanceof HTMLCanvasElement) event.stopPropagation();
    },
    { capture: true },
  );
  place.addEventListener("click", ({ target }) => {
    if (target instanceof HTMLCanvasElement) hold(true);
  });
  document.addEventListener("pointerdown", (event) => {
    if (!place.contains(event.target as Node)) hold(false);
  });
}
