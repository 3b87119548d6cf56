// Words of the command line → values.

import { parseArgs } from "node:util";

import { UsageError } from "./errors.js";

/** @typedef {Record<string, { type: "string" | "boolean", multiple?: boolean, short?: string }>} Known */

/**
 * parseArgs, whose complaints become usage errors, and for which -5,3 is a value and no option.
 * @param {string[]} words
 * @param {Known} known
 * @returns {{ values: Record<string, any>, operands: string[] }}
 */
export function parse(words, known) {
  const joined = [];
  for (let i = 0; i < words.length; i += 1) {
    const [word = "", next = ""] = words.slice(i, i + 2);
    const takesValue = word.startsWith("--") && known[word.slice(2)]?.type === "string";
    if (takesValue && /^-[\d.]/.test(next)) {
      joined.push(`${word}=${next}`);
      i += 1;
    } else {
      joined.push(word);
    }
  }
  try {
    const { values, positionals } = parseArgs({
      args: joined,
      options: known,
      allowPositionals: true,
    });
    return { values, operands: positionals };
  } catch (error) {
    const [sentence = ""] = Object(error).message.split(/\. |\n/);
    throw new UsageError(`${sentence.replace(/\.$/, "")}; see relievo --help`);
  }
}

/**
 * Numbers between commas, as many as the test wants.
 * @param {string} option for the error
 * @param {string} form for the error
 * @param {string} text
 * @param {(count: number) => boolean} enough
 */
export function numbers(option, form, text, enough) {
  const found = text.split(",").map((word) => (word.trim() === "" ? NaN : Number(word)));
  if (!found.every(Number.isFinite) || !enough(found.length)) {
    throw new UsageError(`--${option} ${text} is not of the form ${form}`);
  }
  return found;
}

/**
 * A word as a shell needs it written.
 * @param {string} word
 */
export function quoted(word) {
  return /^[\w./,:=+-]+$/.test(word) ? word : `'${word.replaceAll("'", "'\\''")}'`;
}
