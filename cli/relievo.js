#!/usr/bin/env node
// The relievo command. Exit code 0: done; 1: what was given cannot be worked on; 2: the command line
// is wrong. Errors are one sentence on stderr.

import { readFileSync } from "node:fs";

import { InputError, UsageError } from "./errors.js";

async function core() {
  try {
    return await import("./index.js");
  } catch (error) {
    if (Object(error).code !== "ERR_MODULE_NOT_FOUND") throw error;
    throw new InputError("the WebAssembly is not built yet; build it with: npm run build");
  }
}

/** @param {string[]} words */
async function main(words) {
  const [command, ...rest] = words;
  if (command === "--version" || command === "-V") {
    const text = readFileSync(new URL("../package.json", import.meta.url), "utf8");
    return console.log(JSON.parse(text).version);
  }
  if (command === undefined) {
    throw new UsageError("two frames or a command are needed; relievo --help says more");
  }
  const relievo = await core();
  if (words.includes("--help") || words.includes("-h")) {
    return console.log((await import("./help.js")).help(relievo));
  }
  switch (command) {
    case "scenes":
      return (await import("./scene.js")).scenes(relievo);
    case "scene":
      return (await import("./scene.js")).scene(relievo, rest);
    case "score":
      return (await import("./score.js")).score(relievo, rest);
    default:
      return (await import("./solve.js")).solve(relievo, words);
  }
}

/** @param {unknown} error */
async function report(error) {
  const { name, message, code } = Object(error);
  // The core names what it finds wrong in a setting, which is the command line's fault.
  if (error instanceof UsageError || name === "SettingError") process.exitCode = 2;
  else process.exitCode = 1;
  const expected = error instanceof UsageError || error instanceof InputError;
  if (expected || name === "SettingError" || name === "InputError") {
    return console.error(`relievo: ${message}`);
  }
  // A system call that failed (EACCES, ENOSPC, …) says so well enough.
  if (typeof code === "string") return console.error(`relievo: ${message}`);
  const panic = await import("./index.js")
    .then((relievo) => relievo.panicMessage())
    .catch(() => "");
  const memory = error instanceof WebAssembly.RuntimeError && !panic;
  const reason = panic || (memory ? "the frames need more memory than there is" : String(error));
  console.error(`relievo: ${reason}`);
}

// A reader that has seen enough (| head) is no failure; a full disk is.
process.stdout.on("error", ({ code, message }) => {
  if (code === "EPIPE") process.exit();
  console.error(`relievo: what there is to say cannot be written: ${message}`);
  process.exit(1);
});

try {
  await main(process.argv.slice(2));
} catch (error) {
  await report(error);
}
