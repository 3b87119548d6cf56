/** Beside the stage: what the colours stand for, in numbers and units, as the core says. */

import { byId, make } from "../dom";
import { number, scale } from "../format";
import { store, type State } from "../store";
import { text } from "../text";
import { asks, awaited, comparing } from "../views";
import type { Legend } from "../worker/protocol";

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

function show(state: Readonly<State>): void {
  const place = byId("legend");
  const wanted = asks(state);
  // Both halves of a divided stage may have the same.
  const seen = new Set<string>();
  const drawn = awaited(state) ? [] : state.legends.slice(0, wanted.length);
  const elements = drawn.flatMap((legend, i) => {
    const text = JSON.stringify(legend);
    if (!legend || seen.has(text)) return [];
    seen.add(text);
    return [element(legend, wanted[i]![1], comparing(state))];
  });
  const held = document.activeElement?.id ?? "";
  place.replaceChildren(...elements);
  if (held.startsWith("hold-")) document.getElementById(held)?.focus();
}

function element(legend: Legend, kind: string, compared: boolean): HTMLElement {
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
  const figure = make("figure", { class: `scale-${form}`, title }, name);
  switch (form) {
    case "ramp":
      figure.append(ramp(legend));
      break;
    case "wheel":
      figure.append(wheel(legend));
      break;
    case "arrow":
      figure.append(make("p", {}, words.longest(number(legend.marks[0]?.value ?? 0, 2))));
      break;
    case "keys":
      figure.append(keys(legend));
      break;
  }
  // Beside the truth the range is the truth's.
  if (legend.hold && (legend.hold.most !== null || !compared)) figure.append(holder(legend, kind));
  return figure;
}

/** Holds the range as it is, so that passes can be compared, or lets it follow what is found. */
function holder({ hold }: Legend, kind: string): HTMLElement {
  const { ranges } = store.state;
  const { span, speed, most } = hold!;
  const held = span
    ? ranges.span !== null
    : speed
      ? ranges.speed !== null
      : ranges.most[kind] !== undefined;
  const button = make(
    "button",
    { type: "button", id: `hold-${kind}`, "aria-pressed": String(held) },
    words.hold,
    make("span", { class: "visually-hidden" }, ` ${words.holdWhat}`),
  );
  button.title = held ? words.isHeld : words.isFree;
  button.addEventListener("click", () => {
    const { [kind]: _, ...others } = ranges.most;
    store.update({
      ranges: span
        ? { ...ranges, span: held ? null : span }
        : speed
          ? { ...ranges, speed: held ? null : speed }
          : { ...ranges, most: held || most === null ? others : { ...others, [kind]: most } },
    });
  });
  return button;
}

/** The end of the ramp is up, or at the right where it lies. */
function ramp({ colours, marks }: Legend): HTMLElement {
  const bar = make("div", { class: "ramp", "aria-hidden": "true" });
  bar.style.setProperty("--colours", colours.join(", "));
  const list = make("ol", { class: "marks" });
  const values = scale(marks.map(({ value }) => value));
  for (const [i, { at }] of marks.entries()) {
    const mark = make("li", {}, values[i]!);
    mark.style.setProperty("--at", String(at));
    list.append(mark);
  }
  return make("div", { class: "ramp-body" }, bar, list);
}

/** From right clockwise; white is rest. */
function wheel({ colours, marks }: Legend): HTMLElement {
  const disc = make("div", { class: "wheel", "aria-hidden": "true" });
  disc.style.setProperty("--colours", [...colours, colours[0] ?? "white"].join(", "));
  const full = marks.at(-1)?.value ?? 0;
  return make(
    "div",
    { class: "wheel-body" },
    disc,
    make("p", { title: words.rimTitle }, words.rim(number(full, 2))),
  );
}

function keys({ colours, names }: Legend): HTMLElement {
  return make(
    "ul",
    {},
    ...colours.map((colour, label) => {
      const chip = make("span", { class: "chip", "aria-hidden": "true" });
      chip.style.background = colour;
      const region = label === 0 ? words.background : words.curve(label);
      return make("li", {}, chip, names[label] ?? region);
    }),
  );
}
