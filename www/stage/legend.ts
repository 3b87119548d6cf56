/** Beside the stage: what the colours stand for, in numbers and units, as the core says. */

import { byId, make } from "../dom";
import { number, scale } from "../format";
import { store, type State } from "../store";
import { text } from "../text";
import { asks, awaited, comparing } from "../views";
import type { Legend } from "../worker/protocol";
import { field, fill, holder, rangeOf, typedIn, type Range } from "./range";

const words = text.legend;

export function mountLegend(): void {
  store.watch(
    ({ legends, pictured, view, viewParams, split, shapes, ranges }) => [
      ranges,
      legends,
      pictured,
      view,
      viewParams,
      split,
      shapes.length,
    ],
    show,
  );
}

/** A legend that stands there, and what it stands for but for its numbers. */
interface Shown {
  key: string;
  figure: HTMLElement;
  tell: (legend: Legend, range: Range | null) => void;
}

let shown: Shown[] = [];

function show(state: Readonly<State>): void {
  const wanted = asks(state);
  const compared = comparing(state);
  // Both halves of a divided stage may have the same.
  const seen = new Set<string>();
  const drawn = awaited(state) ? [] : state.legends.slice(0, wanted.length);
  const next = drawn.flatMap((legend, i) => {
    const same = JSON.stringify(legend);
    if (!legend || seen.has(same)) return [];
    seen.add(same);
    const [, kind] = wanted[i]!;
    const range = rangeOf(legend, kind, compared);
    const { form, quantity, unit, names, colours } = legend;
    const parts = form === "keys" ? [names, colours] : [];
    const key = JSON.stringify([
      ...[i, kind, form, quantity, unit, compared, parts],
      range?.read(state.ranges)?.length,
    ]);
    // Whoever is typing into one types on.
    const there = shown.find((one) => one.key === key);
    there?.tell(legend, range);
    return [there ?? { key, ...figureOf(legend, range, `${kind}-${i}`, compared) }];
  });
  const alike = next.length === shown.length && next.every((one, i) => one === shown[i]);
  shown = next;
  if (alike) return;
  const held = document.activeElement?.id ?? "";
  byId("legend").replaceChildren(...next.map(({ figure }) => figure));
  if (!held.startsWith("hold-")) return;
  // Two that follow by themselves may become one that is held.
  (document.getElementById(held) ?? byId("legend").querySelector("button"))?.focus();
}

function figureOf(
  legend: Legend,
  first: Range | null,
  id: string,
  compared: boolean,
): Omit<Shown, "key"> {
  const { form, quantity, unit } = legend;
  const depth = quantity === "Depth";
  const title =
    depth && compared
      ? words.depthInTruth
      : depth
        ? words.depthInMean
        : unit
          ? `${quantity}, ${unit}`
          : quantity;
  const name = make("figcaption", {}, quantity);
  const small = depth ? (compared ? words.truthUnit : words.meanUnit) : unit;
  if (small) name.append(make("small", {}, small));
  let range = first;
  const fields =
    range && range.read(store.state.ranges)
      ? range.names.map((_, i) => field(first!, i, `end-${id}-${i}`))
      : [];
  const { body, tell } = BODIES[form](legend, fields);
  const figure = make(
    "figure",
    { class: `scale-${form}${fields.length > 0 ? " held" : ""}`, title },
    ...[name, ...body],
  );
  if (range) figure.append(holder(() => range!, `hold-${id}`));
  return {
    figure,
    tell(legend, next) {
      tell(legend);
      range = next ?? range;
      for (const [i, input] of fields.entries()) if (!typedIn(input)) fill(input, range!, i);
    },
  };
}

/** What a legend is made of, with the fields of its ends, and what puts other numbers into it. */
interface Body {
  body: HTMLElement[];
  tell: (legend: Legend) => void;
}

const BODIES: Record<Legend["form"], (legend: Legend, fields: HTMLInputElement[]) => Body> = {
  ramp,
  wheel,
  arrow,
  keys,
};

/** The end of the ramp is up, or at the right where it lies. */
function ramp(legend: Legend, fields: HTMLInputElement[]): Body {
  const bar = make("div", { class: "ramp", "aria-hidden": "true" });
  const list = make("ol", { class: "marks" });
  const tell = ({ colours, marks }: Legend) => {
    bar.style.setProperty("--colours", colours.join(", "));
    const values = scale(marks.map(({ value }) => value));
    list.replaceChildren(
      ...marks.map(({ at }, i) => {
        const mark = make("li", {}, values[i]!);
        mark.style.setProperty("--at", String(at));
        return mark;
      }),
    );
  };
  tell(legend);
  const body = make("div", { class: "ramp-body" }, bar, list);
  const [end, start] = fields;
  end?.classList.add("end");
  start?.classList.add("start");
  return { body: [end, body, start].filter((one) => one !== undefined), tell };
}

/** From right clockwise; white is rest. */
function wheel(legend: Legend, [rim]: HTMLInputElement[]): Body {
  const disc = make("div", { class: "wheel", "aria-hidden": "true" });
  const told = make("p", { title: words.rimTitle });
  const tell = ({ colours, marks }: Legend) => {
    disc.style.setProperty("--colours", [...colours, colours[0] ?? "white"].join(", "));
    if (!rim) told.textContent = words.rim(number(marks.at(-1)?.value ?? 0, 2));
  };
  tell(legend);
  if (rim) told.append(words.rim(""), rim);
  return { body: [make("div", { class: "wheel-body" }, disc, told)], tell };
}

function arrow(legend: Legend, [end]: HTMLInputElement[]): Body {
  const told = make("p", { class: "longest" });
  const tell = ({ marks }: Legend) => {
    if (!end) told.textContent = words.longest(number(marks[0]?.value ?? 0, 2));
  };
  tell(legend);
  if (end) told.append(words.longest(""), end);
  return { body: [told], tell };
}

function keys({ colours, names }: Legend): Body {
  const list = colours.map((colour, label) => {
    const chip = make("span", { class: "chip", "aria-hidden": "true" });
    chip.style.background = colour;
    const region = label === 0 ? words.background : words.curve(label);
    return make("li", {}, chip, names[label] ?? region);
  });
  return { body: [make("ul", {}, ...list)], tell: () => {} };
}
