/**
 * Drawing and moving curves with mouse, pen or finger; the keyboard's way is in `keys.ts`.
 *
 * Circle: press at the centre, pull out the radius. Freehand: draw round the object, let go. Polygon:
 * a click for each corner, the first or the last corner again (or Enter) closes. Select: drag a curve, or its
 * handle to resize it.
 */

import { add, select } from "../curves";
import { byId } from "../dom";
import { store } from "../store";
import type { Point, Shape } from "../worker/protocol";
import { giveUp, holding, letGo, pull, takeHold, type Hit } from "./grip";
import { handle, HANDLE, outline } from "./outline";
import { stagePane, toFrame, toStage, type Pane } from "./place";

/** Least distance between two points of a freehand line, in CSS pixels. */
const STRIDE = 4;

/** How steady a pointer is, in CSS pixels. */
interface Pointer {
  /** How near to a curve, handle or first corner it must come. */
  reach: number;
  /** How far it may wander in what is still a click. */
  tremor: number;
}
const MOUSE: Pointer = { reach: 9, tremor: 4 };
const FINGER: Pointer = { reach: 22, tremor: 12 };

/** What is being drawn and is no curve yet. */
export interface Sketch {
  tool: "circle" | "freehand" | "polygon";
  points: Point[];
  /** Where the pointer is. */
  tip: Point | null;
}

let sketch: Sketch | null = null;
/** The same before the last press, which may turn out to have been the first of two fingers. */
let before: Sketch | null = null;
/** The keyboard's pointer, in pixels of the frame; `null` while the mouse is used. */
let crosshair: Point | null = null;
const listeners: (() => void)[] = [];
const changed = () => listeners.forEach((listener) => listener());

export const sketchChanged = (listener: () => void): void => {
  listeners.push(listener);
};

export const currentSketch = (): Sketch | null => sketch;
export const currentCrosshair = (): Point | null => crosshair;

export function setSketch(next: Sketch | null): void {
  sketch = next;
  changed();
}

export function setCrosshair(next: Point | null): void {
  crosshair = next;
  changed();
}

/** Takes the last press back. */
export function abandon(): void {
  giveUp();
  setSketch(before);
}

/** Turns the sketch into a curve, if it encloses anything. */
export function finish(): void {
  const done = sketch;
  setSketch(null);
  if (!done) return;
  const { width } = store.state;
  if (done.tool === "circle") {
    const [centre] = done.points;
    if (!centre) return;
    const r = done.tip ? Math.hypot(done.tip[0] - centre[0], done.tip[1] - centre[1]) : 0;
    // A mere click is a circle too, of a size that can be seen and pulled.
    add({ kind: "circle", x: centre[0], y: centre[1], r: r < 2 ? width / 12 : r });
  } else if (done.points.length >= 3) {
    add({ kind: "polygon", points: done.points });
  } else {
    return;
  }
  store.update({ tool: "select" });
}

export function mountTools(): void {
  const overlay = byId<HTMLCanvasElement>("overlay");
  overlay.addEventListener("pointerdown", (event) => {
    if (event.button !== 0 || !event.isPrimary || store.state.view !== "curves") return;
    overlay.setPointerCapture(event.pointerId);
    setCrosshair(null);
    press(at(event), event.pointerType === "mouse" ? MOUSE : FINGER);
  });
  overlay.addEventListener("pointermove", (event) => {
    if (!event.isPrimary || store.state.view !== "curves") return;
    const steps = event.getCoalescedEvents?.() ?? [];
    for (const step of steps.length > 0 ? steps : [event]) drag(at(step));
    if (!holding() && !sketch) overlay.style.cursor = cursorAt(at(event));
  });
  overlay.addEventListener("pointerup", (event) => event.isPrimary && release());
  overlay.addEventListener("pointercancel", () => {
    giveUp();
    if (sketch?.tool !== "polygon") setSketch(null);
  });
  store.watch(
    ({ tool, view, source }) => [tool, view, source],
    () => setSketch(null),
  );
}

function press(place: Point, pointer: Pointer): void {
  before = sketch;
  const { tool, selected } = store.state;
  const pixel = toFrame(stagePane(), place);
  if (tool === "select") {
    const hit = found(place, pointer.reach);
    // A finger also scrolls: it moves a curve only after having chosen it.
    const mine = pointer === MOUSE || hit?.index === selected;
    select(hit?.index ?? null);
    if (hit && mine) takeHold(hit, place, pointer.tremor);
  } else if (tool === "polygon") {
    addCorner(pixel, pointer);
  } else {
    setSketch({ tool, points: [pixel], tip: pixel });
  }
}

