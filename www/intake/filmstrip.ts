/**
 * The filmstrip: two frames of a film are chosen, 1 and 2, with what moves between them measured.
 *
 * Until someone chooses the second frame by hand, one is proposed for each first.
 */

import { make } from "../dom";
import { percent } from "../format";
import { ask } from "../session";
import { store } from "../store";
import { later } from "../text/later";
import { sentence } from "../wording";
import type { Displacement } from "../worker/protocol";
import { button, openSheet } from "./dialog";
import type { Film } from "./film";
import { propose } from "./propose";
import { mountStrip } from "./strip";

/** Longer side of the pictures between which motion is measured, and of those that are looked at. */
const MEASURED = 320;
const SHOWN = 960;

type Side = 0 | 1;
const SIDES = [0, 1] as const;
const words = later.strip;

/** Opens the filmstrip at two frames, or at a proposal; `take` opens a pair and tells whether it is any good. */
export function openFilmstrip(
  film: Film,
  at: [number, number] | null,
  take: (at: [number, number]) => Promise<boolean>,
): void {
  const chosen: [number, number] = at ?? [0, Math.min(1, film.count - 1)];
  let active: Side = 0;
  let byHand = at !== null;
  /** Counts the choices, so that answers about earlier ones can be told. */
  let choices = 0;
  let open = true;

  const sheet = openSheet("filmstrip", words.title(film.name), () => {
    open = false;
  });
  const views = SIDES.map((side) => view(side, film, activate, (index) => choose(side, index)));
  const strip = mountStrip(film, (index) => choose(active, index));
  sheet.body.append(
    make("div", { class: "film-pair" }, views[0]!.element, views[1]!.element),
    strip.element,
    make("p", { class: "note" }, `${words.row} `, make("span", { class: "with-keys" }, words.keys)),
  );
  const proposing = button(words.propose, () => {
    byHand = false;
    look();
  });
  const cancel = button(words.cancel, () => sheet.close());
  const opening = button(words.open, openPair, "primary");
  sheet.foot.append(proposing, cancel, opening);
  sheet.dialog.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    if (event.key === "1" || event.key === "2") activate(event.key === "1" ? 0 : 1);
    else if (event.key === "," || event.key === ".") {
      choose(active, chosen[active] + (event.key === "," ? -1 : 1));
    } else return;
    event.preventDefault();
  });
  activate(0);
  SIDES.forEach(show);
  views[0]!.focus();
  look();

  /** Measures what is chosen, or first proposes a second frame. */
  function look(): void {
    const work = byHand ? tell() : proposeSecond();
    work.catch((error: Error) => open && sheet.say(sentence(error.message)));
  }

  function activate(side: Side): void {
    active = side;
    views.forEach((view, i) => view.mark(i === side));
  }

  function show(side: Side): void {
    views[side]!.show(chosen[side]);
    strip.mark(chosen);
    const same = chosen[0] === chosen[1];
    opening.disabled = same;
  }

  function choose(side: Side, index: number): void {
    const to = Math.max(0, Math.min(film.count - 1, index));
    if (to === chosen[side]) return;
    chosen[side] = to;
    choices += 1;
    activate(side);
    show(side);
    if (side === 1) byHand = true;
    look();
  }

  const measures = new Map<string, Promise<Displacement | null>>();

  function measured(first: number, second: number): Promise<Displacement | null> {
    const name = `${first} ${second}`;
    const known = measures.get(name);
    if (known) return known;
    const answer = measure(film, first, second);
    measures.set(name, answer);
    return answer;
  }

  /** Says what moves between the two frames that are chosen. */
  async function tell(): Promise<void> {
    const mine = choices;
    if (chosen[0] === chosen[1]) return sheet.say(words.same);
    sheet.say(words.measuring);
    // A hand that moves on needs no answer.
    await new Promise((next) => setTimeout(next, 150));
    if (!open || mine !== choices) return;
    const motion = await measured(chosen[0], chosen[1]);
    if (open && mine === choices) sheet.say(wording(motion));
  }

  async function proposeSecond(): Promise<void> {
    if (film.count < 2) return sheet.say(words.onlyOne);
    choices += 1;
    const mine = choices;
    sheet.say(words.looking);
    await new Promise((next) => setTimeout(next, 150));
    const stale = () => !open || mine !== choices;
    if (stale()) return;
    const first = chosen[0];
    const second = await propose(first, film.count, async (index) =>
      // Nobody waits for it any more: let the search end.
      stale() ? null : measured(first, index),
    );
    if (stale()) return;
    chosen[1] = second;
    show(1);
    await tell();
  }

  async function openPair(): Promise<void> {
    opening.disabled = true;
    sheet.say(words.opening);
    const good = await take([...chosen]).catch((error: Error) => {
      store.update({ message: error.message });
      return false;
    });
    if (good) sheet.close();
    else if (open) {
      sheet.say("");
      opening.disabled = false;
    }
  }
}

