/**
 * Zoom and pan: the wheel or two fingers zoom about where they are, a double click goes between the whole frame and its
 * own pixels, the middle button (or whatever has nothing else to do) drags the picture. Keys: + and −, 0 for the whole
 * frame, 1 for its own pixels.
 */

import { byId } from "../dom";
import { percent } from "../format";
import { store } from "../store";
import type { Point } from "../worker/protocol";
import { holding } from "./grip";
import {
  about,
  FITTING,
  presentPanes,
  stagePane,
  toFrame,
  within,
  type Pane,
  type Zoom,
} from "./place";
import { abandon, currentSketch } from "./tools";

/** What a press of a key or button does. */
const STEP = 1.5;
/** What a notch of the wheel does, for its 100 CSS pixels. */
const NOTCH = 1.3;
/** Where a frame's own pixels are no larger than it fits, a double click comes so much nearer. */
const CLOSER = 3;

export const presentZoom = (): Zoom => store.state.zoom;

const setZoom = (zoom: Zoom) => store.update({ zoom });

/** Brings a pixel of the frame into sight. */
export function bringIn([x, y]: Point): void {
  const { width, height } = store.state;
  const { zoom } = store.state;
  const [mx, my] = zoom.middle;
  const half = 0.45 / zoom.factor;
  const held = (share: number, middle: number) =>
    Math.abs(share - middle) <= half ? middle : share - Math.sign(share - middle) * half;
  const middle: Point = [held((x + 0.5) / width, mx), held((y + 0.5) / height, my)];
  if (middle[0] !== mx || middle[1] !== my) setZoom(within({ ...zoom, middle }));
}

function zoomTo(factor: number, place: Point = middleOfCell()): void {
  const { state } = store;
  if (!state.frames) return;
  setZoom(about(stagePane(), state, state.zoom, place, factor));
}

const middleOfCell = (): Point => {
  const { left, top, width, height } = stagePane().cell;
  return [left + width / 2, top + height / 2];
};

/** The factor at which a pixel of the frame is one of CSS. */
const ownPixels = () => presentZoom().factor / stagePane().scale;

/** Whether the key was one for the zoom. */
export function zoomKey(key: string): boolean {
  switch (key) {
    case "+":
    case "=":
      zoomTo(presentZoom().factor * STEP);
      return true;
    case "-":
    case "_":
      zoomTo(presentZoom().factor / STEP);
      return true;
    case "0":
      setZoom(FITTING);
      return true;
    case "1":
      zoomTo(ownPixels());
      return true;
    default:
      return false;
  }
}

export function mountZoom(): void {
  const overlay = byId<HTMLCanvasElement>("overlay");
  overlay.addEventListener(
    "wheel",
    (event) => {
      event.preventDefault();
      const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 33 : 1;
      zoomTo(presentZoom().factor * NOTCH ** ((-event.deltaY * lines) / 100), placeOf(event));
    },
    { passive: false },
  );
  overlay.addEventListener("dblclick", (event) => {
    if (store.state.view === "curves" && store.state.tool !== "select") return;
    if (presentZoom().factor > 1) setZoom(FITTING);
    else zoomTo(ownPixels() > 1.2 ? ownPixels() : CLOSER, placeOf(event));
  });
  mountDrag(overlay);
  byId("zoom-in").addEventListener("click", () => zoomKey("+"));
  byId("zoom-out").addEventListener("click", () => zoomKey("-"));
  byId("zoom-fit").addEventListener("click", () => zoomKey("0"));
  store.watch(
    ({ zoom }) => [zoom],
    ({ zoom }) => {
      byId("stage").dataset["zoomed"] = String(zoom.factor > 1);
    },
  );
}

/** Says how large the picture is, once it has been laid out. */
export function showZoom(): void {
  const scale = stagePane().scale;
  byId("zoom-level").textContent = percent(scale, 0);
  for (const id of ["zoom-out", "zoom-fit"]) {
    byId<HTMLButtonElement>(id).disabled = presentZoom().factor <= 1;
  }
}

function mountDrag(overlay: HTMLCanvasElement): void {
  /** The pointers on the stage, where they were last. */
  const down = new Map<number, Point>();
  let dragging = false;

  overlay.addEventListener("pointerdown", (event) => {
    if (event.pointerType !== "touch") down.clear();
    down.set(event.pointerId, placeOf(event));
    if (down.size > 1) {
      // The first finger was no drawing one.
      abandon();
      dragging = true;
      return;
    }
    const { view, tool } = store.state;
    const idle = view !== "curves" || (tool === "select" && !holding());
    dragging = event.button === 1 || (event.button === 0 && idle && !currentSketch());
    if (event.button === 1) event.preventDefault();
    if (dragging) overlay.setPointerCapture(event.pointerId);
  });
  overlay.addEventListener("pointermove", (event) => {
    const last = down.get(event.pointerId);
    if (!last || !dragging) return;
    const before = [...down.values()];
    const here = placeOf(event);
    down.set(event.pointerId, here);
    const after = [...down.values()];
    follow(before, after);
  });
  for (const end of ["pointerup", "pointercancel"] as const) {
    overlay.addEventListener(end, (event) => {
      down.delete(event.pointerId);
      if (down.size === 0) dragging = false;
    });
  }
}

/** What lay under the fingers stays under them. */
function follow(before: Point[], after: Point[]): void {
  const pane = stagePane();
  const { width, height, zoom } = store.state;
  const from = meanOf(before);
  const to = meanOf(after);
  const spread = (points: Point[], [x, y]: Point) =>
    points.reduce((sum, point) => sum + Math.hypot(point[0] - x, point[1] - y), 0);
  const apart = spread(before, from);
  const grown = before.length > 1 && apart > 0 ? spread(after, to) / apart : 1;
  const next = about(pane, { width, height }, zoom, from, zoom.factor * grown);
  const scale = (pane.scale / zoom.factor) * next.factor;
  const middle: Point = [
    next.middle[0] - (to[0] - from[0]) / scale / width,
    next.middle[1] - (to[1] - from[1]) / scale / height,
  ];
  setZoom(within({ ...next, middle }));
}

const meanOf = (points: Point[]): Point => [
  points.reduce((sum, [x]) => sum + x, 0) / points.length,
  points.reduce((sum, [, y]) => sum + y, 0) / points.length,
];

/** Where a pointer is on the stage. */
export function placeOf(event: { clientX: number; clientY: number }): Point {
  const box = byId("overlay").getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** The pixel of the frame under a place, if there is one: pictures that are alone may reach beyond their cell. */
export function pixelAt(place: Point): Point | null {
  const { width, height } = store.state;
  const all = presentPanes();
  const holds = ({ cell }: Pane) =>
    place[0] >= cell.left &&
    place[1] >= cell.top &&
    place[0] < cell.left + cell.width &&
    place[1] < cell.top + cell.height;
  const pane = all.length > 1 ? all.find(holds) : all[0];
  if (!pane) return null;
  const [x, y] = toFrame(pane, place).map(Math.round) as Point;
  return x >= 0 && y >= 0 && x < width && y < height ? [x, y] : null;
}
