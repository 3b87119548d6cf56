/**
 * The energy of each pass as a height: it falls as the energy falls, and where that becomes another sum, which compares
 * with none before, it goes on from where it is.
 *
 *     h = 0 after the first pass;  hₙ = hₙ₋₁ + ln(Eₙ / Eₙ₋₁), or hₙ₋₁ where Eₙ is another sum than Eₙ₋₁
 *
 * Two lines that part have the same heights up to there.
 */

import type { Line, Timeline } from "./line";

export interface Point {
  at: number;
  height: number;
  /** Whether the energy is the same sum as after the pass before. */
  compares: boolean;
}

export function heightsOf({ first }: Timeline, { energies, breaks }: Line): Point[] {
  let height = 0;
  return energies.map((energy, i) => {
    const at = first + 1 + i;
    const before = energies[i - 1];
    const compares = before !== undefined && !breaks.includes(at - 1);
    const fall = compares ? Math.log(energy / before) : 0;
    // No sum that is no number, or is none, has a logarithm.
    if (Number.isFinite(fall)) height += fall;
    return { at, height, compares };
  });
}

/** Where heights lie between the lowest, 0, and the highest, 1; in the middle where all are the same. */
export function within(all: Point[]): (point: Point) => number {
  const heights = all.map(({ height }) => height);
  const [least, most] = [Math.min(...heights), Math.max(...heights)];
  return ({ height }) => (most > least ? (height - least) / (most - least) : 0.5);
}
