// The two frames that a command line names: two files, or one file that holds more than one picture.

import { InputError, UsageError } from "./errors.js";
import { read } from "./files.js";
import { numbers } from "./words.js";

/** @typedef {import("./options.js").Core} Core */
/** @typedef {import("../pkg/relievo.js").Frame} Frame */

const USAGE = "relievo FRAME1 FRAME2 --focal F";

/**
 * The frames, and what to say of where they come from.
 * @param {Core} core
 * @param {string[]} operands
 * @param {{ frames?: string, fields?: boolean }} values
 * @returns {{ frames: [Frame, Frame], said: string | null }}
 */
export function open(core, operands, values) {
  const [first, second, third] = operands;
  if (first === undefined || third !== undefined) {
    const count = operands.length === 0 ? "none was" : `${operands.length} were`;
    throw new UsageError(`two frames are needed, ${count} given: ${USAGE}`);
  }
  if (second === undefined) return values.fields ? fields(core, first) : pair(core, first, values);
  if (values.frames !== undefined || values.fields) {
    const option = values.fields ? "--fields" : "--frames";
    throw new UsageError(`${option} chooses from one file, but two were given`);
  }
  const decoded = /** @type {[Frame, Frame]} */ (
    [first, second].map((path) => core.Frame.decode(read(path), path))
  );
  return { frames: decoded, said: null };
}

/**
 * Two pictures of one file, the first two unless others are asked for.
 * @param {Core} core
 * @param {string} path
 * @param {{ frames?: string }} values
 * @returns {{ frames: [Frame, Frame], said: string }}
 */
function pair(core, path, { frames }) {
  const film = core.decodeAll(read(path), path);
  const { count, kind } = film;
  if (count < 2) {
    const interlaced = film.frame(0).interlaced;
    const way = interlaced ? "; it seems to be interlaced: take its two fields with --fields" : "";
    throw new UsageError(
      `two frames are needed, one was given, and ${path} holds no second${way}: ${USAGE}`,
    );
  }
  const chosen = numbers("frames", "I,J", frames ?? "1,2", (many) => many === 2);
  const [i = 1, j = 2] = chosen;
  for (const number of chosen) {
    if (!Number.isInteger(number) || number < 1 || number > count) {
      throw new UsageError(`--frames ${frames}: ${path} holds frames 1 to ${count}`);
    }
  }
  const what = kind === "animation" ? "an animation" : kind;
  const all = `${count}${film.cut ? " and more" : ""}`;
  return {
    frames: [film.frame(i - 1), film.frame(j - 1)],
    said: `frames ${i} and ${j} of ${all} in ${path} (${what})`,
  };
}

/**
 * @param {Core} core
 * @param {string} path
 * @returns {{ frames: [Frame, Frame], said: string }}
 */
function fields(core, path) {
  const whole = core.Frame.decode(read(path), path);
  const [even, odd] = whole.fields();
  if (!even || !odd) throw new InputError(`${path} has no fields`);
  const said = `the two fields of ${path}, ${even.width}×${even.height} pixels: f and curves are in pixels of theirs`;
  return { frames: [even, odd], said };
}
