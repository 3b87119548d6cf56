/**
 * The relief of the other line of the timeline, for a place of its own beside that of the line shown: after as many
 * passes, or its last, and deepened alike.
 */

import { viewer } from "../looking";
import { store } from "../store";
import { endOf, standingAt } from "../timeline/line";
import { placeOf } from "../timeline/going";
import { wantedBy } from "../views";
import type { MeshData, Standing } from "../worker/protocol";

/** Nobody scrubs any more, milliseconds. */
const REST_MS = 200;

/** `show` is given the relief of a line; what comes back is to be told the factor of the relief of the other. */
export function mountBeside(
  show: (mesh: MeshData, line: number) => void,
): (deepened: number) => void {
  let factor = 1;
  let timer: ReturnType<typeof setTimeout> | undefined;
  let asked = 0;
  /** What was asked for last. */
  let known: { standing: Standing; key: string } | null = null;

  const fetch = async () => {
    const { state } = store;
    const { source, timeline, beside, view, running } = state;
    const { mesh } = wantedBy(state);
    if (!source || !timeline || !beside || view !== "relief" || !mesh) {
      known = null;
      return;
    }
    const { line, at } = placeOf(state);
    const other = timeline.lines[1 - line];
    const end = other && endOf(timeline, other);
    // Beside a line that grows stands all that the other came to.
    const place = end && { line: 1 - line, at: running ? end : Math.min(at, end) };
    const standing = place ? standingAt(timeline, place) : null;
    const params = { ...mesh, relief: factor > 1 && !running ? factor : null };
    const key = JSON.stringify(params);
    if (!standing || (known?.standing === standing && known.key === key)) return;
    known = { standing, key };
    const mine = ++asked;
    const drawn = await viewer
      .ask(source, standing, (service) => service.mesh(params))
      .catch(() => null);
    if (!drawn) known = null;
    else if (mine === asked && store.state.beside) show(drawn, 1 - line);
  };
  const later = () => {
    clearTimeout(timer);
    timer = setTimeout(() => void fetch(), REST_MS);
  };
  store.watch(
    ({ beside, view, visit, timeline, running, viewParams, scales }) => [
      ...[beside, view, visit, timeline, running, viewParams.material, scales],
    ],
    later,
  );
  return (deepened) => {
    if (deepened === factor) return;
    factor = deepened;
    later();
  };
}
