/**
 * Where pictures lie on the stage: one or several panes, each with one scale and one corner.
 *
 * Pixel (x, y) of the frame is centred at left + (x + ½) scale, top + (y + ½) scale, in CSS pixels.
 */

import type { Point } from "../worker/protocol";

export interface Pane {
  left: number;
  top: number;
  scale: number;
}

export interface Box {
  width: number;
  height: number;
}

/** Room for a picture's name above it, in CSS pixels; the stylesheet's line of text is as high. */
export const CAPTION_HEIGHT = 26;

let present: Pane[] = [];

/** Where the pictures lie that are on the stage now. */
export const presentPanes = (): Pane[] => present;

/** Where the first of them lies; tools translate between pointer and pixel with it. */
export const stagePane = (): Pane => present[0] ?? { left: 0, top: 0, scale: 1 };

export function setPanes(panes: Pane[]): void {
  present = panes;
}

/** `count` panes of the same size, as large as they fit in a row, a column or two of them. */
export function panes(stage: Box, frame: Box, count: number, caption: number): Pane[] {
  const margin = Math.min(16, stage.width / 40);
  const gap = 12;
  let best: { scale: number; columns: number } = { scale: 0, columns: 1 };
  for (let columns = 1; columns <= count; columns++) {
    const rows = Math.ceil(count / columns);
    const width = (stage.width - 2 * margin - (columns - 1) * gap) / columns / frame.width;
    const height =
      (stage.height - 2 * margin - (rows - 1) * gap - rows * caption) / rows / frame.height;
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
  const top = (stage.height - rows * height - (rows - 1) * gap) / 2;
  return Array.from({ length: count }, (_, i) => {
    const row = Math.floor(i / columns);
    return {
      left: left(row) + (i % columns) * (width + gap),
      top: top + row * (height + gap) + caption,
      scale,
    };
  });
}

export function toStage(pane: Pane, [x, y]: readonly [number, number]): Point {
  return [pane.left + (x + 0.5) * pane.scale, pane.top + (y + 0.5) * pane.scale];
}

export function toFrame(pane: Pane, [x, y]: readonly [number, number]): Point {
  return [(x - pane.left) / pane.scale - 0.5, (y - pane.top) / pane.scale - 0.5];
}
