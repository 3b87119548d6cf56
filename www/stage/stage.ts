/**
 * The stage: the pictures of the present view, the curves as they are, and the curves as drawn.
 *
 * Two canvases lie on each other. The lower one shows what was computed and changes with every
 * progress; the upper one shows what can be edited and takes pointer and keys (`tools.ts`).
 */

import { byId, make } from "../dom";
import { store, type State } from "../store";
import { asks, awaited, captionsOf, viewOf } from "../views";
import type { Contour } from "../worker/protocol";
import { SharpCanvas } from "./canvas";
import { drawShapes } from "./outline";
import { CAPTION_HEIGHT, panes, setPanes, stagePane, type Box, type Pane } from "./place";
import { drawSketch, sketchChanged } from "./tools";

const FLICKER_MS = 450;

let flickerSecond = false;

const lower = new SharpCanvas(byId<HTMLCanvasElement>("picture"), paintPictures);
const upper = new SharpCanvas(byId<HTMLCanvasElement>("overlay"), (context, { width, height }) => {
  const { state } = store;
  context.clearRect(0, 0, width, height);
  if (state.view !== "curves" || !state.frames) return;
  drawShapes(context, stagePane(), state);
  drawSketch(context, stagePane());
});

export function mountStage(): void {
  store.watch(
    ({ frames, pictures, pictured, contours, started, view, viewParams, catalogues }) => [
      frames,
      pictures,
      pictured,
      contours,
      started,
      view,
      viewParams,
      catalogues,
    ],
    () => lower.invalidate(),
  );
  store.watch(
    ({ shapes, selected, tool, view, frames, started }) => [
      shapes,
      selected,
      tool,
      view,
      frames,
      started,
    ],
    () => upper.invalidate(),
  );
  sketchChanged(() => upper.invalidate());
  store.watch(
    ({ view, pictured, catalogues, width, viewParams }) => [
      view,
      pictured,
      catalogues,
      width,
      viewParams.compare,
    ],
    caption,
  );
  store.watch(
    ({ frames, view, viewParams, pictured, running }) => [
      frames,
      view,
      viewParams,
      pictured,
      running,
    ],
    wait,
  );
  store.watch(({ showing }) => [showing], flicker);
}

function paintPictures(context: CanvasRenderingContext2D, size: Box): void {
  const { state } = store;
  const frame = { width: state.width, height: state.height };
  const view = viewOf(state.view);
  const wanted = asks(state).length;
  // Till what was chosen is there, the last picture stays, and `wait` dims it.
  if (awaited(state)) return;
  context.clearRect(0, 0, size.width, size.height);
  if (frame.width === 0 || view.id === "relief") return;
  const captioned = captionsOf(state).length > 0;
  const layout = panes(size, frame, Math.max(1, wanted), captioned ? CAPTION_HEIGHT : 0);
  setPanes(layout);
  placeCaptions(layout);
  context.imageSmoothingQuality = "medium";
  const shown = state.frames?.[flickerSecond ? 1 : 0];
  for (const [i, pane] of layout.entries()) {
    const picture = wanted === 0 ? shown : state.pictures[i];
    // A picture that has been replaced is empty.
    if (!picture?.width) continue;
    context.imageSmoothingEnabled = !view.crisp;
    context.drawImage(
      picture,
      pane.left,
      pane.top,
      frame.width * pane.scale,
      frame.height * pane.scale,
    );
    const colours = state.catalogues?.colours ?? [];
    if (view.curves && (view.id === "curves" || state.viewParams.curvesOnTop)) {
      drawContours(context, pane, visibleContours(state), colours);
    }
  }
}

/** Before anything was computed the contours are the drawn curves, which the upper canvas shows. */
function visibleContours({ view, started, contours }: Readonly<State>): Contour[] {
  return view === "curves" && !started ? [] : contours;
}

function drawContours(
  context: CanvasRenderingContext2D,
  pane: Pane,
  contours: Contour[],
  colours: string[],
): void {
  context.lineJoin = "round";
  for (const { label, closed, points } of contours) {
    const path = new Path2D();
    let lastX = Number.NaN;
    let lastY = Number.NaN;
    for (let i = 0; i + 1 < points.length; i += 2) {
      const x = pane.left + (points[i]! + 0.5) * pane.scale;
      const y = pane.top + (points[i + 1]! + 0.5) * pane.scale;
      // Points nearer than the screen can show only take time; the first has no last and stays.
      if (Math.abs(x - lastX) < 1 && Math.abs(y - lastY) < 1) continue;
      path.lineTo(x, y);
      [lastX, lastY] = [x, y];
    }
    if (closed) path.closePath();
    // A dark rim keeps the line legible on light texture, as a light core does on dark.
    context.lineWidth = 5;
    context.strokeStyle = "rgb(0 0 0 / 0.65)";
    context.stroke(path);
    context.lineWidth = 2.5;
    context.strokeStyle = colours[label] ?? "white";
    context.stroke(path);
  }
}

let captionElements: HTMLElement[] = [];

function caption(state: Readonly<State>): void {
  const place = byId("captions");
  captionElements = captionsOf(state).map((text) => make("span", {}, text));
  place.replaceChildren(...captionElements);
  lower.invalidate();
}

function placeCaptions(layout: Pane[]): void {
  for (const [i, element] of captionElements.entries()) {
    const pane = layout[i];
    if (!pane) continue;
    element.style.transform = `translate(${pane.left}px, ${pane.top - CAPTION_HEIGHT}px)`;
    element.style.maxWidth = `${store.state.width * pane.scale}px`;
  }
}

/** A picture under another's name would be mistaken for it: it dims, and its captions go. */
function wait(state: Readonly<State>): void {
  byId("stage").ariaBusy = String(awaited(state));
  byId("awaited").textContent = state.running ? "Drawn once this pass is done…" : "Being drawn…";
}

let beat: ReturnType<typeof setInterval> | undefined;

function flicker({ showing }: Readonly<State>): void {
  clearInterval(beat);
  flickerSecond = showing === "second";
  if (showing === "flicker") {
    beat = setInterval(() => {
      flickerSecond = !flickerSecond;
      lower.invalidate();
    }, FLICKER_MS);
  }
  lower.invalidate();
}
