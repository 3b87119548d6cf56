// Whether something made is still what its sources would make: a hash of the sources, kept beside it.

import { createHash } from "node:crypto";
import { existsSync, readdirSync, readFileSync, statSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { root } from "./shell.js";

/**
 * Makes something unless its sources are the same as last time.
 * @param {string} folder where the result goes
 * @param {string[]} sources files and folders, relative to the checkout
 * @param {() => Promise<unknown>} make
 */
export async function unlessFresh(folder, sources, make) {
  const note = join(root, folder, ".stamp");
  const hash = hashOf(sources);
  if (existsSync(note) && readFileSync(note, "utf8") === hash) return;
  await make();
  writeFileSync(note, hash);
}

/** @param {string[]} sources */
function hashOf(sources) {
  const hash = createHash("sha256");
  for (const source of sources) addTo(hash, source);
  return hash.digest("hex");
}

/**
 * @param {import("node:crypto").Hash} hash
 * @param {string} path
 */
function addTo(hash, path) {
  const full = join(root, path);
  if (!existsSync(full)) return;
  if (statSync(full).isDirectory()) {
    for (const name of readdirSync(full).sort()) addTo(hash, join(path, name));
  } else {
    hash.update(path).update(readFileSync(full));
  }
}
