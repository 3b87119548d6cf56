// What the tests of the command line share: running it, folders that go away, frames made here.

import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

const PROGRAM = fileURLToPath(new URL("../../cli/relievo.js", import.meta.url));

export const folder = mkdtempSync(join(tmpdir(), "relievo-"));
process.on("exit", () => rmSync(folder, { recursive: true, force: true }));

/** @param {string[]} words */
export function relievo(...words) {
  const { status, stdout, stderr } = spawnSync(process.execPath, [PROGRAM, ...words], {
    cwd: folder,
    encoding: "utf8",
  });
  return { status, stdout, stderr };
}

/**
 * Writes a file into the folder; its path.
 * @param {string} name
 * @param {Uint8Array | string} bytes
 */
export function file(name, bytes) {
  const path = join(folder, name);
  writeFileSync(path, bytes);
  return path;
}

/**
 * A grey frame in PGM.
 * @param {number} width
 * @param {number} height
 * @param {(x: number, y: number) => number} grey
 */
export function pgm(width, height, grey) {
  const pixels = Array.from({ length: width * height }, (_, i) =>
    Math.round(grey(i % width, Math.floor(i / width))),
  );
  return Buffer.concat([Buffer.from(`P5\n${width} ${height}\n255\n`), Buffer.from(pixels)]);
}

/**
 * Something to see move: waves in two directions.
 * @param {number} shift to the right, in pixels
 */
export const waves = (shift) => (/** @type {number} */ x, /** @type {number} */ y) =>
  128 + 60 * Math.sin((x - shift) / 3) * Math.cos(y / 4) + 40 * Math.sin((x - shift) / 7 + y / 5);
