// The solver's options as options of the command line, from the core's own catalogue.

import { UsageError } from "./errors.js";

/** @typedef {typeof import("./index.js")} Core */
/** @typedef {{ key: string, label: string, meaning: string, term: string, unit: string, kind: string,
 *   min?: number, max?: number, automatic?: boolean, choices?: { value: string, label: string }[],
 *   defaults?: Record<string, unknown> }} Descriptor */

/**
 * @param {Core} core
 * @returns {Descriptor[]}
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
  for (const { key, kind, automatic } of catalogue(core)) {
    const text = values[dashed(key)];
    if (text !== undefined) options[key] = read(dashed(key), text, kind, automatic ?? false);
  }
  return options;
}

/**
 * @param {string} name
 * @param {string} text
 * @param {string} kind
 * @param {boolean} automatic
 */
function read(name, text, kind, automatic) {
  if (kind === "toggle") {
    if (["true", "on", "yes"].includes(text)) return true;
    if (["false", "off", "no"].includes(text)) return false;
    throw new UsageError(`--${name} ${text} is neither on nor off`);
  }
  if (kind === "number" || kind === "integer") {
    if (automatic && text === "auto") return null;
    // JSON has no NaN or infinity: left as words, they are refused.
    if (text.trim() !== "" && Number.isFinite(Number(text))) return Number(text);
  }
  return text;
}
