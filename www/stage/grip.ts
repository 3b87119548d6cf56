/**
 * A curve in the pointer's hand, from press to release.
 *
 * It follows only once the pointer has clearly left its place: hands tremble in a click, and a curve
 * that moves costs all that was computed from it. When anybody else changes the curves meanwhile,
 * there is nothing left to hold.
 */

import { middle, moved, preview, resized, settle } from "../curves";
import { store } from "../store";
import type { Point, Shape } from "../worker/protocol";
import { stagePane, toFrame, toStage } from "./place";

/** What a pointer hits: a curve, or the handle by which it is resized. */
export interface Hit {
  index: number;
  resizing: boolean;
}

interface Grip extends Hit {
  /** Where it was taken, in pixels of the frame. */
  start: Point;
  /** How far the pointer may wander before the curve follows, in CSS pixels; none once it does. */
  slack: number;
  /** All curves, as they were and as they were last shown. */
  before: Shape[];
  shown: Shape[];
}

let grip: Grip | null = null;

export function takeHold(hit: Hit, place: Point, slack: number): void {
  const { shapes } = store.state;
  const start = toFrame(stagePane(), place);
  grip = { ...hit, start, slack, before: shapes, shown: shapes };
}

export function holding(): boolean {
  return held() !== null;
}

function held(): Grip | null {
  if (grip && grip.shown !== store.state.shapes) grip = null;
  return grip;
}

export function pull(place: Point): void {
  const grip = held();
  if (!grip) return;
  const { index, resizing, start, before } = grip;
  const [fromX, fromY] = toStage(stagePane(), start);
  if (Math.hypot(place[0] - fromX, place[1] - fromY) < grip.slack) return;
  grip.slack = 0;
  const [x, y] = toFrame(stagePane(), place);
  const shape = before[index]!;
  const [mx, my] = middle(shape);
  const factor = Math.hypot(x - mx, y - my) / Math.hypot(start[0] - mx, start[1] - my);
  const pulled = resizing ? resized(shape, factor) : moved(shape, x - start[0], y - start[1]);
  grip.shown = before.with(index, pulled);
  preview(grip.shown);
}

/** Leaves the curve where it is. */
export function letGo(): void {
  const done = held();
  grip = null;
  if (done && done.shown !== done.before) settle(done.before);
}

/** Puts the curve back where it was. */
export function giveUp(): void {
  const undone = held();
  grip = null;
  if (undone) preview(undone.before);
}
