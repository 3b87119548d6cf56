/**
 * Editing the initial curves: every change is a step that can be undone.
 *
 * While a curve is being dragged it is `preview`ed, and becomes a step when it is let go (`stage/grip.ts`).
 */

import { announce } from "./dom";
import { present, recorded } from "./memory/history";
import { look } from "./looking";
import { ask, configure } from "./session";
import { store, type State } from "./store";
import { text } from "./text";
import type { Point, Shape } from "./worker/protocol";

/** Shows the curves as they would be, without making a step of it. */
export function preview(shapes: Shape[]): void {
  store.update({ shapes });
}

/** Makes one step of everything previewed since the curves were `before`. */
export function settle(before: Shape[]): void {
  record(before, store.state.shapes, store.state.selected);
}

export function add(shape: Shape): void {
  const { shapes, catalogues } = store.state;
  const most = catalogues?.limits.maxCurves ?? 7;
  if (shapes.length >= most) {
    store.update({ message: text.curves.tooMany(most) });
    return;
  }
  record(shapes, [...shapes, shape], shapes.length);
  announce(text.curves.added(shapes.length + 1, describe(shape)));
}

export function replace(index: number, shape: Shape): void {
  const { shapes } = store.state;
  record(shapes, shapes.with(index, shape), index);
  announce(text.curves.changed(index + 1, describe(shape)));
}

export function remove(index: number): void {
  const { shapes } = store.state;
  if (!shapes[index]) return;
  record(shapes, shapes.toSpliced(index, 1), null);
  announce(text.curves.deleted(index + 1));
}

/** Puts the curves that the core finds by itself in place of those there are, as one step. */
export async function find(): Promise<void> {
  const { camera } = store.state;
  store.update({ view: "curves", tool: "select" });
  const found = await ask(text.curves.finding, (service) => service.find(camera));
  if (!found) return;
  const before = store.state.shapes;
  if (before.length + found.length > 0) record(before, found, null);
  const finding = text.curves.found(found.length);
  store.update({ finding });
  announce(finding);
}

export function select(index: number | null): void {
  const { shapes, selected } = store.state;
  if (index === selected) return;
  store.update({ selected: index });
  const shape = index === null ? undefined : shapes[index];
  if (shape) announce(text.curves.selected(index! + 1, describe(shape)));
}

function record(before: Shape[], after: Shape[], selected: number | null): void {
  const history = recorded({ ...present(), shapes: before });
  store.update({ ...history, ...scalesFor(after), shapes: after, selected, finding: null });
  void configure();
  void look();
}

/** Factors on depth belong to regions: with another number of them all start at 1 again, as their sliders do. */
function scalesFor(shapes: Shape[]): Partial<State> {
  return shapes.length === store.state.shapes.length ? {} : { scales: [] };
}

/** The same curve elsewhere. */
export function moved(shape: Shape, dx: number, dy: number): Shape {
  return shape.kind === "circle"
    ? { ...shape, x: shape.x + dx, y: shape.y + dy }
    : { ...shape, points: shape.points.map(([x, y]): Point => [x + dx, y + dy]) };
}

/** The same curve larger or smaller about its middle, never smaller than a pixel. */
export function resized(shape: Shape, factor: number): Shape {
  if (shape.kind === "circle") return { ...shape, r: Math.max(1, shape.r * factor) };
  const [mx, my] = middle(shape);
  const largest = Math.max(...extent(shape));
  factor = Math.max(factor, Math.min(1, 1 / largest));
  const points = shape.points.map(([x, y]): Point => [
    mx + (x - mx) * factor,
    my + (y - my) * factor,
  ]);
  return { ...shape, points };
}

/** Where a curve's name stands, and what resizing leaves in place. */
export function middle(shape: Shape): Point {
  if (shape.kind === "circle") return [shape.x, shape.y];
  const xs = shape.points.map(([x]) => x);
  const ys = shape.points.map(([, y]) => y);
  return [(Math.min(...xs) + Math.max(...xs)) / 2, (Math.min(...ys) + Math.max(...ys)) / 2];
}

/** Half the extent of a curve, for handles. */
export function extent(shape: Shape): Point {
  if (shape.kind === "circle") return [shape.r, shape.r];
  const xs = shape.points.map(([x]) => x);
  const ys = shape.points.map(([, y]) => y);
  return [(Math.max(...xs) - Math.min(...xs)) / 2, (Math.max(...ys) - Math.min(...ys)) / 2];
}

export function describe(shape: Shape): string {
  const [x, y] = middle(shape).map(Math.round) as Point;
  return shape.kind === "circle"
    ? text.curves.circle(x, y, Math.round(shape.r))
    : text.curves.outline(shape.points.length, x, y);
}
