/**
 * Frames that were decoded to be looked at. What is looked at is opened next as a rule, and to decode a photo takes a
 * second.
 */

import { decode, type Frame } from "./core";
import type { FrameFile } from "./protocol";

/** Two are opened together. */
const MOST = 2;
/** Larger ones take too much memory to be kept, pixels. */
const LARGEST = 25e6;

let held: { bytes: Uint8Array; frame: Frame }[] = [];

/** Keeps a frame that is not needed now. */
export function keepDecoded({ bytes }: FrameFile, frame: Frame): void {
  if (frame.width * frame.height > LARGEST) return frame.free();
  held.push({ bytes, frame });
  for (const old of held.splice(0, held.length - MOST)) old.frame.free();
}

/** The frame in a file, the caller's from now on. */
export async function takeDecoded(file: FrameFile): Promise<Frame> {
  const found = held.find(({ bytes }) => same(bytes, file.bytes));
  if (!found) return decode(file);
  held = held.filter((one) => one !== found);
  return found.frame;
}

const same = (a: Uint8Array, b: Uint8Array) =>
  a.length === b.length && a.every((byte, i) => byte === b[i]);
