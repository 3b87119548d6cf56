/**
 * The range of a map's colours: fitted to what is found, or held, and then its ends are fields to type in.
 *
 * Depth has two ends, in its unit, though the core takes a range of 1/Z; beside the truth it is a range of its own, for the
 * unit is another. Motion, residual and errors begin at 0 and have one end. What is no range is said in a sentence, and the
 * range stays as it was.
 */

import { announce, make } from "../dom";
import { store, type Ranges } from "../store";
import { text } from "../text";
import type { Legend } from "../worker/protocol";

const words = text.legend;

/** Ends that can be typed. The core takes what is within. */
const [LEAST, MOST] = [1e-4, 1e5];
/** The upper end of depth is at least so many times the lower. */
const APART = 1.001;

/** Ends in the legend's unit, the lower first where there are two. */
export type Ends = number[];

/** A map's range among those that are held. */
export interface Range {
  read: (ranges: Ranges) => Ends | null;
  write: (ranges: Ranges, ends: Ends | null) => Ranges;
  /** The ends as they are drawn. */
  drawn: Ends;
  /** What each end is called. */
  names: string[];
  unit: string;
}

/** The range of the map that a legend is of; `null` where its colours are always the same. */
export function rangeOf(legend: Legend, kind: string, compared: boolean): Range | null {
  const { hold, quantity, unit, form } = legend;
  if (!hold) return null;
  if (hold.span) {
    const key = compared ? "trueSpan" : "span";
    return {
      read: ({ [key]: span }) => span && inverse(span),
      write: (ranges, ends) => ({ ...ranges, [key]: ends && inverse(ends) }),
      drawn: inverse(hold.span),
      names: [words.nearest, words.farthest],
      unit: compared ? words.truthUnit : words.meanUnit,
    };
  }
  const names = [form === "arrow" ? words.longestArrow : words.fullColour(quantity)];
  if (hold.speed) {
    return {
      read: ({ speed }) => (speed === null ? null : [speed]),
      write: (ranges, ends) => ({ ...ranges, speed: ends?.[0] ?? null }),
      ...{ drawn: [hold.speed], names, unit },
    };
  }
  return {
    read: ({ most: { [kind]: most } }) => (most === undefined ? null : [most]),
    write: (ranges, ends) => {
      const { [kind]: _, ...others } = ranges.most;
      return { ...ranges, most: ends ? { ...others, [kind]: ends[0]! } : others };
    },
    ...{ drawn: [hold.most ?? 1], names, unit },
  };
}

/** Between Z and 1/Z, the lower end first. */
const inverse = ([one, other]: Ends): [number, number] => [1 / other!, 1 / one!];

/** Holds the range as it is drawn by then, or lets it follow what is found. */
export function holder(now: () => Range, id: string): HTMLButtonElement {
  const range = now();
  const held = range.read(store.state.ranges) !== null;
  const button = make(
    "button",
    { type: "button", id, "aria-pressed": String(held), title: held ? words.isHeld : words.isFree },
    words.hold,
    make("span", { class: "visually-hidden" }, ` ${words.holdWhat}`),
  );
  button.addEventListener("click", () => {
    store.update({ ranges: range.write(store.state.ranges, held ? null : now().drawn) });
  });
  return button;
}

/** A field for an end of a range that is held. */
export function field(range: Range, i: number, id: string): HTMLInputElement {
  const name = range.names[i]!;
  const label = range.unit ? `${name}, ${range.unit}` : name;
  const attributes = { type: "number", inputmode: "decimal", id, "aria-label": label };
  const input = make("input", { ...attributes, title: `${label}. ${words.howToType}` });
  fill(input, range, i);
  // By leaving the field and by the arrow keys.
  input.addEventListener("change", () => take(input, range, i));
  input.addEventListener("keydown", (event) => {
    if (event.key !== "Enter" && event.key !== "Escape") return;
    event.preventDefault();
    if (event.key === "Enter") take(input, range, i);
    else fill(input, range, i);
    input.select();
  });
  return input;
}

/** Writes the end that is held into its field. */
export function fill(input: HTMLInputElement, range: Range, i: number): void {
  const ends = range.read(store.state.ranges);
  const value = ends?.[i];
  if (value === undefined || !Number.isFinite(value)) return;
  input.defaultValue = plain(value);
  input.value = input.defaultValue;
  // The arrow keys take a step that is seen.
  const width = ends!.length > 1 ? ends![1]! - ends![0]! : value;
  input.step = String(10 ** Math.floor(Math.log10(width) - 1));
}

/** Whether somebody is at it. */
export const typedIn = (input: HTMLInputElement) => input.value !== input.defaultValue;

/** The last sentence on a range, to be taken down with the next that is good. */
let complaint = "";

function take(input: HTMLInputElement, range: Range, i: number): void {
  const { ranges } = store.state;
  const ends = range.read(ranges);
  if (!ends || (!typedIn(input) && !input.validity.badInput)) return;
  const wrong = wrongWith(input, range, ends, i);
  if (wrong) {
    complaint = wrong;
    store.update({ message: wrong });
    return fill(input, range, i);
  }
  const next = ends.with(i, Number(input.value));
  const message = store.state.message === complaint ? null : store.state.message;
  store.update({ ranges: range.write(ranges, next), message });
  fill(input, range, i);
  announce(
    words.rangeIs(
      next.map((end) => plain(end)),
      range.unit,
    ),
  );
}

/** What is wrong with what was typed, as a sentence; `null` where it is a range. */
function wrongWith(
  { value, validity }: HTMLInputElement,
  { names }: Range,
  ends: Ends,
  i: number,
): string | null {
  const name = names[i]!;
  if (validity.badInput) return words.noNumber(name);
  if (value.trim() === "") return words.empty(name);
  const typed = Number(value);
  if (!(typed >= LEAST && typed <= MOST)) {
    return words.outOfRange(name, plain(LEAST), String(MOST));
  }
  if (i === 0 && ends.length > 1 && typed * APART > ends[1]!) {
    return words.notLess(name, plain(typed), names[1]!, plain(ends[1]!));
  }
  if (i === 1 && typed < ends[0]! * APART) {
    return words.notMore(name, plain(typed), names[0]!, plain(ends[0]!));
  }
  return null;
}

/** As a field takes it. */
const plain = (value: number) => String(Number(value.toPrecision(4)));
