// relievo --help, whose options of the solver and sequences are the core's own.

import { catalogue, dashed } from "./options.js";

/** @typedef {import("./options.js").Core} Core */
/** @typedef {import("./index.js").PresetEntry} PresetEntry */

const WIDTH = 96;

/** @param {Core} core */
export function help(core) {
  /** @type {import("./index.js").Limits} */
  const { minSide, maxPixels, maxCurves } = JSON.parse(core.limits());
  /** @type {import("./index.js").SceneEntry[]} */
  const scenes = JSON.parse(core.sceneCatalogue());
  const all = presets(core);
  return `Which parts of a film move, how, and how deep they are, from two of its frames.

Usage:
  relievo FRAME1 FRAME2 [--focal F] [options]
  relievo FILE [--frames I,J | --fields] [--focal F] [options]
  relievo scene NAME [--size WxH] [--out DIR]
  relievo scenes
  relievo score FOUND TRUTH [--json]

Coordinates are pixels, (0, 0) the centre of the top-left pixel. Frames are PNG, JPEG, PNM, WebP,
BMP, GIF or TIFF, from ${minSide}×${minSide} pixels to ${maxPixels / 1e6} megapixels.

Frames and curves:
${table([
  [
    "--focal F",
    "focal length in pixels; auto looks for it in the frames and takes their longer side, a guess, where they do not tell it; exif takes that of the photos' EXIF data; when left out, exif, and auto where there are none",
  ],
  [
    "--frames I,J",
    "which two frames of a FILE that holds several, from 1 (1,2): an animation, views, pages",
  ],
  ["--fields", "the two fields of an interlaced FILE, half as large, even rows first"],
  ["--centre X,Y", "principal point; the frame's centre when left out"],
  ["--circle X,Y,R", `a curve to start from; up to ${maxCurves} curves, each on one moving object`],
  ["--polygon X1,Y1,X2,Y2,X3,Y3,…", "a curve to start from"],
  ["--auto", "finds up to 7 curves to start from, in place of --circle and --polygon"],
  ["--out DIR", "where results go (out)"],
  ["--relief", "writes the relief as well: relief.glb with its texture, relief.ply"],
])}

The solver:
${table([
  ["--preset NAME", `what the other settings start from: ${all.map(named).join(" | ")}`],
  ["--iterations N", "the same as --max-passes N"],
])}
${settings(core, all)}

Results: labels.png (0 background, k the k-th curve), depth.pfm, depth16.png (16 bits, Z times
depth_scale of motion.json), flow.flo, occlusion.png, motion.json, and pictures. A scene has the
first six for its truth, frame0.png, frame1.png and scene.json, in a folder of its name unless --out
says otherwise. score compares what both folders have, or two files (.flo, KITTI's 16-bit .png of
flow, labels, depth as .pfm or as 16-bit grey .png; disparity if the name says "disp"), and prints
JSON with --json.

Sequences:
${table(scenes.map(({ name, title }) => [name, title]))}

Exit code: 0 done, 1 what was given cannot be worked on, 2 the command line is wrong.`;
}

/**
 * @param {Core} core
 * @returns {PresetEntry[]}
 */
const presets = (core) => JSON.parse(core.presetCatalogue());

/**
 * @param {PresetEntry} preset
 * @param {number} i
 */
const named = ({ value, label }, i) => `${value} (${label}${i === 0 ? "; the default" : ""})`;

/**
 * The solver's settings, those of all presets first, then those of one.
 * @param {Core} core
 * @param {PresetEntry[]} all
 */
function settings(core, all) {
  const names = all.map(({ value }) => value);
  const groups = [names, ...names.map((name) => [name])];
  return groups
    .map((group) => {
      const own = catalogue(core).filter(({ presets }) => String(presets) === String(group));
      const rows = own.map((option) => describe(option, group));
      return own.length ? `\nWith --preset ${group.join(" or ")}:\n${table(rows)}` : "";
    })
    .filter((text) => text)
    .join("\n");
}

/**
 * @param {import("./options.js").OptionEntry} option
 * @param {PresetEntry["value"][]} presets that it has an effect under
 */
function describe(option, presets) {
  const { key, meaning, unit, defaults } = option;
  const usual = presets.map((preset) =>
    presets.length > 1 ? `${preset}: ${word(defaults[preset])}` : word(defaults[preset]),
  );
  return [`--${dashed(key)} …`, `${meaning} (${[range(option, unit), ...usual].join("; ")})`];
}

/**
 * @param {import("./options.js").OptionEntry} option
 * @param {string} unit
 */
function range(option, unit) {
  switch (option.kind) {
    case "choice":
      return option.choices.map(({ value }) => value).join(" | ");
    case "toggle":
      return "on | off";
    default: {
      const automatic = option.kind === "number" && option.automatic;
      return `${option.min} to ${option.max}${unit && ` ${unit}`}${automatic ? " | auto" : ""}`;
    }
  }
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
