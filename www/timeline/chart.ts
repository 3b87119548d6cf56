/**
 * The energy along the timeline: one line that falls as the energy falls (`heights.ts`), full where two energies compare,
 * dashed where the energy became another sum, with a rule where a scale begins.
 */

import { heightsOf, within, type Point } from "./heights";
import { lengthOf, type Timeline } from "./line";
import { scaleName } from "./sentences";

const SPACE = "http://www.w3.org/2000/svg";
/** Units across and down; the drawing is stretched to its place. */
const [WIDE, HIGH] = [1000, 100];
/** Of the height, what the line takes. */
const [TOP, BOTTOM] = [24, 84];
/** With more passes dots would run into each other. */
const MOST_DOTS = 90;

/** Draws the lines. */
export function drawChart(svg: SVGSVGElement, timeline: Timeline, current: number): void {
  const { first, lines } = timeline;
  const length = Math.max(1, lengthOf(timeline) - first);
  const all = lines.map((line) => heightsOf(timeline, line));
  const share = within(all.flat());
  const across = ({ at }: Point) => (WIDE * (at - first)) / length;
  const spot = (point: Point) => `${across(point)} ${BOTTOM - (BOTTOM - TOP) * share(point)}`;
  const step = (points: Point[]) => (point: Point, i: number) =>
    i > 0 ? `M${spot(points[i - 1]!)}L${spot(point)}` : "";
  svg.setAttribute("viewBox", `0 0 ${WIDE} ${HIGH}`);
  svg.setAttribute("preserveAspectRatio", "none");
  const parts = partsOf(timeline, current).flatMap(({ line, from, to, bright }) => {
    const own = all[line]!.filter(({ at }) => at >= from && at <= to);
    if (own.length === 0) return [];
    const tone = `line-${line}${bright ? " current" : ""}`;
    const steps = own.map(step(own));
    const of = (compares: boolean) =>
      steps.filter((_, i) => own[i]!.compares === compares).join("");
    const [left, right] = [across(own[0]!), across(own.at(-1)!)];
    const dots = own.length <= MOST_DOTS ? own : [];
    return [
      path(`area ${tone}`, `M${left} ${HIGH}L${own.map(spot).join("L")}L${right} ${HIGH}Z`),
      path(`join ${tone}`, of(false)),
      path(`curve ${tone}`, of(true)),
      path(`dots ${tone}`, dots.map((point) => `M${spot(point)}h0`).join("")),
    ];
  });
  const [parent, branch] = all;
  const fork = (lines[1]?.from ?? first) - first;
  const ends = [parent?.[fork - 1], branch?.[fork]];
  const rules = scalesOf(timeline, current).map(({ share }) => `M${WIDE * share} 0V${HIGH}`);
  svg.replaceChildren(
    path("scale", rules.slice(1).join("")),
    path("fork line-1", ends.every(Boolean) ? `M${ends.map((end) => spot(end!)).join("L")}` : ""),
    ...parts,
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
    begins.push({ share: Math.max(0, at - 0.5 - timeline.first) / length, name });
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
