// relievo scene NAME: a built-in sequence, its truth, and how to solve it.

import { join } from "node:path";

import { UsageError } from "./errors.js";
import { prepare, SCENE, write } from "./files.js";
import { parse, quoted } from "./words.js";

/** @typedef {import("./options.js").Core} Core */

/** @param {Core} core */
export function scenes(core) {
  for (const { name, title, lesson } of JSON.parse(core.sceneCatalogue())) {
    console.log(`${name.padEnd(10)} ${title}: ${lesson}`);
  }
}

/**
 * @param {Core} core
 * @param {string[]} words
 */
export function scene(core, words) {
  const { values, operands } = parse(words, { size: { type: "string" }, out: { type: "string" } });
  const [name] = operands;
  if (name === undefined || operands.length > 1) {
    throw new UsageError("one sequence must be named; relievo scenes lists them");
  }
  const [width, height] = sizeOf(values["size"] ?? "320x240");
  const made = render(core, name, width, height);
  const out = values["out"] ?? name;
  prepare(out);
  const camera = JSON.parse(made.cameraJson);
  const curves = JSON.parse(made.shapesJson);
  const command = commandFor(out, camera, curves);
  const { title, lesson } = made;
  const about = { name, title, lesson, width, height, camera, curves, command };
  const text = `${JSON.stringify(about, null, 2)}\n`;
  const files = [...made.files(), { name: SCENE, bytes: text }];
  write(out, files);
  console.log(`${title}: ${lesson}`);
  console.log(`${out}/: ${files.map((file) => file.name).join(" ")}`);
  console.log(`Solve it with: ${command}`);
}

/**
 * @param {string} text
 * @returns {[number, number]}
 */
function sizeOf(text) {
  const [, width, height] = /^(\d{1,6})[x×](\d{1,6})$/i.exec(text) ?? [];
  if (width === undefined) {
    throw new UsageError(`--size ${text} is not of the form WxH, such as 320x240`);
  }
  return [Number(width), Number(height)];
}

/**
 * Whatever the core finds wrong here was asked for on the command line.
 * @param {Core} core
 * @param {string} name
 * @param {number} width
 * @param {number} height
 */
function render(core, name, width, height) {
  try {
    return new core.Scene(name, width, height);
  } catch (error) {
    if (error instanceof WebAssembly.RuntimeError) throw error;
    throw new UsageError(Object(error).message);
  }
}

/**
 * @param {string} out
 * @param {{ focal: number, cx: number, cy: number }} camera
 * @param {any[]} curves
 */
function commandFor(out, { focal, cx, cy }, curves) {
  const frames = ["frame0.png", "frame1.png"].map((name) => quoted(join(out, name)));
  const short = (/** @type {number} */ x) => String(Number(x.toFixed(2)));
  const drawn = curves.map(({ kind, x, y, r, points }) =>
    kind === "circle"
      ? `--circle ${[x, y, r].map(short).join(",")}`
      : `--polygon ${points.flat().map(short).join(",")}`,
  );
  const words = ["npx relievo", ...frames, `--focal ${focal}`, `--centre ${cx},${cy}`, ...drawn];
  return [...words, `--out ${quoted(join(out, "found"))}`].join(" ");
}
