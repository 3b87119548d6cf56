// relievo FRAME1 FRAME2, or one FILE that holds both: the whole method on two frames, results into a folder.

import { existsSync } from "node:fs";
import { join } from "node:path";

import { InputError, UsageError } from "./errors.js";
import { prepare, SCENE, write } from "./files.js";
import { open } from "./frames.js";
import { catalogue, given, known } from "./options.js";
import { progress } from "./progress.js";
import { numbers, parse } from "./words.js";

/** @typedef {import("./options.js").Core} Core */
/** @typedef {import("../pkg/relievo.js").Frame} Frame */

const OWN = /** @type {const} */ ({
  focal: { type: "string" },
  centre: { type: "string" },
  circle: { type: "string", multiple: true },
  polygon: { type: "string", multiple: true },
  auto: { type: "boolean" },
  frames: { type: "string" },
  fields: { type: "boolean" },
  preset: { type: "string" },
  iterations: { type: "string" },
  out: { type: "string" },
  relief: { type: "boolean" },
});

/** Pixels of frames whose results are written at the frames' size. */
const LARGEST = 25e6;

/**
 * @param {Core} core
 * @param {string[]} words
 */
export function solve(core, words) {
  const { values, operands } = parse(words, { ...known(core), ...OWN });
  const asked = cameraOf(values);
  const drawn = shapesOf(words, values);
  const options = given(core, { "max-passes": values["iterations"], ...values });
  if (values["preset"] !== undefined) options["preset"] = values["preset"];

  const { frames, said } = open(core, operands, values);
  const { camera, focal } = seenBy(core, frames, asked);
  const seen = JSON.stringify(camera);
  const found = values["auto"] ? JSON.parse(core.findCurves(...frames, seen)) : null;
  const solver = new core.Solver(
    ...frames,
    seen,
    JSON.stringify(found ?? drawn),
    JSON.stringify(options),
  );
  const out = values["out"] ?? "out";
  prepareResults(out);
  run(solver, mostPasses(core, options));
  const files = solver.files("{}");
  for (const name of values["relief"] ? ["relief.glb", "relief.ply"] : []) {
    files.push({ name, bytes: solver.file(name, "{}") });
  }
  if (said) console.log(said);
  if (focal) console.log(focal);
  if (found) announce(found);
  summarise(JSON.parse(solver.report()));
  const [{ width, height }] = frames;
  if (width * height > LARGEST) {
    console.log(
      `note: the frames have more than ${LARGEST / 1e6} megapixels; results are those of the frames shrunk, lengths in their pixels`,
    );
  }
  write(out, files);
  console.log(`${out}/: ${files.map(({ name }) => name).join(" ")}`);
  if (solver.status === "diverged") {
    throw new InputError("the solver diverged, so the results mean nothing; try a larger --mu");
  }
}

/**
 * A truth is not written over: to be scored against itself would look like success.
 * @param {string} out
 */
function prepareResults(out) {
  if (existsSync(join(out, SCENE))) {
    throw new InputError(
      `${out} holds a sequence with its truth, which results would replace; choose another folder with --out`,
    );
  }
  prepare(out);
}

/**
 * What the command line says of the camera: f, or how to come by it.
 * @param {Record<string, string>} values
 */
function cameraOf({ focal, centre }) {
  const way = focal === undefined || focal === "auto" || focal === "exif";
  const [f] = way ? [] : numbers("focal", "F, exif or auto", focal, (count) => count === 1);
  if (centre === undefined) return { focal: f, way: focal };
  const [cx, cy] = numbers("centre", "X,Y", centre, (count) => count === 2);
  return { focal: f, way: focal, cx, cy };
}

/**
 * The camera with its focal length, from the frames where none was given, and what to say of that.
 * @param {Core} core
 * @param {[Frame, Frame]} frames
 * @param {{ focal: number | undefined, way: string | undefined, cx?: number, cy?: number }} asked
 */
function seenBy(core, frames, { way, ...asked }) {
  if (asked.focal !== undefined) return { camera: asked, focal: null };
  if (way === "auto") return foundBy(core, frames, asked);
  const lens = frames.map((frame) => JSON.parse(frame.lens())).find((lens) => lens !== null);
  if (lens) {
    const f = Number(lens.focal.toPrecision(6));
    const focal = `focal length ${f} pixels (${lens.text}): --focal ${f}`;
    return { camera: { ...asked, focal: f }, focal };
  }
  if (way !== "exif") return foundBy(core, frames, asked);
  throw new InputError(
    "the frames' EXIF data tell no focal length; give it in pixels with --focal F, or have it looked for with --focal auto",
  );
}

