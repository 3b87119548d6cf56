/** Two lines against each other: how far apart they are at a pass, and both in turn on the stage. */

import { askOf } from "../looking";
import { store } from "../store";
import { goTo, placeOf } from "./going";
import { endOf, standingAt, type Timeline } from "./line";

/** Between the two, milliseconds. */
const BEAT_MS = 900;

let beat: ReturnType<typeof setInterval> | undefined;

/** Shows one and the other in turn; `false` ends it. */
export function flicker(on: boolean): void {
  clearInterval(beat);
  beat = undefined;
  if (!on) return;
  const { at } = placeOf(store.state);
  const turn = () => void goTo({ line: 1 - placeOf(store.state).line, at });
  turn();
  beat = setInterval(turn, BEAT_MS);
}

export const flickers = () => beat !== undefined;

/** The share of pixels whose labels differ between the two lines after `at` passes; `null` where that is not known. */
export async function apartAt(timeline: Timeline, at: number): Promise<number | null> {
  const [one, other] = timeline.lines.map((line, i) =>
    standingAt(timeline, { line: i, at: Math.min(at, endOf(timeline, line)) }),
  );
  if (!one || !other) return null;
  if (one === other) return 0;
  return askOf(other, (service) => service.apart(one, other)).catch(() => null);
}
