/**
 * The stage: the pictures of the present view, the curves as they are, and the curves as drawn.
 *
 * Two canvases lie on each other. The lower one shows what was computed and changes with every
 * progress; the upper one shows what can be edited and takes pointer and keys (`tools.ts`).
 */

import { byId, make } from "../dom";
import { store, type Split, type State } from "../store";
import { text } from "../text";
import { asks, awaited, captionsOf, viewOf } from "../views";
import type { Contour } from "../worker/protocol";
import { SharpCanvas } from "./canvas";
import { drawContours, drawShapes } from "./outline";
import { dividerAt, placeDivider } from "./divider";
import {
  CAPTION_HEIGHT,
  magnified,
  panes,
  setPanes,
  stagePane,
  type Box,
  type Cell,
  type Pane,
} from "./place";
import { sideOf } from "./sides";
import { drawSketch, sketchChanged } from "./tools";
import { presentZoom, showZoom } from "./zoom";

const FLICKER_MS = 450;

let flickerSecond = false;

const lower = new SharpCanvas(byId<HTMLCanvasElement>("picture"), paintPictures);
const upper = new SharpCanvas(byId<HTMLCanvasElement>("overlay"), (context, { width, height }) => {
  const { state } = store;
  context.clearRect(0, 0, width, height);
  if (!state.frames) return;
  if (state.view === "curves") drawShapes(context, stagePane(), state);
  drawSketch(context, stagePane());
});

export function mountStage(): void {
  store.watch(
    ({ frames, pictures, pictured, contours, started, view, viewParams, catalogues, split }) => [
      frames,
      pictures,
      pictured,
      contours,
      started,
      view,
      viewParams,
      catalogues,
      split,
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
    ({ zoom }) => [zoom],
    () => {
      lower.invalidate();
      upper.invalidate();
    },
  );
  store.watch(
    ({ view, pictured, catalogues, width, viewParams, split }) => [
      split === null,
      view,
      pictured,
      catalogues,
      width,
      viewParams.compare,
    ],
    caption,
  );
  store.watch(
    ({ frames, view, viewParams, pictured, running, split }) => [
      split,
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
  const count = state.split ? 1 : Math.max(1, wanted);
  const layout = panes(size, frame, count, captioned ? CAPTION_HEIGHT : 0).map((pane) =>
    magnified(pane, frame, presentZoom()),
  );
  setPanes(layout);
  placeCaptions(layout);
  showZoom();
  if (state.split) return paintSides(context, size, state, state.split);
  for (const [i, pane] of layout.entries()) {
    const picture = wanted === 0 ? shownFrame(state) : state.pictures[i];
    context.save();
    if (count > 1) clipTo(context, pane.cell);
    paint(context, pane, state, picture);
    context.restore();
  }
}

const shownFrame = ({ frames }: Readonly<State>) => frames?.[flickerSecond ? 1 : 0];

/** One picture in its pane, with the curves that belong on it. */
function paint(
  context: CanvasRenderingContext2D,
  pane: Pane,
  state: Readonly<State>,
  picture: ImageBitmap | null | undefined,
): void {
  // A picture that has been replaced is empty.
  if (!picture?.width) return;
  const view = viewOf(state.view);
  const { width, height } = state;
  context.imageSmoothingQuality = "medium";
  // Under a zoom a pixel is a square; else it is a sample.
  context.imageSmoothingEnabled = !view.crisp && !(presentZoom().factor > 1 && pane.scale >= 2);
  context.drawImage(picture, pane.left, pane.top, width * pane.scale, height * pane.scale);
  if (view.curves && (view.id === "curves" || state.viewParams.curvesOnTop)) {
    drawContours(context, pane, visibleContours(state), state.catalogues?.colours ?? []);
  }
}

/** Both sides of the divider, each up to it. */
function paintSides(
  context: CanvasRenderingContext2D,
  size: Box,
  state: Readonly<State>,
  { left, right, at }: Split,
): void {
  placeDivider();
  const x = dividerAt(at);
  let next = 0;
  const pictures = [left, right].map((id) => {
    if (sideOf(id).picture) return state.pictures[next++];
    return state.frames?.[id === "frame second" ? 1 : 0];
  });
  const parts = [
    { left: 0, top: 0, width: x, height: size.height },
    { left: x, top: 0, width: size.width - x, height: size.height },
  ];
  for (const [i, part] of parts.entries()) {
    context.save();
    clipTo(context, part);
    paint(context, stagePane(), state, pictures[i]);
    context.restore();
  }
}

function clipTo(context: CanvasRenderingContext2D, { left, top, width, height }: Cell): void {
  context.beginPath();
  context.rect(left, top, width, height);
  context.clip();
}

/** Before anything was computed the contours are the drawn curves, which the upper canvas shows. */
function visibleContours({ view, started, contours }: Readonly<State>): Contour[] {
  return view === "curves" && !started ? [] : contours;
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
    const { left, top, width } = pane.cell;
    element.style.transform = `translate(${left}px, ${top - CAPTION_HEIGHT}px)`;
    element.style.maxWidth = `${width}px`;
  }
}

/** A picture under another's name would be mistaken for it: it dims, and its captions go. */
function wait(state: Readonly<State>): void {
  byId("stage").ariaBusy = String(awaited(state));
  const { drawnAfterPass, beingDrawn } = text.stage;
  byId("awaited").textContent = state.running ? drawnAfterPass : beingDrawn;
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
