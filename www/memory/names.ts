/** A name for a pair, the same whenever the same frames are opened: a sequence's own, or made from the files' bytes. */

import type { Source } from "../worker/protocol";

const OWN = "own-";

const known = new WeakMap<Source, Promise<string>>();

export function nameOf(source: Source): Promise<string> {
  if (source.kind === "scene") return Promise.resolve(source.name);
  const name = known.get(source) ?? digest(source.first.bytes, source.second.bytes);
  known.set(source, name);
  return name;
}

export const isOwn = (name: string) => name.startsWith(OWN);

async function digest(...parts: Uint8Array<ArrayBuffer>[]): Promise<string> {
  // Only pages of this device or sent encrypted may digest; elsewhere a pair has a name for as long as it is open.
  if (!globalThis.crypto.subtle) return OWN + crypto.getRandomValues(new Uint32Array(2)).join("");
  const digests = await Promise.all(parts.map((part) => crypto.subtle.digest("SHA-256", part)));
  const joined = await crypto.subtle.digest("SHA-256", await new Blob(digests).arrayBuffer());
  const bytes = [...new Uint8Array(joined).slice(0, 8)];
  return OWN + bytes.map((byte) => byte.toString(16).padStart(2, "0")).join("");
}
