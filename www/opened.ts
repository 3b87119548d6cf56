/** A pair that has been opened takes the place of the one before, and of what was found in that. */

import { FREE, store, type State } from "./store";
import type { Setting } from "./memory/setting";
import { FITTING } from "./stage/place";
import { tells, TOLD } from "./stage/sides";
import type { Followed, Found, KnownParts, Opened, Setup, Source } from "./worker/protocol";

/**
 * Whether two pairs are of the same frames, perhaps the other way round: what was drawn on the one holds for
 * the other.
 */
export function sameFrames(one: Source, other: Source | null): boolean {
  if (one.kind !== "files" || other?.kind !== "files") return false;
  const frames = [other.first.bytes, other.second.bytes];
  return frames.includes(one.first.bytes) && frames.includes(one.second.bytes);
}

/** With `keep`, curves and camera stay as they are, and so does what can be undone. */
export function adopt(
  source: Source,
  opened: Opened,
  { keep, setting, found }: { keep: boolean; setting: Partial<Setting>; found: Found | null },
): void {
  const { playing, pictures, pictured } = store.state;
  store.state.frames?.forEach((frame) => frame.close());
  store.update({
    source,
    title: opened.title,
    lesson: opened.lesson,
    width: opened.width,
    height: opened.height,
    frames: opened.frames,
    names: opened.names,
    interlaced: opened.interlaced,
    truth: opened.truth,
    ...(keep ? {} : { ...drawn(opened.setup), focalFrom: opened.focalFrom }),
    running: false,
    started: found !== null,
    report: found?.report ?? null,
    contours: found?.contours ?? [],
    // A recording has its last picture already.
    ...(playing && found ? { pictures, pictured } : { pictures: [], pictured: "", legends: [] }),
    scores: null,
    held: null,
    heldFound: null,
    ...NO_TIMELINE,
    scales: [],
    ranges: FREE,
    zoom: FITTING,
    showing: "first",
    tool: "select",
    playing: false,
    // Without a result there is nothing to see but the frames.
    ...(keep || found ? {} : { view: "curves" }),
    ...seen(setting),
  });
  fit();
}

/** The truth of the pair that is open is known. */
export function knows(source: Source, truth: KnownParts): void {
  store.update({ source, truth, scores: null });
  fit();
}

/** A view that needs the truth makes no sense without, and shows what the truth tells. */
function fit(): void {
  const { truth, view, viewParams } = store.state;
  const told = TOLD.filter((kind) => tells(truth, kind));
  const [first] = told;
  if (!first) {
    if (["compare", "error"].includes(view)) store.update({ view: "curves" });
    return;
  }
  const { compare, error } = viewParams;
  const fits = told.includes(error.slice(6));
  if (fits && tells(truth, compare)) return;
  store.update({
    viewParams: {
      ...viewParams,
      compare: tells(truth, compare) ? compare : first,
      error: fits ? error : `error-${first}`,
    },
  });
}

/** How it is looked at. The solver's part of a setting is what the pair was opened with. */
function seen({ view, viewParams, ranges, scales, pace }: Partial<Setting>): Partial<State> {
  return {
    ...(view && { view }),
    // One that was kept by an earlier page knows of fewer.
    ...(viewParams && { viewParams: { ...store.state.viewParams, ...viewParams } }),
    ...(ranges && { ranges: { ...FREE, ...ranges } }),
    ...(scales && { scales }),
    ...(pace !== undefined && { pace }),
  };
}

/** The following pair of a film: what was found in the last one is where the next begins. */
export function follows(source: Source & { kind: "files" }, { frames, shapes }: Followed): void {
  store.state.frames?.forEach((frame) => frame.close());
  const { camera } = store.state;
  store.update({
    source,
    frames,
    names: [source.first.name, source.second.name],
    ...drawn({ shapes, camera, options: {} }),
    focalFinding: store.state.focalFinding,
    running: false,
    truth: null,
    scores: null,
    zoom: FITTING,
    ...NO_TIMELINE,
    showing: "first",
    tool: "select",
  });
}

const NO_TIMELINE = { timeline: null, visit: null, working: null };

/** What a pair brings with it, as if somebody had just drawn it. */
function drawn({ shapes, camera, options }: Setup): Partial<State> {
  return {
    shapes,
    camera,
    options,
    focalFinding: null,
    selected: null,
    past: [],
    future: [],
    finding: null,
  };
}
