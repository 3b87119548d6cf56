// The solver's options as options of the command line, from the core's own catalogue.

import { UsageError } from "./errors.js";

/** @typedef {typeof import("./index.js")} Core */
/** @typedef {import("./index.js").OptionEntry} OptionEntry */

/**
 * @param {Core} core
 * @returns {OptionEntry[]}
 */
export const catalogue = (core) => JSON.parse(core.optionCatalogue());

/** @param {string} key */
export const dashed = (key) => key.replaceAll("_", "-");

/**
 * What parseArgs must know of them.
 * @param {Core} core
 */
export function known(core) {
  return Object.fromEntries(
    catalogue(core).map(({ key }) => [dashed(key), { type: /** @type {const} */ ("string") }]),
  );
}

/**
 * The options given, as the core reads them. What is no number or no word of the core's stays as it
 * is, so that the core says what is wrong with it; only what is on or off is told here by those words.
 * @param {Core} core
 * @param {Record<string, string | undefined>} values
 */
export function given(core, values) {
  /** @type {Record<string, unknown>} */
  const options = {};
  for (const option of catalogue(core)) {
    const text = values[dashed(option.key)];
    if (text !== undefined) options[option.key] = read(option, text);
  }
  return options;
}

/**
 * @param {OptionEntry} option
 * @param {string} text
 */
function read(option, text) {
  const { key, kind } = option;
  if (kind === "toggle") {
    if (["true", "on", "yes"].includes(text)) return true;
    if (["false", "off", "no"].includes(text)) return false;
    throw new UsageError(`--${dashed(key)} ${text} is neither on nor off`);
  }
  if (kind === "number" || kind === "integer") {
    if (kind === "number" && option.automatic && text === "auto") return null;
    // JSON has no NaN or infinity: left as words, they are refused.
    if (text.trim() !== "" && Number.isFinite(Number(text))) return Number(text);
  }
  return text;
}