/** The next corner of a polygon; one that is there already, as of a double click, closes it. */
function addCorner(pixel: Point, { reach, tremor }: Pointer): void {
  const points = sketch?.points ?? [];
  const near = (corner: Point | undefined, distance: number) =>
    corner !== undefined && apart(corner, pixel) * stagePane().scale < distance;
  const again = near(points.at(-1), tremor);
  if (points.length >= 3 && (again || near(points[0], reach))) finish();
  else if (!again) setSketch({ tool: "polygon", points: [...points, pixel], tip: pixel });
}

function drag(place: Point): void {
  pull(place);
  if (sketch) {
    const pixel = toFrame(stagePane(), place);
    const last = sketch.points.at(-1);
    const far = last && apart(toStage(stagePane(), last), place) >= STRIDE;
    const points = sketch.tool === "freehand" && far ? [...sketch.points, pixel] : sketch.points;
    setSketch({ ...sketch, points, tip: pixel });
  }
}

function release(): void {
  letGo();
  if (sketch && sketch.tool !== "polygon") finish();
}

/** The curve under a place of the stage; the selected one and the latest drawn come first. */
function found(place: Point, near: number): Hit | null {
  const { shapes, selected } = store.state;
  const pane = stagePane();
  const chosen = selected === null ? undefined : shapes[selected];
  if (chosen && apart(toStage(pane, handle(chosen)), place) <= Math.max(near, HANDLE)) {
    return { index: selected!, resizing: true };
  }
  const order = shapes.map((_, i) => i).reverse();
  if (selected !== null) order.unshift(selected);
  for (const index of order) {
    if (touches(shapes[index]!, pane, place, near)) return { index, resizing: false };
  }
  return null;
}

const probe = new OffscreenCanvas(1, 1).getContext("2d")!;

function touches(shape: Shape, pane: Pane, place: Point, near: number): boolean {
  const path = outline(shape, pane);
  probe.lineWidth = 2 * near;
  return probe.isPointInPath(path, ...place) || probe.isPointInStroke(path, ...place);
}

function cursorAt(place: Point): string {
  if (store.state.tool !== "select") return "crosshair";
  const hit = found(place, MOUSE.reach);
  return hit ? (hit.resizing ? "nwse-resize" : "move") : "default";
}

const apart = (a: Point, b: Point) => Math.hypot(a[0] - b[0], a[1] - b[1]);

function at(event: { clientX: number; clientY: number }): Point {
  const box = byId("overlay").getBoundingClientRect();
  return [event.clientX - box.left, event.clientY - box.top];
}

/** Draws the sketch and the keyboard's crosshair. */
export function drawSketch(context: CanvasRenderingContext2D, pane: Pane): void {
  if (sketch) {
    const path = new Path2D();
    const { tool, points, tip } = sketch;
    if (tool === "circle" && points[0] && tip) {
      const [x, y] = toStage(pane, points[0]);
      path.arc(x, y, apart(points[0], tip) * pane.scale, 0, 2 * Math.PI);
    } else {
      for (const point of points) path.lineTo(...toStage(pane, point));
      if (tip && tool === "polygon") path.lineTo(...toStage(pane, tip));
    }
    twice(context, path);
    if (tool === "polygon") {
      for (const point of points) {
        const corner = new Path2D();
        corner.arc(...toStage(pane, point), 4, 0, 2 * Math.PI);
        context.fillStyle = "white";
        context.fill(corner);
      }
    }
  }
  if (crosshair) {
    const [x, y] = toStage(pane, crosshair);
    const path = new Path2D();
    path.moveTo(x - 14, y);
    path.lineTo(x + 14, y);
    path.moveTo(x, y - 14);
    path.lineTo(x, y + 14);
    twice(context, path);
  }
}

function twice(context: CanvasRenderingContext2D, path: Path2D): void {
  context.lineJoin = "round";
  context.lineWidth = 4;
  context.strokeStyle = "rgb(0 0 0 / 0.7)";
  context.stroke(path);
  context.lineWidth = 2;
  context.strokeStyle = "white";
  context.stroke(path);
}

/** A first circle for the keyboard: in the middle, of a size that leaves room. */
export function addAtCentre(): void {
  const { width, height, shapes } = store.state;
  // A little aside of those already there, so that none hides another.
  const aside = (shapes.length % 5) * (width / 16);
  const r = Math.min(width, height) / 7;
  add({ kind: "circle", x: (width - 1) / 2 + aside, y: (height - 1) / 2, r });
}
