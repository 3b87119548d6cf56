/**
 * The solve as a film: the outlines on the first frame, pass by pass, under them the number of the pass and the energy.
 *
 * Passes come from the timeline and are drawn by the viewer; the browser's encoder makes a WebM of them, faster than it
 * plays.
 */

import { viewer } from "../looking";
import { drawContours } from "../stage/outline";
import { store, type State } from "../store";
import { later } from "../text/later";
import { placeOf } from "../timeline/going";
import { endOf, standingAt, type Line, type Timeline } from "../timeline/line";
import { heightsOf, within } from "../timeline/heights";
import type { Pane } from "../stage/place";

const words = later.solveFilm;

/** A small frame is shown at a whole multiple of its size, up to about this width. */
const WIDE = 960;
/** Encoders and players take no more for sure. */
const WIDEST = 1920;
/** Height of the line beneath, as a share of the width. */
const BENEATH = 0.06;
/** Seconds that a pass is seen; all of them together, as far as that allows; and the last. */
const BEAT = { least: 0.1, most: 0.7, all: 15, last: 3 };

/** A place of the timeline, and how long it is seen. */
interface Scene {
  at: number;
  seconds: number;
}

/** The passes that are kept of the line that is shown, from its start. */
export function scenes(state: Readonly<State>): Scene[] {
  const { timeline } = state;
  const line = timeline?.lines[placeOf(state).line];
  if (!timeline || !line || line.passes.length === 0) return [];
  const start = timeline.first > 0 ? [] : [0];
  const places = [...start, ...line.passes.map(({ at }) => at)];
  const seconds = Math.min(BEAT.most, Math.max(BEAT.least, BEAT.all / places.length));
  return places.map((at, i) => ({
    at,
    seconds: i === places.length - 1 ? BEAT.last : seconds,
  }));
}

/** How long the film is, seconds. */
export const lengthOf = (list: Scene[]) => list.reduce((sum, { seconds }) => sum + seconds, 0);

/**
 * The film; a sentence that says why there is none; or `null` where it was given up. `said` hears how far it is.
 */
export async function film(
  said: (text: string) => void,
  signal: AbortSignal,
): Promise<Blob | string | null> {
  const { state } = store;
  const { source, timeline, frames } = state;
  const list = scenes(state);
  if (!source || !timeline || !frames || list.length === 0) {
    return words.none;
  }
  if (typeof VideoEncoder === "undefined") return words.noEncoder;
  const {
    BufferTarget,
    CanvasSource,
    getFirstEncodableVideoCodec,
    Output,
    QUALITY_HIGH,
    WebMOutputFormat,
  } = await import("mediabunny");
  const canvas = document.createElement("canvas");
  const pane = layOut(canvas, state);
  const size = { width: canvas.width, height: canvas.height };
  const codec = await getFirstEncodableVideoCodec(["vp9", "vp8", "av1"], size);
  if (!codec) return words.noEncoder;

  const { line } = placeOf(state);
  const output = new Output({ format: new WebMOutputFormat(), target: new BufferTarget() });
  const track = new CanvasSource(canvas, { codec, quality: QUALITY_HIGH });
  output.addVideoTrack(track);
  await output.start();
  const context = canvas.getContext("2d")!;
  let time = 0;
  for (const [i, { at, seconds }] of list.entries()) {
    said(words.filming(i + 1, list.length));
    const nothing = { view: "", pictures: [], longest: 1, mesh: null };
    const drawn = await viewer.show(source, standingAt(timeline, { line, at })!, nothing);
    if (!drawn || signal.aborted) {
      await output.cancel();
      return null;
    }
    context.drawImage(frames[0], 0, 0, canvas.width, pane.cell.height);
    drawContours(context, pane, drawn.contours, state.catalogues?.colours ?? []);
    drawLine(context, pane, timeline, timeline.lines[line]!, at);
    await track.add(time, seconds);
    time += seconds;
  }
  // Players end with the last picture, whatever its duration: it comes once more.
  await track.add(time, 0.1);
  await output.finalize();
  return new Blob([output.target.buffer!], { type: "video/webm" });
}

/** Sizes the canvas, an even number of pixels each way, and tells where the frame lies on it. */
function layOut(canvas: HTMLCanvasElement, { width, height }: Readonly<State>): Pane {
  const scale = width <= WIDE ? Math.max(1, Math.round(WIDE / width)) : Math.min(1, WIDEST / width);
  const even = (length: number) => 2 * Math.round(length / 2);
  canvas.width = even(width * scale);
  const cell = { left: 0, top: 0, width: canvas.width, height: even(height * scale) };
  canvas.height = cell.height + even(canvas.width * BENEATH);
  return { left: 0, top: 0, scale: canvas.width / width, cell };
}

/** The line beneath: which pass this is, and the energy up to it, each stretch that compares at a height of its own. */
function drawLine(
  context: CanvasRenderingContext2D,
  { cell }: Pane,
  timeline: Timeline,
  line: Line,
  at: number,
): void {
  const { width } = cell;
  const top = cell.height;
  const height = context.canvas.height - top;
  context.fillStyle = "#111516";
  context.fillRect(0, top, width, height);
  context.fillStyle = "#e8edec";
  context.font = `${Math.round(0.46 * height)}px system-ui, sans-serif`;
  context.textBaseline = "middle";
  const text = at === timeline.first ? words.start : words.pass(at, endOf(timeline, line));
  context.fillText(text, 0.3 * height, top + height / 2);

  const left = 0.36 * width;
  const right = width - 0.4 * height;
  const { first } = timeline;
  const x = (at: number) => left + ((right - left) * (at - first)) / line.energies.length;
  const colour = (of: number) => (of <= at ? "#4fd0e2" : "#55646a");
  const points = heightsOf(timeline, line);
  const share = within(points);
  const spots = points.map((point) => {
    return [x(point.at), top + height * (0.8 - 0.6 * share(point))] as const;
  });
  for (const [i, { at: pass, compares }] of points.entries()) {
    const last = spots[i - 1];
    context.strokeStyle = context.fillStyle = colour(pass);
    // Thin where the energy became another sum.
    context.lineWidth = (compares ? 0.05 : 0.02) * height;
    context.beginPath();
    if (last) context.moveTo(...last);
    context.lineTo(...spots[i]!);
    context.stroke();
    context.beginPath();
    context.arc(...spots[i]!, (pass === at ? 0.14 : 0.05) * height, 0, 2 * Math.PI);
    context.fill();
  }
  context.fillStyle = "#a4b0b2";
  context.textAlign = "right";
  context.fillText(words.energy, left - 0.2 * height, top + height / 2);
  context.textAlign = "left";
}
