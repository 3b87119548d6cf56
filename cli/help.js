// relievo --help, whose options of the solver and sequences are the core's own.

import { catalogue, dashed } from "./options.js";

/** @typedef {import("./options.js").Core} Core */

const WIDTH = 96;

/** @param {Core} core */
export function help(core) {
  const { minSide, maxSide, maxCurves } = JSON.parse(core.limits());
  const scenes = JSON.parse(core.sceneCatalogue());
  return `Which parts of a film move, how, and how deep they are, from two of its frames.

Usage:
  relievo FRAME1 FRAME2 --focal F [options]
  relievo scene NAME [--size WxH] [--out DIR]
  relievo scenes
  relievo score FOUND TRUTH [--json]

Coordinates are pixels, (0, 0) the centre of the top-left pixel. Frames are PNG, JPEG, PNM, WebP,
BMP or TIFF, from ${minSide}×${minSide} to ${maxSide}×${maxSide} pixels.

Frames and curves:
${table([
  [
    "--focal F",
    "focal length in pixels; auto looks for it in the frames and takes their longer side where they do not tell it",
  ],
  ["--centre X,Y", "principal point; the frame's centre when left out"],
  ["--circle X,Y,R", `a curve to start from; up to ${maxCurves} curves, each on one moving object`],
  ["--polygon X1,Y1,X2,Y2,X3,Y3,…", "a curve to start from"],
  ["--auto", "finds up to 4 curves to start from, in place of --circle and --polygon"],
  ["--out DIR", "where results go (out)"],
])}

The solver:
${table([
  ["--preset NAME", `what the other settings start from: ${presets(core)}`],
  ["--iterations N", "the same as --max-passes N"],
  ...catalogue(core).map(describe),
])}

Results: labels.png (0 background, k the k-th curve), depth.pfm, flow.flo, motion.json,
occlusion.png, and pictures. A scene has the first five for its truth, frame0.png, frame1.png and
scene.json, in a folder of its name unless --out says otherwise. score prints JSON with --json.

Sequences:
${table(scenes.map((/** @type {Record<string, string>} */ s) => [s["name"], s["title"]]))}

Exit code: 0 done, 1 what was given cannot be worked on, 2 the command line is wrong.`;
}

/** @param {Core} core */
function presets(core) {
  const all = JSON.parse(core.presetCatalogue());
  const names = all.map(
    (/** @type {Record<string, string>} */ { value, label }, /** @type {number} */ i) =>
      `${value} (${label}${i === 0 ? "; the default" : ""})`,
  );
  return names.join(" | ");
}

/** @param {import("./options.js").Descriptor} descriptor */
function describe({ key, meaning, unit, kind, min, max, automatic, choices, defaults }) {
  const range =
    kind === "choice"
      ? (choices ?? []).map(({ value }) => value).join(" | ")
      : kind === "toggle"
        ? "on | off"
        : `${min} to ${max}${unit && ` ${unit}`}${automatic ? " | auto" : ""}`;
  const usual = Object.entries(defaults ?? {}).map(
    ([preset, value]) => `${preset}: ${word(value)}`,
  );
  const notes = [range, ...usual].join("; ");
  return [`--${dashed(key)} …`, `${meaning} (${notes})`];
}

/** @param {unknown} value */
function word(value) {
  return typeof value === "boolean" ? (value ? "on" : "off") : String(value ?? "auto");
}

/** @param {(string | undefined)[][]} rows */
function table(rows) {
  const left = 22;
  return rows
    .map(([name = "", text = ""]) => {
      const lines = wrap(text, WIDTH - left - 2);
      const gap = name.length + 2 > left ? [`  ${name}`] : [];
      const first = gap.length ? "" : name;
      return [
        ...gap,
        ...lines.map((line, i) => `  ${(i === 0 ? first : "").padEnd(left)}${line}`),
      ].join("\n");
    })
    .join("\n");
}

/**
 * @param {string} text
 * @param {number} width
 */
function wrap(text, width) {
  const lines = [""];
  for (const word of text.split(" ")) {
    const last = lines.at(-1) ?? "";
    if (last && last.length + 1 + word.length > width) lines.push(word);
    else lines[lines.length - 1] = last ? `${last} ${word}` : word;
  }
  return lines;
}
