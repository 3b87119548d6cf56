// relievo score FOUND TRUTH: how far one folder of results, or one file, is from another.

import { existsSync, statSync } from "node:fs";
import { join } from "node:path";

import { InputError, UsageError } from "./errors.js";
import { read } from "./files.js";
import { parse } from "./words.js";

/** @typedef {import("./options.js").Core} Core */

/**
 * @param {Core} core
 * @param {string[]} words
 */
export function score(core, words) {
  const { values, operands } = parse(words, { json: { type: "boolean" } });
  const [found, truth] = operands;
  if (found === undefined || truth === undefined || operands.length > 2) {
    throw new UsageError("two folders or files are needed: relievo score FOUND TRUTH");
  }
  const scores = JSON.parse(load(core, found).scores(load(core, truth)));
  if (values["json"]) return console.log(JSON.stringify(scores));
  const number = (/** @type {number | null} */ x, digits = 3) => x?.toFixed(digits) ?? "–";
  const percent = (/** @type {number | null} */ x) =>
    x === null ? "–" : `${number(100 * x, 1)} %`;
  if (scores.aee !== null) {
    console.log(`flow           AEE ${number(scores.aee)} px, AAE ${number(scores.aae, 2)}°`);
  }
  if (scores.labels_wrong !== null) {
    console.log(`labels wrong   ${percent(scores.labels_wrong)}`);
  }
  scores.iou.forEach((/** @type {number | null} */ iou, /** @type {number} */ k) => {
    const known = [iou, scores.depth_error[k], scores.translation_angle[k]];
    if (known.every((score) => score === null)) return;
    const name = k === 0 ? "background" : `curve ${k}`;
    const depth = `depth ${percent(scores.depth_error[k])} (flat ${percent(scores.flat_depth_error[k])})`;
    const motion = `T off by ${number(scores.translation_angle[k], 1)}°`;
    console.log(`${name.padEnd(14)} IoU ${percent(iou)}, ${depth}, ${motion}`);
  });
}

/** What is read of a folder, by the names that a solve and a sequence give them. */
const NAMES = ["labels.png", "depth.pfm", "flow.flo", "motion.json", "occlusion.png"];

/**
 * What there is at a path: a folder of results, or one file of flow, labels or depth.
 * @param {Core} core
 * @param {string} path
 */
function load(core, path) {
  const folder = statSync(path, { throwIfNoEntry: false })?.isDirectory() ?? false;
  const files = folder
    ? NAMES.filter((name) => existsSync(join(path, name))).map((name) => ({
        name,
        bytes: read(join(path, name)),
      }))
    : [nameless(core, path)];
  try {
    return new core.SavedResult(files);
  } catch (error) {
    if (Object(error).name !== "InputError") throw error;
    throw new InputError(`${path}: ${Object(error).message}`);
  }
}

/**
 * A file by itself, under the name that it would have in a folder.
 * @param {Core} core
 * @param {string} path
 */
function nameless(core, path) {
  const bytes = read(path);
  return { name: core.fileKind(path, bytes, true) ?? "labels.png", bytes };
}
