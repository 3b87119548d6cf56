/**
 * Undo and redo: curves, camera, options, and the result that was there with them.
 *
 * A moment is all of that together. Each change puts the present one into the past; going back shows its result as it
 * was put away (`held.ts`). Runs make no moments: a result belongs to the settings that it was found with.
 */

import { announce } from "../dom";
import { cancel, configure, reset, restore } from "../session";
import { store, type State } from "../store";
import { text } from "../text";
import { sizeOf, type Timeline } from "../timeline/line";
import type { Held, Moment } from "../store";

/** Moments that can be gone back to. */
const MOST_MOMENTS = 200;
/** Compressed results and timelines among them, bytes: of the oldest only the settings stay. */
const MOST_BYTES = 64 << 20;

/** What undo brings back: everything that a solver is made from, and what it came to. */
export function present(): Moment {
  const { shapes, camera, options, scales, held, timeline } = store.state;
  return { shapes, camera, options, scales, held, timeline };
}

/** What is to be undone from here on; `before` is where it leads to. */
export function recorded(before: Moment): Pick<State, "past" | "future"> {
  const past = [...store.state.past, before].slice(-MOST_MOMENTS);
  return { past: bounded(past), future: [] };
}

/** A change of camera or options, as a step that can be undone. */
export function change(patch: Partial<Pick<State, "camera" | "options" | "focalFinding">>): void {
  store.update({ ...recorded(present()), ...patch });
  void configure();
}

export function undo(): void {
  const { past, future } = store.state;
  const before = past.at(-1);
  if (!before) return;
  void go(before, { past: past.slice(0, -1), future: [present(), ...future] });
  announce(text.page.undone);
}

export function redo(): void {
  const { past, future } = store.state;
  const after = future[0];
  if (!after) return;
  void go(after, { past: [...past, present()], future: future.slice(1) });
  announce(text.page.redone);
}

/** Where a run that is cancelled came from. */
let beforeRun: Moment | null = null;

export function mountHistory(): void {
  store.watch(
    ({ running }) => [running],
    ({ running }) => {
      if (running) beforeRun = present();
    },
  );
}

/** Back to the drawn curves; the result can be had again. */
export async function startOver(): Promise<void> {
  const before = present();
  const done = await reset();
  if (done && before.held) store.update(recorded(before));
}

/** Stops at once; the result from before the run can be had again. */
export async function giveUp(): Promise<void> {
  const { running, source } = store.state;
  const before = running ? beforeRun : present();
  await cancel();
  if (before?.held && store.state.source === source) store.update(recorded(before));
}

let steps = 0;

async function go(moment: Moment, history: Pick<State, "past" | "future">): Promise<void> {
  steps += 1;
  const mine = steps;
  const { selected, source, running } = store.state;
  const { shapes, camera, options, scales, held, timeline } = moment;
  store.update({
    ...history,
    shapes,
    camera,
    options,
    scales,
    finding: null,
    focalFinding: null,
    message: null,
    selected: selected !== null && selected < shapes.length ? selected : null,
  });
  // A run goes on, with what is set now.
  if (running) return configure();
  const found = held && (await held.ready);
  // Another step, or another pair, is what is wanted by now.
  if (mine !== steps || store.state.source !== source) return;
  store.update({ timeline });
  if (found) await restore(found);
  else if (store.state.started) await reset();
  else await configure();
}

/** The same moments, with results only in the latest that are not too many bytes. */
function bounded(moments: Moment[]): Moment[] {
  let left = MOST_BYTES;
  const counted = new Set<Held | Timeline>();
  return moments
    .toReversed()
    .map((moment) => {
      const { held, timeline } = moment;
      if (held && !counted.has(held)) left -= held.found?.bytes.length ?? 0;
      if (timeline && !counted.has(timeline)) left -= sizeOf(timeline);
      for (const one of [held, timeline]) if (one) counted.add(one);
      return left < 0 ? { ...moment, held: null, timeline: null } : moment;
    })
    .reverse();
}
