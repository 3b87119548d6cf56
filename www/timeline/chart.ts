/**
 * The energy along the timeline.
 *
 * Energies compare between two breaks only: each stretch between two has a height of its own, full at its greatest and low
 * at its least energy. Two lines that have a stretch from the same break on share its height.
 */

import { endOf, lengthOf, type Line, type Timeline } from "./line";
import { scaleName } from "./sentences";

const SPACE = "http://www.w3.org/2000/svg";
/** Units across and down; the drawing is stretched to its place. */
const [WIDE, HIGH] = [1000, 100];
/** Of the height, what a stretch takes. */
const [TOP, BOTTOM] = [14, 84];
/** With more passes dots would run into each other. */
const MOST_DOTS = 90;

interface Stretch {
  start: number;
  points: { at: number; energy: number }[];
}

function stretchesOf({ first }: Timeline, line: Line): Stretch[] {
  const stretches: Stretch[] = [];
  for (const [i, energy] of line.energies.entries()) {
    const at = first + 1 + i;
    const begins = i === 0 || line.breaks.includes(at - 1);
    if (begins) stretches.push({ start: at - 1, points: [] });
    stretches.at(-1)!.points.push({ at, energy });
  }
  return stretches;
}

/** Draws the lines, the one that is looked at last; gives where scales begin, as shares of the width. */
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
  const order = lines
    .map((_, i) => i)
    .sort((a, b) => Number(a === current) - Number(b === current));
  const breaks = lines[current]?.breaks.filter((at) => at > first && at < lengthOf(timeline)) ?? [];
  svg.replaceChildren(
    path("break", breaks.map((at) => `M${across(at + 0.5)} 0V${HIGH}`).join("")),
    ...order.flatMap((i) => {
      // What both have in common is drawn once.
      const from = i > 0 ? lines[i]!.from : first;
      const own = all[i]!.map(({ start, points }) => ({
        start,
        points: points.filter(({ at }) => at > from),
      })).filter(({ points }) => points.length > 0);
      const place = (start: number) => (point: { at: number; energy: number }) =>
        `${across(point.at)} ${down(start, point.energy)}`;
      const curves = own.map(({ start, points }) => `M${points.map(place(start)).join("L")}`);
      const areas = own.map(
        ({ start, points }) =>
          `M${across(points[0]!.at)} ${HIGH}L${points.map(place(start)).join("L")}L${across(points.at(-1)!.at)} ${HIGH}Z`,
      );
      const dots = own.flatMap(({ start, points }) =>
        points.map((point) => `M${place(start)(point)}h0`),
      );
      const tone = `line-${i}${i === current ? " current" : ""}`;
      return [
        path(`area ${tone}`, areas.join("")),
        path(`curve ${tone}`, curves.join("")),
        path(`dots ${tone}`, dots.length <= MOST_DOTS ? dots.join("") : ""),
      ];
    }),
  );
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
    begins.push({ share: Math.max(0, at - 0.5 - timeline.first) / length, name: `scale ${name}` });
  }
  return begins;
}

/** How far along the width a place is, 0–1. */
export const shareOf = (timeline: Timeline, at: number) =>
  (at - timeline.first) / Math.max(1, lengthOf(timeline) - timeline.first);

/** Whether a line reaches a place. */
export const reaches = (timeline: Timeline, line: Line, at: number) => at <= endOf(timeline, line);

function path(name: string, d: string): SVGPathElement {
  const element = document.createElementNS(SPACE, "path");
  element.setAttribute("class", name);
  element.setAttribute("d", d);
  element.setAttribute("vector-effect", "non-scaling-stroke");
  return element;
}
