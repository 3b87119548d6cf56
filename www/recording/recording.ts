/** Recordings of solves, made when the page was built (`scripts/recordings.js` has the format), fetched one by one. */

import { unsqueeze } from "../worker/keeping";
import type { Camera, Contour, Found, Report, Shape } from "../worker/protocol";

export interface Pass {
  report: Report;
  contours: Contour[];
  /** Depth, where it changed. */
  picture: { width: number; height: number; rgb: Uint8Array } | null;
  /** Where the solver stood; empty where that takes too much. */
  state: Uint8Array<ArrayBuffer>;
}

export interface Recording {
  name: string;
  title: string;
  lesson: string;
  width: number;
  height: number;
  camera: Camera;
  shapes: Shape[];
  passes: Pass[];
  /** What the last pass came to. */
  found: Found;
}

const ADDRESSES: Record<string, string> = import.meta.glob("../../recordings/*.bin", {
  eager: true,
  query: "?url",
  import: "default",
});

const THUMBNAILS: Record<string, string> = import.meta.glob("../../recordings/*.png", {
  eager: true,
  query: "?url",
  import: "default",
});

/** Where the thumbnail of a sequence lies. */
export const thumbnailOf = (name: string) => THUMBNAILS[`../../recordings/${name}.png`];

export async function fetchRecording(name: string): Promise<Recording> {
  const address = ADDRESSES[`../../recordings/${name}.bin`];
  const answer = address ? await fetch(address) : null;
  if (!answer?.ok) throw new Error(`the recording of ${name} cannot be loaded`);
  return decode(new Uint8Array(await answer.arrayBuffer()));
}

async function decode(file: Uint8Array<ArrayBuffer>): Promise<Recording> {
  const end = 4 + lengthAt(file);
  const first = await unsqueeze(file.slice(4, end));
  let at = 4 + lengthAt(first);
  const { passes, ...head } = JSON.parse(new TextDecoder().decode(first.subarray(4, at)));
  const take = (count: number) => first.subarray(at, (at += count));
  for (const pass of passes) {
    const { picture, state } = pass;
    if (picture) picture.rgb = take(3 * picture.width * picture.height);
    pass.state = take(state).slice();
  }
  const { report, contours } = passes.at(-1);
  return { ...head, passes, found: { bytes: file.slice(end), report, contours } };
}

const lengthAt = (bytes: Uint8Array) =>
  new DataView(bytes.buffer, bytes.byteOffset).getUint32(0, true);

/** A recorded picture, ready to draw: samples are differences along rows, all of one colour before the next. */
export function bitmapOf({
  width,
  height,
  rgb,
}: NonNullable<Pass["picture"]>): Promise<ImageBitmap> {
  const image = new ImageData(width, height);
  for (let channel = 0, at = 0; channel < 3; channel++) {
    for (let pixel = 0, value = 0; pixel < width * height; pixel++, at++) {
      if (pixel % width === 0) value = 0;
      value = (value + rgb[at]!) & 255;
      image.data[4 * pixel + channel] = value;
      image.data[4 * pixel + 3] = 255;
    }
  }
  return createImageBitmap(image);
}
