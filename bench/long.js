// node bench/long.js [SOLVES]: solves of 64×48 in one instance of the WebAssembly, and what its memory does meanwhile.
// Memory of WebAssembly never shrinks, so that growth is what leaks, or what a later solve needs more of.

import { readFileSync } from "node:fs";

import { initSync, Scene, Solver } from "../pkg/relievo.js";
import { ifMain } from "../scripts/shell.js";

const { memory } = initSync({
  module: readFileSync(new URL("../pkg/relievo_bg.wasm", import.meta.url)),
});

/** Rendered once each; the solves take turns with them. */
const SCENES = ["squares", "blocks", "carousel", "flight"];

/**
 * Bytes of the instance's memory after each solve.
 * @param {number} count
 * @param {(done: number, bytes: number) => void} [told]
 */
export function solves(count, told = () => {}) {
  const made = SCENES.map((name) => new Scene(name, 64, 48));
  const sizes = [];
  for (let i = 0; i < count; i += 1) {
    const scene = /** @type {Scene} */ (made[i % made.length]);
    const [first, second] = [scene.first(), scene.second()];
    const options = { preset: i % 8 < 4 ? "best" : "paper", max_passes: 20 };
    const solver = new Solver(first, second, scene.cameraJson, scene.shapesJson, options);
    while (solver.step() === "running");
    const picture = solver.view("anaglyph", {});
    solver.files({});
    for (const used of [picture, solver, first, second]) used.free();
    sizes.push(memory.buffer.byteLength);
    told(i + 1, memory.buffer.byteLength);
  }
  for (const scene of made) scene.free();
  return sizes;
}

await ifMain(import.meta.url, () => {
  const count = Number(process.argv[2] ?? 10_000);
  const begin = performance.now();
  const sizes = solves(count, (done, bytes) => {
    if (done % 1000 === 0 || done === 100) console.log(`${done} solves: ${bytes / 2 ** 20} MiB`);
  });
  const grown = Number(sizes.at(-1)) - Number(sizes[Math.min(100, count) - 1]);
  const seconds = (performance.now() - begin) / 1000;
  console.log(`${grown} bytes more after ${count} solves than after 100; ${seconds.toFixed(0)} s`);
  if (grown > 0) process.exitCode = 1;
});
