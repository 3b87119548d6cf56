// relievo score FOUND TRUTH: how far one folder of results is from another.

import { existsSync } from "node:fs";
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
    throw new UsageError("two folders are needed: relievo score FOUND TRUTH");
  }
  const scores = JSON.parse(load(core, found).scores(load(core, truth)));
  if (values["json"]) return console.log(JSON.stringify(scores));
  const number = (/** @type {number | null} */ x, digits = 3) => x?.toFixed(digits) ?? "–";
  const percent = (/** @type {number | null} */ x) =>
    x === null ? "–" : `${number(100 * x, 1)} %`;
  console.log(`flow           AEE ${number(scores.aee)} px, AAE ${number(scores.aae, 2)}°`);
  console.log(`labels wrong   ${percent(scores.labels_wrong)}`);
  scores.iou.forEach((/** @type {number | null} */ iou, /** @type {number} */ k) => {
    const name = k === 0 ? "background" : `curve ${k}`;
    const depth = `depth ${percent(scores.depth_error[k])} (flat ${percent(scores.flat_depth_error[k])})`;
    const motion = `T off by ${number(scores.translation_angle[k], 1)}°`;
    console.log(`${name.padEnd(14)} IoU ${percent(iou)}, ${depth}, ${motion}`);
  });
}

/**
 * @param {Core} core
 * @param {string} folder
 */
function load(core, folder) {
  const file = (/** @type {string} */ name) => read(join(folder, name));
  const occlusion = join(folder, "occlusion.png");
  try {
    return new core.SavedResult(
      file("labels.png"),
      file("depth.pfm"),
      file("flow.flo"),
      file("motion.json").toString("utf8"),
      existsSync(occlusion) ? read(occlusion) : undefined,
    );
  } catch (error) {
    if (Object(error).name !== "InputError") throw error;
    throw new InputError(`${folder}: ${Object(error).message}`);
  }
}
