/**
 * The passes of a solve, and of a second that went on from one of them: all that the timeline shows, as data.
 *
 * Each pass is kept as the solver's state, compressed. Measured on the built-in sequences: under `best` 3 to 8 kB a pass,
 * at 320×240 and at 640×480 alike, since surfaces have as many control points (one with depth pixel by pixel, the last at
 * most, 170 and 630 kB); under `paper`, where every pixel has a depth and level sets of its own, 25 and 50 to 90 kB; and
 * 1 kB for what the solver told.
 * All passes together take at most `MOST_BYTES`: when they would take more, every second of the older half of the longer
 * line is let go, and its neighbour is shown in its place.
 */

import type { Pass, Report, Standing } from "../worker/protocol";

/** Bytes of passes at most, in memory and on the device. */
export const MOST_BYTES = 16 * 2 ** 20;

/** A pass that is kept, and the number that it has on the timeline. */
export interface Kept {
  at: number;
  pass: Pass;
}

/** One solve. */
export interface Line {
  /** The worker's name for it; empty until its first pass is there. */
  solve: string;
  /** The pass that it went on from, and whether with all that was found there; the timeline's first for the first line. */
  from: number;
  whole: boolean;
  /** Total energy after each pass, those before `from` included. */
  energies: number[];
  /** Passes after which energy became another sum. */
  breaks: number[];
  passes: Kept[];
}

/** One line, or two of which the second went on from the first. */
export interface Timeline {
  /** Passes that had been made before: of the pair before, when a film goes on. */
  first: number;
  lines: Line[];
}

/** What is shown instead of where the solver stands: after `at` passes of a line. */
export interface Visit {
  line: number;
  at: number;
}

/** The last pass of a line. */
export const endOf = ({ first }: Timeline, { energies }: Line) => first + energies.length;

/** The last pass of any. */
export const lengthOf = (timeline: Timeline) =>
  Math.max(...timeline.lines.map((line) => endOf(timeline, line)));

/** The same with one pass more: of a solve that is known, of one that goes on from it, or of a new one. */
export function entered(timeline: Timeline | null, pass: Pass): Timeline {
  const { solve, origin, report } = pass;
  const begun = timeline?.lines.find((line) => line.solve === solve);
  if (timeline && begun) return withPass(timeline, begun, pass);
  const waiting = timeline?.lines.find((line) => line.solve === "");
  if (timeline && waiting && origin) return withPass(timeline, waiting, pass);
  const first = report.iterations - 1;
  const line: Line = { solve, from: first, whole: true, energies: [], breaks: [], passes: [] };
  return withPass({ first, lines: [line] }, line, pass);
}

function withPass(timeline: Timeline, line: Line, pass: Pass): Timeline {
  const { report, origin, energy, solve } = pass;
  const offset = origin && !origin.whole ? origin.at : 0;
  const at = offset + report.iterations;
  // A recording leaves out what takes too much.
  const kept = pass.bytes.length > 0 ? [{ at, pass }] : [];
  // Passes come in order; one that is made again takes the place of the last time.
  const made = line.energies.slice(0, at - timeline.first - 1);
  const own = pass.breaks.map((after) => after + offset);
  const breaks = [...line.breaks.filter((after) => after <= line.from), ...own];
  const longer: Line = {
    ...line,
    solve,
    energies: [...made, energy],
    breaks: [...new Set(breaks)].filter((after) => after > timeline.first),
    passes: [...line.passes.filter((one) => one.at < at), ...kept],
  };
  const lines = timeline.lines.map((one) => (one === line ? longer : one));
  return { ...timeline, lines: bounded(lines) };
}

/** The same with a second line, as yet without passes of its own, that goes on from a pass of one there is. */
export function branched(timeline: Timeline, { line, at }: Visit, whole: boolean): Timeline {
  const parent = { ...timeline.lines[line]!, from: timeline.first };
  const branch: Line = {
    solve: "",
    from: at,
    whole,
    energies: parent.energies.slice(0, at - timeline.first),
    breaks: [...parent.breaks.filter((after) => after < at), at].filter(
      (after) => after > timeline.first,
    ),
    passes: parent.passes.filter((kept) => kept.at <= at),
  };
  return { ...timeline, lines: [parent, branch] };
}

/** The pass that is kept at a place, or the nearest one to it; `null` at the start, which needs none. */
export function keptAt(timeline: Timeline, { line, at }: Visit): Kept | null {
  const { passes } = timeline.lines[line] ?? { passes: [] };
  if (at <= timeline.first) return null;
  const far = (kept: Kept) => Math.abs(kept.at - at);
  return passes.reduce<Kept | null>(
    (best, kept) => (best && far(best) <= far(kept) ? best : kept),
    null,
  );
}

/** What the solver told after a pass, its history included. */
export function reportAt(timeline: Timeline, line: Line, { at, pass }: Kept): Report {
  return {
    ...pass.report,
    history: line.energies.slice(0, at - timeline.first),
    breaks: line.breaks.filter((after) => after <= at).map((after) => after - timeline.first),
  };
}

/** What all passes take, bytes. */
export function sizeOf({ lines }: Timeline): number {
  const passes = new Set(lines.flatMap((line) => line.passes.map(({ pass }) => pass)));
  return [...passes].reduce((sum, { bytes }) => sum + bytes.length, 0);
}

function bounded(lines: Line[]): Line[] {
  let kept = lines;
  while (sizeOf({ first: 0, lines: kept }) > MOST_BYTES) {
    const longest = kept.reduce((a, b) => (b.passes.length > a.passes.length ? b : a));
    const old = Math.ceil(longest.passes.length / 2);
    const let_go = new Set(
      longest.passes.filter(({ at }, i) => i % 2 === 1 && i < old && !parts(kept, at)),
    );
    if (let_go.size === 0) break;
    const passes = new Set([...let_go].map(({ pass }) => pass));
    kept = kept.map((line) => ({
      ...line,
      passes: line.passes.filter(({ pass }) => !passes.has(pass)),
    }));
  }
  return kept;
}

/** Whether a line goes on from there. */
const parts = (lines: Line[], at: number) => lines.some(({ from }) => from === at);

const starts = new WeakMap<Pass, Standing>();

/** Where a solver stood at a place of the timeline; a state without bytes is the start. */
export function standingAt(timeline: Timeline, visit: Visit): Standing | null {
  const kept = keptAt(timeline, visit);
  if (kept) return kept.pass;
  const first = timeline.lines[visit.line]?.passes[0]?.pass;
  if (!first) return null;
  const start = starts.get(first) ?? { setup: first.setup, bytes: new Uint8Array() };
  starts.set(first, start);
  return start;
}
