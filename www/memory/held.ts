/**
 * The present result, put away as soon as the solver rests, and now and then while it runs: so that it outlives what
 * comes after, be it another curve, another sequence, a broken worker or a reload.
 */

import { keep } from "../session";
import { store, type Held, type State } from "../store";
import type { Found } from "../worker/protocol";

/** While it runs, a result is put away no more often. */
const INTERVAL_MS = 4000;
/** A frame with more pixels is too large for its results to be put away beside it. */
export const MOST_PIXELS = 8e6;

let last = -Infinity;

export function mountHeld(): void {
  store.watch(
    ({ running, started, revision, busy }) => [running, started, revision, busy],
    (state) => {
      const { running, started, revision, held } = state;
      if (!started) {
        if (held) store.update({ held: null });
        return;
      }
      if (held?.revision === revision || !state.report || state.width * state.height > MOST_PIXELS)
        return;
      if (running && performance.now() - last < INTERVAL_MS) return;
      // A recording is put away already.
      if (state.frames) take(state);
    },
  );
}

/** What a result was found with, to tell whether it still belongs to what is set. */
export const settingsOf = ({
  shapes,
  camera,
  options,
}: Pick<State, "shapes" | "camera" | "options">) => JSON.stringify([shapes, camera, options]);

function take(state: Readonly<State>): void {
  last = performance.now();
  const held: Held = {
    revision: state.revision,
    settings: settingsOf(state),
    ready: keep().then((found) => {
      held.found = found;
      // Told to those who keep it for longer.
      if (store.state.held === held) store.update({ heldFound: found });
      return found;
    }),
    found: null,
  };
  store.update({ held });
}

/** A result that has been put away, as the present one. */
export const putAway = (found: Found, state: Readonly<State>): Held => ({
  revision: state.revision,
  settings: settingsOf(state),
  ready: Promise.resolve(found),
  found,
});

/** The result that belongs to what is set now, if it has been put away. */
export function presentFound(state: Readonly<State>): Found | null {
  const { held } = state;
  return held && held.settings === settingsOf(state) ? held.found : null;
}
