// Files in and out, with errors that name them.

import { accessSync, constants, mkdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { InputError } from "./errors.js";

/** What a folder with a sequence and its truth has besides results. */
export const SCENE = "scene.json";

/** @type {Record<string, string>} */
const REASONS = {
  ENOENT: "there is no such file or folder",
  EISDIR: "it is a folder",
  ENOTDIR: "part of its path is not a folder",
  EEXIST: "there is a file of that name",
  EACCES: "access is denied",
  EROFS: "the disk cannot be written to",
  ENOSPC: "the disk is full",
};

/**
 * @param {unknown} error
 * @param {string} what
 */
function explained(error, what) {
  const { code, message } = Object(error);
  return new InputError(`${what}: ${REASONS[code] ?? message}`);
}

/** @param {string} path */
export function read(path) {
  try {
    return readFileSync(path);
  } catch (error) {
    throw explained(error, `${path} cannot be read`);
  }
}

/**
 * Makes the folder, so that a long computation does not find out last that it cannot.
 * @param {string} folder
 */
export function prepare(folder) {
  try {
    mkdirSync(folder, { recursive: true });
  } catch (error) {
    throw explained(error, `${folder} cannot be made`);
  }
  try {
    accessSync(folder, constants.W_OK);
  } catch (error) {
    throw explained(error, `${folder} cannot be written to`);
  }
}

/**
 * Writes what can be written, so that one bad name does not cost the rest of a long computation.
 * @param {string} folder
 * @param {{ name: string, bytes: Uint8Array | string }[]} files
 */
export function write(folder, files) {
  const failed = [];
  for (const { name, bytes } of files) {
    try {
      writeFileSync(join(folder, name), bytes);
    } catch (error) {
      failed.push(explained(error, `${join(folder, name)} cannot be written`));
    }
  }
  if (failed[0]) throw failed[0];
}
