/** The drawn curves: full lines before the first pass, faint dashes once the real ones have left. */

import { extent, middle } from "../curves";
import type { State } from "../store";
import type { Contour, Point, Shape } from "../worker/protocol";
import { toStage, type Pane } from "./place";

/** Side of a handle, and how near a pointer must come to it, in CSS pixels. */
export const HANDLE = 10;

export function drawShapes(
  context: CanvasRenderingContext2D,
  pane: Pane,
  state: Readonly<State>,
): void {
  const { started } = state;
  for (const [i, shape] of state.shapes.entries()) {
    const chosen = i === state.selected;
    const colour = state.catalogues?.colours[i + 1] ?? "white";
    const path = outline(shape, pane);
    const faint = started && !chosen;
    context.save();
    context.lineJoin = "round";
    if (faint) context.setLineDash([4, 5]);
    context.globalAlpha = faint ? 0.75 : 1;
    context.lineWidth = faint ? 3 : 5;
    context.strokeStyle = "rgb(0 0 0 / 0.6)";
    context.stroke(path);
    context.lineWidth = faint ? 1.25 : 2.5;
    context.strokeStyle = faint ? "white" : colour;
    context.stroke(path);
    context.restore();
    if (chosen) {
      context.save();
      context.globalAlpha = 0.14;
      context.fillStyle = colour;
      context.fill(path);
      context.restore();
      drawHandle(context, toStage(pane, handle(shape)));
    }
    if (!started || chosen) drawName(context, toStage(pane, middle(shape)), `${i + 1}`);
  }
}

/** The curves where the solver has them. */
export function drawContours(
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

/** The corner by which a curve is resized. */
export function handle(shape: Shape): Point {
  const [x, y] = middle(shape);
  const [rx, ry] = extent(shape);
  return shape.kind === "circle"
    ? [x + rx * Math.SQRT1_2, y + ry * Math.SQRT1_2]
    : [x + rx, y + ry];
}

export function outline(shape: Shape, pane: Pane): Path2D {
  const path = new Path2D();
  if (shape.kind === "circle") {
    const [x, y] = toStage(pane, [shape.x, shape.y]);
    path.arc(x, y, shape.r * pane.scale, 0, 2 * Math.PI);
    return path;
  }
  for (const point of shape.points) path.lineTo(...toStage(pane, point));
  path.closePath();
  return path;
}

function drawHandle(context: CanvasRenderingContext2D, [x, y]: Point): void {
  context.beginPath();
  context.arc(x, y, HANDLE / 2 + 1, 0, 2 * Math.PI);
  context.fillStyle = "white";
  context.strokeStyle = "rgb(0 0 0 / 0.75)";
  context.lineWidth = 2;
  context.fill();
  context.stroke();
}

function drawName(context: CanvasRenderingContext2D, [x, y]: Point, name: string): void {
  context.font = "600 14px system-ui, sans-serif";
  context.textAlign = "center";
  context.textBaseline = "middle";
  context.lineWidth = 3.5;
  context.lineJoin = "round";
  context.strokeStyle = "rgb(0 0 0 / 0.7)";
  context.strokeText(name, x, y);
  context.fillStyle = "white";
  context.fillText(name, x, y);
}
