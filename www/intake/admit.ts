/** One still picture as the core takes it: as it is, or as a PNG where only the browser reads it. */

import { text } from "../text";
import type { FrameFile } from "../worker/protocol";
import { pngOf } from "./film";
import { formatOf } from "./formats";

/** Reads a file; rejects with a sentence. */
export async function bytesOf(file: File, name = file.name): Promise<Uint8Array<ArrayBuffer>> {
  const gone = () => {
    throw new Error(text.files.unreadable(name));
  };
  return new Uint8Array(await file.arrayBuffer().catch(gone));
}

/** A file for the core; rejects with a sentence that names the format where nobody here reads it. */
export async function admit(file: File, unnamed: string): Promise<FrameFile> {
  const name = file.name || unnamed;
  const bytes = await bytesOf(file, name);
  const format = formatOf(bytes);
  const own = format === null || format.reader === "core" || ["PNG", "WebP"].includes(format.name);
  if (own) return { name, bytes };
  const blob = new Blob([bytes], { type: format.type });
  const picture =
    format.reader === "foreign" ? null : await createImageBitmap(blob).catch(() => null);
  if (!picture) {
    const { notHere, notInBrowser } = text.files;
    throw new Error((format.reader === "foreign" ? notHere : notInBrowser)(name, format.name));
  }
  return pngOf(name, picture);
}
