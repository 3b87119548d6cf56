/** A row of pictures along a film, evenly spaced, with the two chosen frames marked on it. */

import { make } from "../dom";
import { later } from "../text/later";
import type { Film } from "./film";

const words = later.strip;

/** Width that a picture takes at least, and that it is fetched at, pixels. */
const LEAST = 78;
const FETCHED = 160;
const MOST = 14;

export interface Strip {
  element: HTMLElement;
  mark: (chosen: readonly [number, number]) => void;
}

export function mountStrip(film: Film, choose: (index: number) => void): Strip {
  const room = Math.floor((Math.min(innerWidth, 1100) - 32) / LEAST);
  const shown = Math.max(2, Math.min(film.count, MOST, room));
  const last = Math.max(1, shown - 1);
  const indices = Array.from({ length: Math.min(shown, film.count) }, (_, i) =>
    Math.round((i * (film.count - 1)) / last),
  );
  const buttons = indices.map((index) => {
    const canvas = make("canvas", { "aria-hidden": "true" });
    const element = make("button", { type: "button", tabindex: -1 }, canvas);
    element.addEventListener("click", () => choose(index));
    return { index, canvas, element };
  });
  const flags = [1, 2].map((n) =>
    make("b", { class: "film-flag film-number", "aria-hidden": "true" }, String(n)),
  );
  const element = make("div", { class: "film-strip", role: "group", "aria-label": words.film });
  element.append(...buttons.map((one) => one.element), ...flags);
  if (buttons[0]) buttons[0].element.tabIndex = 0;
  element.addEventListener("keydown", (event) => {
    const at = buttons.findIndex((one) => one.element === document.activeElement);
    const to = { ArrowLeft: at - 1, ArrowRight: at + 1, Home: 0, End: buttons.length - 1 }[
      event.key
    ];
    const next = to === undefined ? undefined : buttons[to];
    if (at < 0 || !next) return;
    event.preventDefault();
    buttons[at]!.element.tabIndex = -1;
    next.element.tabIndex = 0;
    next.element.focus();
  });
  void fill();

  async function fill(): Promise<void> {
    for (const { index, canvas } of buttons) {
      // Closed meanwhile: nobody looks.
      if (!element.isConnected && canvas.isConnected) return;
      const picture = await film.picture(index, FETCHED).catch(() => null);
      if (!picture) continue;
      canvas.width = picture.width;
      canvas.height = picture.height;
      canvas.getContext("2d")!.drawImage(picture, 0, 0);
      picture.close();
    }
  }

  return {
    element,
    mark(chosen) {
      for (const { index, element } of buttons) {
        const said = [words.frame(index + 1, film.label(index))];
        if (index === chosen[0]) said.push(words.isFirst);
        if (index === chosen[1]) said.push(words.isSecond);
        element.setAttribute("aria-label", said.join(", "));
      }
      const same = chosen[0] === chosen[1];
      for (const [side, flag] of flags.entries()) {
        // Above the middle of its picture, or where it lies between two.
        const along = film.count > 1 ? chosen[side]! / (film.count - 1) : 0;
        const share = (along * (buttons.length - 1) + 0.5) / Math.max(1, buttons.length);
        flag.style.setProperty("--along", `${100 * share}%`);
        flag.classList.toggle(
          "beside",
          same || Math.abs(chosen[0] - chosen[1]) / film.count < 0.03,
        );
      }
    },
  };
}
