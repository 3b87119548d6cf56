/** Frames and pictures of the core as the page shows them, and frames that are only looked at. */

import { decode, displacement, Frame, type Picture } from "./core";
import { keepDecoded, takeDecoded } from "./decoded";
import type { Displacement, FrameFile, Preview } from "./protocol";

/** Longest side of a frame sent to the page; more than a screen shows only costs memory. */
const LONGEST_SIDE = 2048;
/** Shortest side of frames between which motion is measured. */
const MEASURABLE = 16;

/** A picture made ready to draw off the main thread, no larger than a screen can use. */
export async function bitmap(
  picture: Picture | Frame,
  longest = LONGEST_SIDE,
): Promise<ImageBitmap> {
  const { width, height } = picture;
  const factor = Math.min(1, longest / Math.max(width, height));
  return createImageBitmap(picture.imageData(), {
    resizeWidth: Math.max(1, Math.round(width * factor)),
    resizeHeight: Math.max(1, Math.round(height * factor)),
    resizeQuality: "medium",
  });
}

/** The same of a frame by itself, its levels stretched where it uses few. */
async function stretched(frame: Frame, longest: number): Promise<ImageBitmap> {
  const shown = frame.stretched();
  try {
    return await bitmap(shown, longest);
  } finally {
    shown.free();
  }
}

/** A file to be looked at. */
export async function preview(file: FrameFile, longest: number): Promise<Preview> {
  const frame = await takeDecoded(file);
  try {
    const { width, height, interlaced } = frame;
    return { width, height, interlaced, picture: await stretched(frame, longest) };
  } finally {
    keepDecoded(file, frame);
  }
}

/** The two fields of an interlaced frame, even rows first, as PNG files. */
export async function fieldsOf(file: FrameFile): Promise<Uint8Array<ArrayBuffer>[]> {
  const frame = await decode(file);
  try {
    return await Promise.all(frame.fields().map(encoded));
  } finally {
    frame.free();
  }
}

async function encoded(frame: Frame): Promise<Uint8Array<ArrayBuffer>> {
  const canvas = new OffscreenCanvas(frame.width, frame.height);
  canvas.getContext("2d")!.putImageData(frame.imageData(), 0, 0);
  frame.free();
  return new Uint8Array(await (await canvas.convertToBlob()).arrayBuffer());
}

/** How far things move between two pictures; `null` when they differ in size or are too small to tell. */
export function measure(first: ImageBitmap, second: ImageBitmap): Displacement | null {
  const { width, height } = first;
  if (width !== second.width || height !== second.height) return null;
  if (Math.min(width, height) < MEASURABLE) return null;
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  const frame = (picture: ImageBitmap) => {
    context.drawImage(picture, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    return Frame.fromRgba(width, height, new Uint8Array(data.buffer));
  };
  const frames = [frame(first), frame(second)] as const;
  try {
    return JSON.parse(displacement(...frames)) as Displacement;
  } finally {
    frames.forEach((one) => one.free());
  }
}
