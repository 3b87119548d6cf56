// The built-in sequences solved once, in recordings/: what the page shows before its own solver is there.
//
// A recording is, little-endian: the length of its first part (u32); the first part, deflated: the length of a JSON head
// (u32), the head, and for each pass a picture of depth, one byte a sample, all red, then all green, then all blue, each
// sample less its left neighbour, and the solver's state, as far as there are any; and the second part, deflated: the
// result, as `Kept` reads it. Beside it lies a thumbnail.

import { mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";
import { deflateRawSync } from "node:zlib";

import { ifMain, root, stage } from "./shell.js";
import { setup } from "./setup.js";
import { unlessFresh } from "./stamp.js";
import { wasm } from "./wasm.js";

const FOLDER = "recordings";
const SOURCES = ["pkg/relievo_bg.wasm", "scripts/recordings.js"];
/** As the page opens them. */
const SIZE = [320, 240];
const THUMBNAIL = [144, 108];
/** Bytes that a recording may take. */
const MOST_BYTES = 240_000;
/** Bytes that a state may take: one with depth pixel by pixel is left out, since the result shows it. */
const MOST_STATE = 100_000;

/** Makes them, unless they are made from this core already. */
export async function recordings() {
  await wasm();
  return unlessFresh(FOLDER, SOURCES, () =>
    stage("Recordings of the built-in sequences", async () => {
      const core = await import("../pkg/relievo.js");
      core.initSync({ module: readFileSync(join(root, "pkg/relievo_bg.wasm")) });
      rmSync(join(root, FOLDER), { recursive: true, force: true });
      mkdirSync(join(root, FOLDER));
      /** @type {{ name: string }[]} */
      const scenes = JSON.parse(core.sceneCatalogue());
      for (const { name } of scenes) {
        const bytes = recordingOf(core, name);
        if (bytes.length > MOST_BYTES) {
          throw new Error(
            `The recording of ${name} takes ${bytes.length} bytes, more than ${MOST_BYTES}.`,
          );
        }
        writeFileSync(join(root, FOLDER, `${name}.bin`), bytes);
        writeFileSync(join(root, FOLDER, `${name}.png`), thumbnailOf(core, name));
        console.log(`${name}: ${bytes.length} bytes`);
      }
    }),
  );
}

/** @typedef {typeof import("../pkg/relievo.js")} Core */

/**
 * @param {Core} core
 * @param {string} name
 */
function thumbnailOf(core, name) {
  const [width = 0, height = 0] = THUMBNAIL;
  const files = new core.Scene(name, width, height).files();
  const frame = files.find((file) => file.name === "frame0.png");
  if (!frame) throw new Error(`${name} has no first frame`);
  return frame.bytes;
}

/**
 * @param {Core} core
 * @param {string} name
 */
function recordingOf(core, name) {
  const [width = 0, height = 0] = SIZE;
  const scene = new core.Scene(name, width, height);
  const solver = new core.Solver(
    scene.first(),
    scene.second(),
    scene.cameraJson,
    scene.shapesJson,
    "{}",
  );
  const passes = [];
  const parts = [];
  let last = "";
  do {
    solver.step();
    const over = solver.status !== "running";
    const picture = pictureOf(solver, over ? 1 : 2);
    // A pass that changes nothing to see has no picture of its own.
    const print = Buffer.from(picture.bytes).toString("base64");
    const same = print === last && !over;
    last = print;
    if (!same) parts.push(picture.bytes);
    const whole = solver.state();
    const state = whole.length > MOST_STATE ? new Uint8Array() : whole;
    parts.push(state);
    passes.push({
      report: { ...JSON.parse(solver.report()), seconds: NO_TIME },
      contours: contoursOf(solver, over ? 2 : 1),
      picture: same ? null : { width: picture.width, height: picture.height },
      state: state.length,
    });
  } while (solver.status === "running");
  const head = {
    name,
    title: scene.title,
    lesson: scene.lesson,
    width,
    height,
    camera: JSON.parse(scene.cameraJson),
    shapes: JSON.parse(scene.shapesJson),
    passes,
  };
  const text = Buffer.from(JSON.stringify(head));
  const first = deflateRawSync(Buffer.concat([length(text), text, ...parts]), { level: 9 });
  const second = deflateRawSync(solver.keep(true), { level: 9 });
  return Buffer.concat([length(first), first, second]);
}

/** How long it took is told by whoever solves it live. */
const NO_TIME = { total: 0, motion: 0, depth: 0, curves: 0 };

/** @param {Uint8Array} bytes */
function length(bytes) {
  const four = Buffer.alloc(4);
  four.writeUInt32LE(bytes.length);
  return four;
}

/**
 * @param {import("../pkg/relievo.js").Solver} solver
 * @param {number} digits
 */
function contoursOf(solver, digits) {
  /** @type {import("../pkg/relievo.js").Contour[]} */
  const contours = JSON.parse(solver.contours());
  return contours.map(({ points, ...rest }) => ({
    ...rest,
    points: points.map((x) => Number(x.toFixed(digits))),
  }));
}

/**
 * Depth as the page shows it at first, every `step`-th pixel.
 * @param {import("../pkg/relievo.js").Solver} solver
 * @param {number} step
 */
function pictureOf(solver, step) {
  const picture = solver.view("depth", "{}");
  const rgba = picture.rgba();
  const width = Math.floor(picture.width / step);
  const height = Math.floor(picture.height / step);
  const bytes = new Uint8Array(3 * width * height);
  let at = 0;
  for (let channel = 0; channel < 3; channel++) {
    for (let y = 0; y < height; y++) {
      let left = 0;
      for (let x = 0; x < width; x++) {
        const value = rgba[4 * (y * step * picture.width + x * step) + channel] ?? 0;
        bytes[at++] = value - left;
        left = value;
      }
    }
  }
  picture.free();
  return { width, height, bytes };
}

await ifMain(import.meta.url, async () => {
  await setup();
  await recordings();
});