/**
 * The camera with a focal length looked for in the frames.
 * @param {Core} core
 * @param {[Frame, Frame]} frames
 * @param {{ cx?: number, cy?: number }} asked
 */
function foundBy(core, frames, asked) {
  const guess = { ...asked, focal: Math.max(frames[0].width, frames[0].height) };
  const found = JSON.parse(core.findFocal(...frames, JSON.stringify(guess)));
  if (!found) {
    const focal = `the frames do not tell the focal length; a guess, the longer side: --focal ${guess.focal}`;
    return { camera: guess, focal };
  }
  const [f, least, greatest] = [found.focal, found.least, found.greatest].map(Math.round);
  const focal = `focal length found, between ${least} and ${greatest} pixels: --focal ${f}`;
  return { camera: { ...asked, focal: f }, focal };
}

/**
 * Circles and polygons in the order in which they were given: the k-th becomes label k.
 * @param {string[]} words
 * @param {Record<string, any>} values
 */
function shapesOf(words, { circle = [], polygon = [], auto }) {
  if (auto && circle.length + polygon.length > 0) {
    throw new UsageError("--auto finds the curves by itself; leave out --circle and --polygon");
  }
  const circles = circle.map((/** @type {string} */ text) => {
    const [x, y, r] = numbers("circle", "X,Y,R", text, (count) => count === 3);
    return { kind: "circle", x, y, r };
  });
  const polygons = polygon.map((/** @type {string} */ text) => {
    const form = "X1,Y1,X2,Y2,X3,Y3,… (three corners or more)";
    const all = numbers("polygon", form, text, (count) => count >= 6 && count % 2 === 0);
    const corners = Array.from({ length: all.length / 2 }, (_, i) => all.slice(2 * i, 2 * i + 2));
    return { kind: "polygon", points: corners };
  });
  const order = words
    .map((word) => /^--(circle|polygon)(=|$)/.exec(word)?.[1])
    .filter((kind) => kind !== undefined);
  return order.map((kind) => (kind === "circle" ? circles : polygons).shift());
}

/**
 * @param {Core} core
 * @param {Record<string, unknown>} options
 */
function mostPasses(core, options) {
  /** @type {Record<string, unknown>} */
  const defaults = catalogue(core).find(({ key }) => key === "max_passes")?.defaults ?? {};
  const preset = options["preset"] ?? JSON.parse(core.presetCatalogue())[0].value;
  return Number(options["max_passes"] ?? defaults[String(preset)]);
}

/**
 * @param {import("../pkg/relievo.js").Solver} solver
 * @param {number} most
 */
function run(solver, most) {
  const bar = progress(most);
  let passes = 0;
  bar.show(passes);
  while (solver.step() === "running") bar.show((passes += 1));
  bar.clear();
}

/**
 * Says which curves were found, as options that start from the same ones.
 * @param {{ points: number[][] }[]} found
 */
function announce(found) {
  const count = ["no curve is needed: one motion explains both frames", "1 curve found"];
  console.log(count[found.length] ?? `${found.length} curves found`);
  for (const { points } of found) console.log(`  --polygon ${points.flat().join(",")}`);
}

/** @param {import("../pkg/relievo.js").Report} report */
function summarise({ status, iterations, regions, warnings, seconds, expected }) {
  const vector = (/** @type {number[]} */ v) => v.map((x) => x.toPrecision(3)).join(", ");
  const end = status === "exhausted" ? "out of iterations" : status;
  console.log(`${end} after ${iterations} passes, ${seconds.total.toFixed(1)} s`);
  const nameOf = (/** @type {number} */ label) => (label === 0 ? "background" : `curve ${label}`);
  for (const { label, share, model, rigid, translation, rotation } of regions) {
    const name = nameOf(label);
    const motion = rigid
      ? `${model.padEnd(11)}  T (${vector(translation)})  ω (${vector(rotation)}) rad`
      : "non-rigid";
    console.log(`${name.padEnd(11)} ${(100 * share).toFixed(1).padStart(5)} %  ${motion}`);
  }
  for (const { label, in_front_of: behind } of regions) {
    if (behind.length > 0) {
      console.log(`note: ${nameOf(label)} hides part of ${behind.map(nameOf).join(" and ")}`);
    }
  }
  for (const warning of warnings) console.log(`note: ${warning}`);
  if (expected) {
    const labels =
      expected.labels > 0 ? `, labels but for ${(100 * expected.labels).toFixed(1)} %` : "";
    console.log(
      `flow is expected to be right to about ${expected.flow.toPrecision(1)} px${labels}`,
    );
  }
}
