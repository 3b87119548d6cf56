// Hot kernels by themselves, in a WebAssembly module that only differs from the shipped one by its feature `bench`:
// how far each is from what its memory traffic and its arithmetic must take.
//
//   bound = max(bytes per pixel / speed of a copy loop, flops per pixel / speed of a multiply-add loop)

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { pathToFileURL } from "node:url";

import { root } from "../../scripts/shell.js";
import { median } from "./statistics.js";
import { number } from "./table.js";

/** Seconds that a sample takes at least. */
const SAMPLE = 0.02;
const SIZES = [
  [320, 240],
  [1280, 720],
];

/** @typedef {{ name: string, pixels: number, bytes: number, flops: number }} Kernel per pixel */

export const HEAD = [
  "kernel",
  "pixels",
  "ns/px",
  "bytes/px",
  "flops/px",
  "bound, ns/px",
  "by",
  "÷ bound",
];

/**
 * @param {string} folder of the module
 * @param {number} rounds
 * @returns {Promise<string[][]>}
 */
export async function rows(folder, rounds) {
  const bound = await import(pathToFileURL(join(root, folder, "relievo.js")).href);
  bound.initSync({ module: readFileSync(join(root, folder, "relievo_bg.wasm")) });
  return SIZES.flatMap(([width, height]) => {
    const kernels = new bound.Kernels(width, height);
    const list = /** @type {Kernel[]} */ (JSON.parse(kernels.list()));
    const run = (/** @type {number} */ i, /** @type {number} */ times) => kernels.run(i, times);
    return described(list, times(list, run, rounds));
  });
}

/**
 * Nanoseconds a pixel of each kernel; they take turns.
 * @param {Kernel[]} list
 * @param {(i: number, times: number) => void} run
 * @param {number} rounds
 */
function times(list, run, rounds) {
  const seconds = (/** @type {number} */ i, /** @type {number} */ repeats) => {
    const start = performance.now();
    run(i, repeats);
    return (performance.now() - start) / 1000;
  };
  const repeats = list.map((_, i) => {
    let count = 1;
    while (seconds(i, count) < SAMPLE) count *= 2;
    return count;
  });
  const samples = list.map(() => /** @type {number[]} */ ([]));
  for (let round = 0; round < rounds; round++) {
    list.forEach(({ pixels }, i) => {
      const count = repeats[i] ?? 1;
      samples[i]?.push((1e9 * seconds(i, count)) / count / pixels);
    });
  }
  return samples.map((each) => median(each) ?? NaN);
}

/**
 * Rows; the first kernel is the copy loop, the second the multiply-add loop.
 * @param {Kernel[]} list
 * @param {number[]} found ns a pixel
 */
export function described(list, found) {
  const perByte = (found[0] ?? NaN) / (list[0]?.bytes ?? NaN);
  const perFlop = (found[1] ?? NaN) / (list[1]?.flops ?? NaN);
  return list.map(({ name, pixels, bytes, flops }, i) => {
    const [memory, arithmetic] = [bytes * perByte, flops * perFlop];
    const least = Math.max(memory, arithmetic);
    const time = found[i] ?? NaN;
    return [
      name,
      String(pixels),
      number(time),
      number(bytes),
      number(flops),
      number(least),
      memory >= arithmetic ? "bytes" : "flops",
      number(time / least),
    ];
  });
}
