// What the tests of the command line share: running it, folders that go away, frames made here.

import { spawnSync } from "node:child_process";
import { mkdtempSync, rmSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { join } from "node:path";
import { fileURLToPath } from "node:url";
import { deflateSync } from "node:zlib";

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
 * A grey PNG of 8 or 16 bits; with several pictures an animated one.
 * @param {number} width
 * @param {number} height
 * @param {((x: number, y: number) => number)[]} greys whole numbers, one function a picture
 * @param {{ bits?: 8 | 16, chunks?: Buffer[] }} options
 */
export function png(width, height, greys, { bits = 8, chunks = [] } = {}) {
  const header = Buffer.from([0, 0, 0, 0, 0, 0, 0, 0, bits, 0, 0, 0, 0]);
  header.writeUInt32BE(width, 0);
  header.writeUInt32BE(height, 4);
  const data = greys.map((grey) => {
    const rows = Array.from({ length: height }, (_, y) => {
      const row = Buffer.alloc(1 + (width * bits) / 8);
      for (let x = 0; x < width; x += 1) {
        const value = Math.round(grey(x, y));
        if (bits === 16) row.writeUInt16BE(value, 1 + 2 * x);
        else row[1 + x] = value;
      }
      return row;
    });
    return deflateSync(Buffer.concat(rows));
  });
  const number = (/** @type {number[]} */ ...values) => {
    const bytes = Buffer.alloc(4 * values.length);
    values.forEach((value, i) => bytes.writeUInt32BE(value, 4 * i));
    return bytes;
  };
  let order = 0;
  const pictures = data.flatMap((bytes, i) => {
    if (greys.length === 1) return [chunk("IDAT", bytes)];
    const place = number(order++, width, height, 0, 0);
    const control = chunk("fcTL", Buffer.concat([place, Buffer.from([0, 40, 3, 232, 0, 0])]));
    const body = i === 0 ? chunk("IDAT", bytes) : chunk("fdAT", number(order++), bytes);
    return [control, body];
  });
  const animated = greys.length > 1 ? [chunk("acTL", number(greys.length, 0))] : [];
  const start = Buffer.from("\x89PNG\r\n\x1a\n", "latin1");
  return Buffer.concat([
    ...[start, chunk("IHDR", header), ...chunks, ...animated],
    ...[...pictures, chunk("IEND")],
  ]);
}

/**
 * A chunk of a PNG.
 * @param {string} kind
 * @param {Buffer[]} parts
 */
export function chunk(kind, ...parts) {
  const body = Buffer.concat([Buffer.from(kind, "latin1"), ...parts]);
  const ends = Buffer.alloc(8);
  ends.writeUInt32BE(body.length - 4, 0);
  let crc = 0xffffffff;
  for (const byte of body) {
    crc ^= byte;
    for (let bit = 0; bit < 8; bit += 1) crc = crc & 1 ? (crc >>> 1) ^ 0xedb88320 : crc >>> 1;
  }
  ends.writeUInt32BE(~crc >>> 0, 4);
  return Buffer.concat([ends.subarray(0, 4), body, ends.subarray(4)]);
}

/**
 * Something to see move: waves in two directions.
 * @param {number} shift to the right, in pixels
 */
export const waves = (shift) => (/** @type {number} */ x, /** @type {number} */ y) =>
  128 + 60 * Math.sin((x - shift) / 3) * Math.cos(y / 4) + 40 * Math.sin((x - shift) / 7 + y / 5);
