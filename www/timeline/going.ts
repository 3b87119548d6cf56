/** Along the timeline: to a pass, to the next, playing; and on from there with the settings as they are. */

import { announce } from "../dom";
import { visit } from "../looking";
import { present, recorded } from "../memory/history";
import { paceOf } from "../pace";
import { command } from "../session";
import { store, type State } from "../store";
import { text } from "../text";
import { branched, endOf, standingAt, type Visit } from "./line";

/** Where the page is on the timeline: the line and the number of passes. */
export function placeOf({ timeline, visit, started }: Readonly<State>): Visit {
  if (!timeline) return { line: 0, at: 0 };
  if (visit) return visit;
  const line = timeline.lines.length - 1;
  return { line, at: started ? endOf(timeline, timeline.lines[line]!) : timeline.first };
}

/** The first place that there is: the following pair of a film has no start of its own. */
export function firstOf({ timeline }: Readonly<State>): number {
  const first = timeline?.first ?? 0;
  return first > 0 ? first + 1 : 0;
}

/** Goes to a place; the end of the solver's own line is where that stands, and moves on with it. */
export function goTo(to: Visit): Promise<void> {
  const { state } = store;
  const { timeline } = state;
  const line = timeline?.lines[to.line];
  if (!timeline || !line) return Promise.resolve();
  const end = endOf(timeline, line);
  const at = Math.max(firstOf(state), Math.min(end, to.at));
  const live = to.line === timeline.lines.length - 1 && at === end && stands(state);
  return visit(live ? null : { line: to.line, at });
}

/** Whether the solver stands at the end of the last line, and not at the start of another solve. */
function stands({ visit, started, report, working, timeline }: Readonly<State>): boolean {
  const own = visit ? working : started ? report : null;
  const line = timeline?.lines.at(-1);
  if (!own || !timeline || !line) return false;
  // A solver that had only curves to go on from counts anew.
  return own.iterations === endOf(timeline, line) - (line.whole ? 0 : line.from);
}

/** A pass on or back. */
export function walk(by: number): Promise<void> {
  const { line, at } = placeOf(store.state);
  return goTo({ line, at: at + by });
}

let playing = 0;
let told: (playing: boolean) => void = () => {};

/** Who is told when playing begins and ends. */
export function onPlaying(listener: (playing: boolean) => void): void {
  told = listener;
}

export const isPlaying = () => playing !== 0;

export function stop(): void {
  if (playing === 0) return;
  playing = 0;
  told(false);
}

let turns = 0;

/** Goes along the line from here, or from its beginning when it is at its end; `beat` is the time of a pass, milliseconds. */
export async function play(beat: () => number): Promise<void> {
  const mine = ++turns;
  playing = mine;
  told(true);
  const { timeline } = store.state;
  const { line, at } = placeOf(store.state);
  const end = timeline ? endOf(timeline, timeline.lines[line]!) : 0;
  if (at >= end) await goTo({ line, at: firstOf(store.state) });
  while (playing === mine) {
    // Passes are drawn before the next is due, however long that takes.
    await new Promise((next) => setTimeout(next, beat()));
    const here = placeOf(store.state);
    const now = store.state.timeline?.lines[here.line];
    if (playing !== mine || !now) break;
    if (here.at >= endOf(store.state.timeline!, now)) break;
    await walk(1);
  }
  if (playing === mine) stop();
}

/** A second line, from the pass that is shown, with the settings as they are. */
export async function goOn(): Promise<void> {
  stop();
  const { timeline } = store.state;
  const from = placeOf(store.state);
  const standing = timeline && standingAt(timeline, from);
  if (!timeline || !standing) return;
  const patch = { running: true, started: true, selected: null };
  store.update({ timeline: branched(timeline, from, true) });
  const done = await command(patch, async (service, setup, wanted) => {
    const pace = paceOf(store.state);
    const begun = await service.goOn(standing, from.at, setup, wanted, pace);
    if (begun.whole) return;
    // The solver goes back to the curves that it began with, and so does the page.
    store.update({ ...recorded(present()), shapes: begun.shapes });
    part(false);
  });
  if (!done) store.update({ timeline });
  else announce(text.timeline.goingOn(from.at));
}

/** Says of the second line whether it went on with all that was found. */
function part(whole: boolean): void {
  const { timeline } = store.state;
  const branch = timeline?.lines[1];
  if (!timeline || !branch) return;
  store.update({ timeline: { ...timeline, lines: [timeline.lines[0]!, { ...branch, whole }] } });
}
