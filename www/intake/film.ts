/**
 * Moments in order, of which two can be chosen: a clip, an animation, shots, or a pile of photos.
 *
 * A moment that is chosen leaves as a file, so that the pair can be opened again from nothing else.
 */

import type { FrameFile } from "../worker/protocol";

export interface Film {
  /** What people call it. */
  readonly name: string;
  /** How many frames it has. */
  readonly count: number;
  /** What frame `index` is called: when it was, or its file. */
  label(index: number): string;
  /** Frame `index`, its longer side `longest` pixels at most. */
  picture(index: number, longest: number): Promise<ImageBitmap>;
  /** Frame `index` in full. */
  file(index: number): Promise<FrameFile>;
  /** Lets go of all it holds. */
  close(): void;
}

type Draw = (context: OffscreenCanvasRenderingContext2D, width: number, height: number) => void;

/** A picture of `width` × `height` pixels, drawn no larger than asked for. */
export function drawn(width: number, height: number, longest: number, draw: Draw): ImageBitmap {
  return canvasOf(width, height, longest, draw).transferToImageBitmap();
}

/** Anything that can be drawn, as a picture no larger than asked for. */
export function fitted(picture: ImageBitmap | VideoFrame, longest: number): ImageBitmap {
  const width = "displayWidth" in picture ? picture.displayWidth : picture.width;
  const height = "displayHeight" in picture ? picture.displayHeight : picture.height;
  return drawn(width, height, longest, (context, w, h) => context.drawImage(picture, 0, 0, w, h));
}

/** A picture as a PNG, with nothing lost. */
export async function pngOf(name: string, picture: ImageBitmap): Promise<FrameFile> {
  const { width, height } = picture;
  const canvas = canvasOf(width, height, Infinity, (context) => context.drawImage(picture, 0, 0));
  picture.close();
  const blob = await canvas.convertToBlob({ type: "image/png" });
  return { name, bytes: new Uint8Array(await blob.arrayBuffer()) };
}

function canvasOf(width: number, height: number, longest: number, draw: Draw): OffscreenCanvas {
  const factor = Math.min(1, longest / Math.max(width, height, 1));
  const [w, h] = [width, height].map((side) => Math.max(1, Math.round(side * factor)));
  const canvas = new OffscreenCanvas(w!, h!);
  const context = canvas.getContext("2d")!;
  context.imageSmoothingQuality = "high";
  draw(context, w!, h!);
  return canvas;
}

/** Seconds as they are read on a film: 1:02.533. */
export function clock(seconds: number): string {
  const minutes = Math.floor(seconds / 60);
  const rest = (seconds - 60 * minutes).toFixed(3);
  return minutes > 0 ? `${minutes}:${rest.padStart(6, "0")}` : `${rest}\u00a0s`;
}

/** Lets one piece of work at a time through, in order. */
export function queue(): <T>(work: () => Promise<T>) => Promise<T> {
  let last: Promise<unknown> = Promise.resolve();
  return (work) => {
    const mine = last.then(work, work);
    last = mine.catch(() => {});
    return mine;
  };
}
