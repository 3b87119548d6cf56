/**
 * The energy of each pass as a height: it falls as the energy falls, and where that becomes another sum, which compares
 * with none before, it goes on from where it is.
 *
 *     h = 0 after the first pass;  hₙ = hₙ₋₁ + ln(Eₙ / Eₙ₋₁), or hₙ₋₁ where Eₙ is another sum than Eₙ₋₁
 *
 * Two lines have the same heights up to where they part, and wherever they come to the same energy.
 */

import type { Line, Timeline } from "./line";

export interface Point {
  at: number;
  height: number;
  /** Whether the energy is the same sum as after the pass before. */
  compares: boolean;
}

export function heightsOf(timeline: Timeline, line: Line): Point[] {
  const { first, lines } = timeline;
  const { energies, breaks } = line;
  const parent = lines[0] && lines[0] !== line ? heightsOf(timeline, lines[0]) : [];
  let height = 0;
  return energies.map((energy, i) => {
    const at = first + 1 + i;
    const before = energies[i - 1];
    const compares = before !== undefined && !breaks.includes(at - 1);
    const fall = compares ? Math.log(energy / before) : 0;
    // Zero, and what is not a number, have no logarithm.
    if (Number.isFinite(fall)) height += fall;
    const same = energy === lines[0]?.energies[i] ? parent[i] : undefined;
    height = same?.height ?? height;
    return same ?? { at, height, compares };
  });
}

/** Where heights lie between the lowest, 0, and the highest, 1; in the middle where all are the same. */
export function within(all: Point[]): (point: Point) => number {
  const heights = all.map(({ height }) => height);
  const [least, most] = [Math.min(...heights), Math.max(...heights)];
  return ({ height }) => (most > least ? (height - least) / (most - least) : 0.5);
}
