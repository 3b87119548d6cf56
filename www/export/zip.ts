/** Many files as one, made piece by piece so that the page stays free. */

import type { Bytes } from "./gather";
import { COMPRESSED } from "./items";

/** Compressed at a time, bytes: a hundredth of a second. */
const PIECE = 1 << 18;

export interface Zipper {
  add: (name: string, bytes: Bytes) => Promise<void>;
  done: () => Promise<Blob>;
}

export async function zipper(): Promise<Zipper> {
  const { Zip, ZipDeflate, ZipPassThrough } = await import("fflate");
  const pieces: Bytes[] = [];
  let close: (error?: Error) => void = () => {};
  const closed = new Promise<void>((resolve, reject) => {
    close = (error) => (error ? reject(error) : resolve());
  });
  closed.catch(() => {});
  const zip = new Zip((error, piece, last) => {
    if (error) return close(error);
    pieces.push(piece as Bytes);
    if (last) close();
  });
  return {
    async add(name, bytes) {
      const entry = COMPRESSED.test(name) ? new ZipPassThrough(name) : new ZipDeflate(name);
      zip.add(entry);
      let at = 0;
      do {
        const end = Math.min(bytes.length, at + PIECE);
        entry.push(bytes.subarray(at, end), end === bytes.length);
        at = end;
        await new Promise((next) => setTimeout(next));
      } while (at < bytes.length);
    },
    async done() {
      zip.end();
      await closed;
      return new Blob(pieces, { type: "application/zip" });
    },
  };
}
