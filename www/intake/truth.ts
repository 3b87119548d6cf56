/**
 * What is true of two frames, from files that come with them or after them: flow as .flo or KITTI's PNG, labels as 8-bit grey
 * PNG, depth as PFM or 16-bit grey PNG, motion.json. The core tells such a PNG from a frame.
 */

import { announce } from "../dom";
import { ask, takeTruth } from "../session";
import { store } from "../store";
import { text } from "../text";
import type { FrameFile } from "../worker/protocol";
import { bytesOf } from "./admit";

/** A file of a truth, and what it is. */
interface Known {
  file: FrameFile;
  kind: string;
}

/** Endings that no browser has a media type for. */
export const ENDINGS = ".flo,.pfm,.json";

/** Where the header of a PNG has the bits of a sample and the kind of colour. */
const HEADER = 26;

/** Files that may be of a truth by their first bytes. */
async function maybe(file: File): Promise<boolean> {
  const head = new Uint8Array(
    await file
      .slice(0, HEADER)
      .arrayBuffer()
      .catch(() => []),
  );
  const text = String.fromCharCode(...head);
  if (/^(PIEH|P[fF]\s|\s*\{)/.test(text)) return true;
  // One number a pixel, or three of 16 bits.
  return text.startsWith("\x89PNG") && (head[25] === 0 || (head[24] === 16 && head[25] === 2));
}

/** Files of a truth, and the others; `null` when some could not be read, which the message bar then explains. */
export async function partTruth(files: File[]): Promise<{ truth: Known[]; rest: File[] } | null> {
  const likely = await Promise.all(files.map(maybe));
  if (!likely.includes(true)) return { truth: [], rest: files };
  const read = await known(
    files.filter((_, i) => likely[i]),
    false,
  );
  if (!read) return null;
  const kinds = new Map(read.map(({ file, kind }) => [file.name, kind]));
  const truth = read.filter((one): one is Known => one.kind !== null);
  const isTruth = (file: File, i: number) => likely[i] && (kinds.get(file.name) ?? null) !== null;
  return { truth, rest: files.filter((file, i) => !isTruth(file, i)) };
}

function known(files: File[], said: boolean) {
  return ask(text.truth.reading, async (service) => {
    const read = await Promise.all(
      files.map(async (file) => ({ name: file.name, bytes: await bytesOf(file) })),
    );
    const kinds = await service.truthKinds(read, said);
    return read.map((file, i) => ({ file, kind: kinds[i]! }));
  });
}

/** Files that somebody says are of a truth. */
export async function takeSaid(files: File[]): Promise<void> {
  const read = files.length > 0 ? await known(files, true) : null;
  // What is none is named by the core.
  if (read) await attach(read.map(({ file, kind }) => ({ file, kind: kind ?? file.name })));
}

/** Takes a truth for the pair that is open; what was known of other kinds stays. */
export async function attach(files: Known[]): Promise<void> {
  const { source, title } = store.state;
  const names = files.map(({ file }) => file.name).join(", ");
  if (source?.kind !== "files") {
    store.update({ message: text.truth.noFrames(names, title) });
    return;
  }
  const given = new Set(files.map(({ kind }) => subject(kind)));
  const before = (source.truth ?? []).filter((file) => {
    const kind = kindOf.get(file);
    return kind !== undefined && !given.has(subject(kind));
  });
  for (const { file, kind } of files) kindOf.set(file, kind);
  const done = await takeTruth([...before, ...files.map(({ file }) => file)]);
  if (done) announce(text.truth.taken(names));
}

/** What each file of a truth is, for as long as the page is open; of one that was kept nothing is known, and it goes. */
const kindOf = new WeakMap<FrameFile, string>();

const subject = (kind: string) => (kind.split(".")[0] ?? kind).replace("disparity", "depth");
