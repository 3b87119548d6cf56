/**
 * Plays a recording on the stage, pass by pass, while the core loads, and hands over to it: the last pass is a result
 * like any other then, and every view shows it.
 */

import { present, recorded } from "../memory/history";
import { open, restore } from "../session";
import { FITTING } from "../stage/place";
import { store } from "../store";
import { sceneOf } from "../scenes";
import { text } from "../text";
import { entered, type Timeline } from "../timeline/line";
import { nameOf } from "../views";
import type { Source } from "../worker/protocol";
import { bitmapOf, fetchRecording, type Pass, type Recording } from "./recording";

/** Between two passes, milliseconds. */
const BEAT_MS = 220;

const still = matchMedia("(prefers-reduced-motion: reduce)");

/** Of a built-in sequence all is known. */
const WHOLE = { labels: true, depth: true, flow: true, occlusion: true };

/** Shows a recording from its first picture on; resolves when the last is there. */
export async function play(recording: Recording): Promise<void> {
  const source = sceneOf(recording.name);
  const { title, lesson, width, height, camera, shapes } = recording;
  store.update({
    ...{ source, title, lesson, width, height, camera, shapes, truth: WHOLE },
    ...{ view: "depth", started: true, playing: true, zoom: FITTING },
  });
  await showAll(recording, source);
}

async function showAll({ passes }: Recording, source: Source): Promise<void> {
  const last = passes.slice(-1);
  const shown = still.matches ? last : [...passes.slice(0, -1).filter(hasDepth), ...last];
  for (const [i, pass] of shown.entries()) {
    if (i > 0) await new Promise((next) => setTimeout(next, BEAT_MS));
    // Somebody has opened or started something else meanwhile.
    if (!store.state.playing || store.state.running || store.state.source !== source) return;
    await show(pass);
  }
}

/** Without translation nothing is known of depth, and its picture is empty. */
const hasDepth = ({ report, picture }: Pass) =>
  picture !== null && report.regions.some(({ translation }) => translation.some(Boolean));

async function show({ report, contours, picture }: Pass): Promise<void> {
  if (!picture) return store.update({ report, contours });
  const bitmap = await bitmapOf(picture);
  // Only depth was recorded.
  const pictured = nameOf({ ...store.state, view: "depth" });
  store.update({ report, contours, pictures: [bitmap], pictured });
}

/** Plays the recording of the sequence that is open; what was there is a step back. */
export async function playAgain(source: Source): Promise<void> {
  if (source.kind !== "scene") return;
  const recording = await fetchRecording(source.name).catch(() => null);
  const { running, opening } = store.state;
  if (!recording || running || opening || store.state.source !== source) return;
  const { camera, shapes, found } = recording;
  store.update({
    ...recorded(present()),
    ...{
      camera,
      shapes,
      options: {},
      scales: [],
      selected: null,
      finding: null,
      focalFinding: null,
    },
    ...{ view: "depth", started: true, playing: true, message: null },
  });
  await showAll(recording, source);
  const interrupted = store.state.running || store.state.source !== source;
  store.update({ playing: false });
  if (interrupted) return;
  store.update({ timeline: timelineOf(recording) });
  await restore(found);
}

/** Opens the recorded sequence with the recorded result, once the core is there. */
export async function handOver(recording: Recording, source: Source): Promise<boolean> {
  const { camera, shapes, found } = recording;
  const setting = { camera, shapes, options: {} };
  const done = await open(source, text.waits.rendering, setting, found);
  if (done && store.state.source === source) store.update({ timeline: timelineOf(recording) });
  return done;
}

/** The recorded passes, to be gone through as those of a run. */
function timelineOf({ name, camera, shapes, passes }: Recording): Timeline | null {
  const setup = { camera, shapes, options: {} };
  return passes.reduce<Timeline | null>((timeline, { report: whole, state }) => {
    const { history, breaks, ...rest } = whole;
    const report = { ...rest, history: [], breaks: [] };
    const energy = history.at(-1) ?? NaN;
    const solve = `recorded ${name}`;
    return entered(timeline, { solve, origin: null, setup, report, energy, breaks, bytes: state });
  }, null);
}
