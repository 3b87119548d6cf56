// The WebAssembly side of the speed tables, in Node: answers what `main.rs` answers, with the module in `pkg/`.

import { readFileSync } from "node:fs";
import { join } from "node:path";
import { createInterface } from "node:readline";

import { Frame, initSync, Solver } from "../../pkg/relievo.js";
import { score } from "./scores.js";

const bytes = readFileSync(new URL("../../pkg/relievo_bg.wasm", import.meta.url));
const { memory } = initSync({ module: bytes });
const base = memory.buffer.byteLength;

/** @typedef {{ work: string, folder: string, preset: string, usable?: number | null }} Request */

/** Seconds since some moment. */
const now = () => performance.now() / 1000;

/** @param {string} folder */
function read(folder) {
  const about = JSON.parse(readFileSync(join(folder, "scene.json"), "utf8"));
  const frame = (/** @type {number} */ i) =>
    Frame.fromRgba(about.width, about.height, readFileSync(join(folder, `frame${i}.rgba`)));
  return { about, frames: /** @type {[Frame, Frame, Frame]} */ ([0, 1, 2].map(frame)) };
}

/**
 * The truth about frames i and i + 1.
 * @param {string} folder
 * @param {number} i
 */
function truth(folder, i) {
  const flow = readFileSync(join(folder, `flow${i}.flo`)).subarray(12);
  return {
    flow: new Float32Array(Uint8Array.from(flow).buffer),
    labels: Uint8Array.from(readFileSync(join(folder, `labels${i}.u8`))),
  };
}

/**
 * @param {ReturnType<typeof read>} sequence
 * @param {string} preset
 */
function begin({ about, frames }, preset) {
  return new Solver(frames[0], frames[1], about.camera, about.curves, { preset });
}

/** @param {Solver} solver @param {ReturnType<typeof truth>} known */
function scored(solver, known) {
  const found = { labels: solver.labels(), u: solver.flowU(), v: solver.flowV() };
  return score(found, known);
}

/** @param {Solver} solver */
function finish(solver) {
  while (solver.step() === "running");
}

/**
 * Goes on with `frame`; false where the solver cannot.
 * @param {any} solver
 * @param {Frame} frame
 */
function next(solver, frame) {
  if (typeof solver.next !== "function") return false;
  solver.next(frame);
  finish(solver);
  return true;
}

/**
 * Scores every pass.
 * @param {ReturnType<typeof read>} sequence
 * @param {Request} request
 */
function trial(sequence, { folder, preset }) {
  const solver = begin(sequence, preset);
  const known = truth(folder, 0);
  const scores = [];
  do {
    solver.step();
    scores.push(scored(solver, known));
  } while (solver.status === "running");
  const { status } = solver;
  const further = next(solver, sequence.frames[2]) ? scored(solver, truth(folder, 1)) : null;
  solver.free();
  return { status, scores, next: further };
}

/**
 * Solves against the clock; nothing is scored while it runs.
 * @param {ReturnType<typeof read>} sequence
 * @param {Request} request
 */
function timed(sequence, { preset, usable }) {
  const start = now();
  const solver = begin(sequence, preset);
  let usableAt = null;
  for (let pass = 1; ; pass++) {
    const status = solver.step();
    if (pass === usable) usableAt = now() - start;
    if (status !== "running") break;
  }
  const total = now() - start;
  const { motion, depth, curves } = JSON.parse(solver.report()).seconds;
  const further = now();
  const went = next(solver, sequence.frames[2]);
  const answer = {
    total,
    motion,
    depth,
    curves,
    usable: usableAt,
    next: went ? now() - further : null,
  };
  solver.free();
  return answer;
}

/**
 * Solves in a fresh instance.
 * @param {ReturnType<typeof read>} sequence
 * @param {Request} request
 */
function grown(sequence, { preset }) {
  const solver = begin(sequence, preset);
  finish(solver);
  return { bytes: memory.buffer.byteLength - base };
}

const WORK = /** @type {Record<string, typeof trial | typeof timed | typeof grown>} */ ({
  trial,
  solve: timed,
  memory: grown,
});

for await (const line of createInterface({ input: process.stdin })) {
  /** @type {Request} */
  const request = JSON.parse(line);
  let answer;
  try {
    const sequence = read(request.folder);
    answer = WORK[request.work]?.(sequence, request) ?? { error: `no such work: ${request.work}` };
    sequence.frames.forEach((frame) => frame.free());
  } catch (error) {
    answer = { error: String(error) };
  }
  console.log(JSON.stringify(answer));
}
