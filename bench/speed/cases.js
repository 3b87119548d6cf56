// What is timed: one to five regions, at five sizes.

import { Trouble } from "../../scripts/shell.js";

/** @typedef {{ scene: string, regions: number }} Scene */
/** @typedef {{ width: number, height: number }} Size */
/** @typedef {Scene & Size & { presets: string[] }} Case */

/** @type {Scene[]} */
export const SCENES = [
  { scene: "flight", regions: 1 },
  { scene: "head", regions: 2 },
  { scene: "blocks", regions: 3 },
  { scene: "carousel", regions: 4 },
  // A variant of the scene generator.
  { scene: "crowd-1", regions: 5 },
];

export const SIZES = ["160x120", "320x240", "640x480", "1280x720", "1920x1080"];

/** The size that `--quick` keeps, and to which others are compared. */
export const USUAL = "320x240";

/** Larger frames are solved by `best` only: one scale takes passes in proportion to a frame's side. */
const MOST_PIXELS_FOR_PAPER = 640 * 480;

/**
 * Every case asked for, small ones first.
 * @param {{ names: string[], sizes: string[], presets: string[] }} asked no name is every name
 * @returns {Case[]}
 */
export function cases({ names, sizes, presets }) {
  const wrong = names.find((name) => !SCENES.some(({ scene }) => scene === name));
  if (wrong) {
    throw new Trouble(`${wrong} is none of ${SCENES.map(({ scene }) => scene).join(", ")}.`);
  }
  const wanted = SCENES.filter(({ scene }) => !names.length || names.includes(scene));
  return sizes.flatMap((size) => {
    const { width, height } = parsed(size);
    const small = width * height <= MOST_PIXELS_FOR_PAPER;
    const possible = presets.filter((preset) => small || preset !== "paper");
    if (!possible.length) return [];
    return wanted.map((scene) => ({ ...scene, width, height, presets: possible }));
  });
}

/** @param {string} size */
function parsed(size) {
  const [, width, height] = /^(\d+)x(\d+)$/.exec(size) ?? [];
  if (!width || !height) throw new Trouble(`${size} is no size such as ${USUAL}.`);
  return { width: Number(width), height: Number(height) };
}
