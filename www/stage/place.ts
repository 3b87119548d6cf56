/**
 * Where pictures lie on the stage: one or several cells, each with one scale and one corner.
 *
 * Pixel (x, y) of the frame is centred at left + (x + ½) scale, top + (y + ½) scale, in CSS pixels. A zoom magnifies the
 * picture about a point of the frame and is the same in all cells; at 1 the whole frame fills its cell.
 */

import type { Point } from "../worker/protocol";

export interface Box {
  width: number;
  height: number;
}

/** A part of the stage, in CSS pixels. */
export interface Cell extends Box {
  left: number;
  top: number;
}

export interface Pane {
  left: number;
  top: number;
  scale: number;
  /** Where the picture is when all of it is seen. */
  cell: Cell;
}

export interface Zoom {
  /** Times as large as it fits. */
  factor: number;
  /** What is in the middle of the cell, in shares of the frame's width and height. */
  middle: Point;
}

export const FITTING: Zoom = { factor: 1, middle: [0.5, 0.5] };

/** A pixel of the frame is drawn no larger than this, in CSS pixels. */
const LARGEST_PIXEL = 40;

/** Room for a picture's name above it, in CSS pixels; the stylesheet's line of text is as high. */
export const CAPTION_HEIGHT = 26;

/** On a narrow stage the zoom's bar has the room below the picture, in CSS pixels; elsewhere it lies in the corner. */
const NARROW = 560;
const BAR = 52;

let present: Pane[] = [];

/** Where the pictures lie that are on the stage now. */
export const presentPanes = (): Pane[] => present;

const NOWHERE: Pane = { left: 0, top: 0, scale: 1, cell: { left: 0, top: 0, width: 1, height: 1 } };

/** Where the first of them lies; tools translate between pointer and pixel with it. */
export const stagePane = (): Pane => present[0] ?? NOWHERE;

export function setPanes(panes: Pane[]): void {
  present = panes;
}

/** `count` panes of the same size, as large as they fit in a row, a column or two of them. */
export function panes(stage: Box, frame: Box, count: number, caption: number): Pane[] {
  const margin = Math.min(16, stage.width / 40);
  const gap = 12;
  const bar = stage.width < NARROW ? BAR : 0;
  let best: { scale: number; columns: number } = { scale: 0, columns: 1 };
  for (let columns = 1; columns <= count; columns++) {
    const rows = Math.ceil(count / columns);
    const width = (stage.width - 2 * margin - (columns - 1) * gap) / columns / frame.width;
    const height =
      (stage.height - bar - 2 * margin - (rows - 1) * gap - rows * caption) / rows / frame.height;
    const scale = Math.min(width, height);
    if (scale > best.scale) best = { scale, columns };
  }
  const { scale, columns } = best;
  const rows = Math.ceil(count / columns);
  const width = frame.width * scale;
  const height = frame.height * scale + caption;
  /** A last row that is not full stands in the middle. */
  const left = (row: number) => {
    const inRow = Math.min(columns, count - row * columns);
    return (stage.width - inRow * width - (inRow - 1) * gap) / 2;
  };
  const free = stage.height - rows * height - (rows - 1) * gap;
  const top = Math.min(free / 2, Math.max(margin, free - bar));
  return Array.from({ length: count }, (_, i) => {
    const row = Math.floor(i / columns);
    const corner = {
      left: left(row) + (i % columns) * (width + gap),
      top: top + row * (height + gap) + caption,
    };
    return { ...corner, scale, cell: { ...corner, width, height: height - caption } };
  });
}

/** The same pane under a zoom. */
export function magnified({ cell, scale }: Pane, frame: Box, { factor, middle }: Zoom): Pane {
  const size = scale * factor;
  return {
    left: cell.left + cell.width / 2 - middle[0] * frame.width * size,
    top: cell.top + cell.height / 2 - middle[1] * frame.height * size,
    scale: size,
    cell,
  };
}

/** The zoom by `factor` that leaves the point of the frame that is under `place` of the stage where it is. */
export function about(pane: Pane, frame: Box, zoom: Zoom, place: Point, factor: number): Zoom {
  const { cell } = pane;
  const fit = pane.scale / zoom.factor;
  const greatest = Math.max(1, LARGEST_PIXEL / fit);
  const next = Math.min(greatest, Math.max(1, factor));
  const [x, y] = toFrame(pane, place);
  const scale = fit * next;
  return within({
    factor: next,
    middle: [
      (x + 0.5 - (place[0] - cell.left - cell.width / 2) / scale) / frame.width,
      (y + 0.5 - (place[1] - cell.top - cell.height / 2) / scale) / frame.height,
    ],
  });
}

/** No part of a cell is left empty. */
export function within({ factor, middle }: Zoom): Zoom {
  const half = 0.5 / factor;
  const held = (share: number) => Math.min(1 - half, Math.max(half, share));
  return { factor, middle: [held(middle[0]), held(middle[1])] };
}

export function toStage(pane: Pane, [x, y]: readonly [number, number]): Point {
  return [pane.left + (x + 0.5) * pane.scale, pane.top + (y + 0.5) * pane.scale];
}

export function toFrame(pane: Pane, [x, y]: readonly [number, number]): Point {
  return [(x - pane.left) / pane.scale - 0.5, (y - pane.top) / pane.scale - 0.5];
}
