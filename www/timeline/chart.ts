/**
 * The energy along the timeline.
 *
 * Energies compare between two breaks only: each stretch between two has a height of its own, full at its greatest and low
 * at its least energy. Two lines that have a stretch from the same break on share its height.
 */

import { lengthOf, type Line, type Timeline } from "./line";
import { text } from "../text";
import { scaleName } from "./sentences";

const SPACE = "http://www.w3.org/2000/svg";
/** Units across and down; the drawing is stretched to its place. */
const [WIDE, HIGH] = [1000, 100];
/** Of the height, what a stretch takes. */
const [TOP, BOTTOM] = [14, 84];
/** With more passes dots would run into each other. */
const MOST_DOTS = 90;

interface Point {
  at: number;
  energy: number;
}

/** Passes whose energies compare. */
interface Stretch {
  start: number;
  points: Point[];
}

export function stretchesOf({ first }: Timeline, line: Line): Stretch[] {
  const stretches: Stretch[] = [];
  for (const [i, energy] of line.energies.entries()) {
    const at = first + 1 + i;
    const begins = i === 0 || line.breaks.includes(at - 1);
    if (begins) stretches.push({ start: at - 1, points: [] });
    stretches.at(-1)!.points.push({ at, energy });
  }
  return stretches;
}

/** Draws the lines. */
export function drawChart(svg: SVGSVGElement, timeline: Timeline, current: number): void {
  const { first, lines } = timeline;
  const length = Math.max(1, lengthOf(timeline) - first);
  const across = (at: number) => (WIDE * (at - first)) / length;
  const all = lines.map((line) => stretchesOf(timeline, line));
  const ranges = new Map<number, [number, number]>();
  for (const { start, points } of all.flat()) {
    const energies = points.map(({ energy }) => energy).filter(Number.isFinite);
    const [least, most] = ranges.get(start) ?? [Infinity, -Infinity];
    ranges.set(start, [Math.min(least, ...energies), Math.max(most, ...energies)]);
  }
  const down = (start: number, energy: number) => {
    const [least, most] = ranges.get(start)!;
    const share = most > least ? (energy - least) / (most - least) : 0.5;
    return BOTTOM - (BOTTOM - TOP) * share;
  };
  svg.setAttribute("viewBox", `0 0 ${WIDE} ${HIGH}`);
  svg.setAttribute("preserveAspectRatio", "none");
  const breaks = lines[current]?.breaks.filter((at) => at > first && at < lengthOf(timeline)) ?? [];
  const spot = (start: number, { at, energy }: Point) => `${across(at)} ${down(start, energy)}`;
  const parts = partsOf(timeline, current).map(({ line, from, to, bright }) => {
    const own = all[line]!.map(({ start, points }) => ({
      start,
      points: points.filter(({ at }) => at >= from && at <= to),
    })).filter(({ points }) => points.length > 0);
    const drawn = own.map(({ start, points }) => points.map((point) => spot(start, point)));
    const areas = own.map(({ points }, i) => {
      const [left, right] = [points[0]!, points.at(-1)!].map(({ at }) => across(at));
      return `M${left} ${HIGH}L${drawn[i]!.join("L")}L${right} ${HIGH}Z`;
    });
    const dots = drawn.flat().map((place) => `M${place}h0`);
    const tone = `line-${line}${bright ? " current" : ""}`;
    return [
      path(`area ${tone}`, areas.join("")),
      path(`curve ${tone}`, drawn.map((places) => `M${places.join("L")}`).join("")),
      path(`dots ${tone}`, dots.length <= MOST_DOTS ? dots.join("") : ""),
    ];
  });
  const [parent, branch] = all.map((stretches) =>
    stretches.flatMap(({ start, points }) => points.map((point) => spot(start, point))),
  );
  const fork = (lines[1]?.from ?? first) - first;
  const ends = [parent?.[fork - 1], branch?.[fork]];
  svg.replaceChildren(
    path("break", breaks.map((at) => `M${across(at + 0.5)} 0V${HIGH}`).join("")),
    path("fork line-1", ends.every(Boolean) ? `M${ends.join("L")}` : ""),
    ...parts.flat(),
  );
}

interface Part {
  line: number;
  from: number;
  to: number;
  /** Whether it is of the line that is looked at. */
  bright: boolean;
}

/** What both lines have in common is drawn once; the line that is looked at last. */
function partsOf({ first, lines }: Timeline, current: number): Part[] {
  const branch = lines[1];
  if (!branch) return [{ line: 0, from: first, to: Infinity, bright: true }];
  const shared = { line: 0, from: first, to: branch.from, bright: true };
  const own = [
    { line: 0, from: branch.from, to: Infinity, bright: current === 0 },
    { line: 1, from: branch.from + 1, to: Infinity, bright: current === 1 },
  ];
  return [shared, ...(current === 0 ? own.reverse() : own)];
}

/** Where scales begin: shares of the width, 0–1, and names. */
export function scalesOf(timeline: Timeline, current: number): { share: number; name: string }[] {
  const line = timeline.lines[current];
  const length = Math.max(1, lengthOf(timeline) - timeline.first);
  const begins: { share: number; name: string }[] = [];
  let last = "";
  for (const { at, pass } of line?.passes ?? []) {
    const name = scaleName(pass);
    if (name === last || name === "") continue;
    last = name;
    begins.push({
      share: Math.max(0, at - 0.5 - timeline.first) / length,
      name: text.timeline.scale(name),
    });
  }
  return begins;
}

/** How far along the width a place is, 0–1. */
export const shareOf = (timeline: Timeline, at: number) =>
  (at - timeline.first) / Math.max(1, lengthOf(timeline) - timeline.first);

function path(name: string, d: string): SVGPathElement {
  const element = document.createElementNS(SPACE, "path");
  element.setAttribute("class", name);
  element.setAttribute("d", d);
  element.setAttribute("vector-effect", "non-scaling-stroke");
  return element;
}