async function measure(film: Film, first: number, second: number): Promise<Displacement | null> {
  const pictures = [await film.picture(first, MEASURED), await film.picture(second, MEASURED)];
  const answer = await ask(null, async (service) => [
    await service.displacement(pictures[0]!, pictures[1]!),
  ]);
  pictures.forEach((picture) => picture.close());
  return answer?.[0] ?? null;
}

function wording(motion: Displacement | null): string {
  if (!motion) return words.sizes;
  const { share, verdict } = motion;
  switch (verdict) {
    case "fit":
      return words.fit(percent(share));
    case "small":
      return share < 0.0005 ? words.still : words.small(percent(share));
    case "large":
      return words.large;
  }
}

interface View {
  element: HTMLElement;
  show: (index: number) => void;
  mark: (on: boolean) => void;
  focus: () => void;
}

/** One of the two frames, large, with its slider and single steps. */
function view(
  side: Side,
  film: Film,
  activate: (side: Side) => void,
  choose: (index: number) => void,
): View {
  const name = words.frames[side];
  const canvas = make("canvas", { "aria-hidden": "true" });
  const when = make("span", { class: "when" });
  const radio = make("input", { type: "radio", name: "film-side", id: `film-side-${side}` });
  radio.addEventListener("change", () => activate(side));
  const number = make("b", { class: "film-number" }, String(side + 1));
  const head = make("label", { class: "film-head" }, radio, number, make("span", {}, name), when);
  const slider = make("input", { type: "range", min: 0, max: film.count - 1, step: 1 });
  slider.id = `film-slider-${side}`;
  slider.setAttribute("aria-label", name);
  slider.addEventListener("input", () => choose(Number(slider.value)));
  const step = (by: number, sign: string, name: string) => {
    const press = () => choose(Number(slider.value) + by);
    const element = button("", press, "icon-only");
    element.append(
      make("span", { "aria-hidden": "true" }, sign),
      make("span", { class: "visually-hidden" }, name),
    );
    return element;
  };
  const [earlier, later] = [step(-1, "‹", words.earlier(name)), step(1, "›", words.later(name))];
  canvas.addEventListener("click", () => activate(side));
  const element = make(
    "div",
    { class: "film-view" },
    head,
    canvas,
    make("div", { class: "film-steps" }, earlier, slider, later),
  );
  const draw = latest(async (index: number) => {
    const picture = await film.picture(index, SHOWN);
    canvas.width = picture.width;
    canvas.height = picture.height;
    canvas.getContext("2d")!.drawImage(picture, 0, 0);
    canvas.dataset["shown"] = String(index);
    picture.close();
  });
  return {
    element,
    show(index) {
      const place = words.place(index + 1, film.count);
      slider.value = String(index);
      slider.setAttribute("aria-valuetext", `${place}, ${film.label(index)}`);
      when.textContent = `${film.label(index)} · ${place}`;
      earlier.disabled = index === 0;
      later.disabled = index === film.count - 1;
      draw(index);
    },
    focus: () => slider.focus({ preventScroll: true }),
    mark(on) {
      radio.checked = on;
      element.classList.toggle("marked", on);
    },
  };
}

/** Does the latest only of what is asked for while it is at work. */
function latest<T>(work: (it: T) => Promise<void>): (it: T) => void {
  let wanted: { it: T } | null = null;
  let busy = false;
  return async (it) => {
    wanted = { it };
    if (busy) return;
    busy = true;
    while (wanted) {
      const { it: next }: { it: T } = wanted;
      wanted = null;
      await work(next).catch((error: Error) => store.update({ message: error.message }));
    }
    busy = false;
  };
}
