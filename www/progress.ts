/** How far a run has come and how long it will take, from the passes it has made. Estimates, and said to be. */

import type { Report } from "./worker/protocol";

/** Passes that the scales of `best` take as a rule: the first with curves, the first without, each later one. */
const FIRST = 7;
const FIRST_ALONE = 3;
const LATER = 5;
/** Passes that `paper` takes as a rule. */
const PAPER = 60;

/** A pass that was made: at which scale, and how long after the one before, in milliseconds. */
export interface PassTime {
  level: number;
  time: number;
}

export interface Estimate {
  /** 0–1. */
  done: number;
  /** Seconds left; `null` until a pass has been timed. */
  left: number | null;
}

/** `least` is what a pass takes at least, in milliseconds. */
export function estimate(report: Report, passes: PassTime[], least: number): Estimate {
  const { level, levels, regions, iterations } = report;
  const last = passes.at(-1);
  const typical = (at: number) => {
    const times = passes.filter((pass) => pass.level === at).map(({ time }) => time);
    const sorted = times.toSorted((a, b) => a - b);
    return sorted[Math.floor(sorted.length / 2)];
  };
  /** What a pass takes at a scale; one that was not seen yet has four times the pixels of the next coarser. */
  const cost = (at: number): number => {
    const seen = typical(at);
    if (seen !== undefined) return seen;
    if (last === undefined) return 4 ** -at;
    return Math.max(least, last.time * 4 ** (last.level - at));
  };
  if (
    levels === 1 &&
    regions.length > 0 &&
    iterations > 0 &&
    level === 0 &&
    passes.length > LATER
  ) {
    // Energy falls ever more slowly: the end moves on while it is not there.
    const total = Math.max(PAPER, iterations * 1.2);
    return told(iterations * cost(0), (total - iterations) * cost(0), last !== undefined);
  }
  const usual = (at: number) =>
    at < levels - 1 ? LATER : regions.length > 1 ? FIRST : FIRST_ALONE;
  const made = (at: number) => passes.filter((pass) => pass.level === at).length;
  let past = passes.reduce((sum, { time }) => sum + time, 0);
  let left = 0;
  for (let at = level; at >= 0; at--) {
    // A pass more than usual may still be the last.
    left += Math.max(at === level ? 1 : 0, usual(at) - made(at)) * cost(at);
  }
  if (last === undefined) past = 0;
  return told(past, left, last !== undefined);
}

const told = (past: number, left: number, timed: boolean): Estimate => ({
  done: past / (past + left || 1),
  left: timed ? left / 1000 : null,
});
