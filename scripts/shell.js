// Running other programs, and saying so: a heading, their output, how long they took.

import { AsyncLocalStorage } from "node:async_hooks";
import { spawn, spawnSync } from "node:child_process";
import { existsSync } from "node:fs";
import { homedir } from "node:os";
import { delimiter, dirname, join } from "node:path";
import { createInterface } from "node:readline";
import { fileURLToPath } from "node:url";

/** The checkout. */
export const root = dirname(dirname(fileURLToPath(import.meta.url)));

/** Where tools are kept, outside the checkout, so that a second checkout finds them. */
export const cache =
  process.env.RELIEVO_CACHE ??
  join(process.env.XDG_CACHE_HOME ?? join(homedir(), ".cache"), "relievo");

/** Installed by `cargo install --root`. */
export const toolRoot = join(cache, "tools");

/** What is wrong and what to do about it, in a sentence that needs no stack trace. */
export class Trouble extends Error {}

// A terminal opened before rustup was installed does not have cargo on its PATH yet.
const paths = [
  join(toolRoot, "bin"),
  join(root, "node_modules", ".bin"),
  join(process.env.CARGO_HOME ?? join(homedir(), ".cargo"), "bin"),
  process.env.PATH ?? "",
];

/** The environment for every program started here. */
export const environment = {
  ...process.env,
  PATH: paths.join(delimiter),
  // Playwright's own browser is fetched only when no other is found.
  PLAYWRIGHT_SKIP_BROWSER_DOWNLOAD: "1",
  ...(process.stdout.isTTY ? { CARGO_TERM_COLOR: "always", FORCE_COLOR: "1" } : {}),
};

/**
 * What a program prints, or null when it is missing or fails.
 * @param {string} program
 * @param {string[]} options
 */
export function ask(program, ...options) {
  const { status, stdout } = spawnSync(program, options, {
    cwd: root,
    env: environment,
    encoding: "utf8",
    stdio: ["ignore", "pipe", "ignore"],
    maxBuffer: 1 << 26,
  });
  return status === 0 ? stdout.trim() : null;
}

/**
 * Where a program is, or null.
 * @param {string} program
 */
export function which(program) {
  for (const folder of environment.PATH.split(delimiter)) {
    if (folder && existsSync(join(folder, program))) return join(folder, program);
  }
  return null;
}

/** @type {AsyncLocalStorage<string>} */
const marks = new AsyncLocalStorage();

/**
 * Does work beside other work: each line that it prints begins with a mark.
 * @template T
 * @param {string} mark
 * @param {() => Promise<T>} work
 */
export function marked(mark, work) {
  return marks.run(mark, work);
}

/** @param {string} line */
const mark = (line) => (marks.getStore() ?? "") + line;

/**
 * Runs a program with its output shown, and gives back what it printed.
 * @param {string} program
 * @param {string[]} options
 * @param {Record<string, string>} [extra] more environment variables
 * @returns {Promise<string>}
 */
export function run(program, options, extra = {}) {
  return new Promise((resolve, reject) => {
    const child = spawn(program, options, {
      cwd: root,
      env: { ...environment, ...extra },
      stdio: ["ignore", "pipe", "pipe"],
    });
    let output = "";
    /** @param {"stdout" | "stderr"} stream */
    const show = (stream) =>
      createInterface({ input: child[stream] }).on("line", (line) => {
        output += `${line}\n`;
        process[stream].write(`${mark(line)}\n`);
      });
    show("stdout");
    show("stderr");
    const name = [program, ...options].join(" ");
    child.on("error", () => reject(new Trouble(`${program} could not be started.`)));
    child.on("close", (code, signal) => {
      if (code === 0) return resolve(output);
      const trouble = new Trouble(`"${name}" failed (${signal ?? `exit code ${code}`}).`);
      reject(Object.assign(trouble, { output }));
    });
  });
}

/**
 * Says what is done, does it, and says how long it took.
 * @template T
 * @param {string} title
 * @param {() => T | Promise<T>} work
 */
export async function stage(title, work) {
  console.log(`\n${mark(`== ${title}`)}`);
  const begin = performance.now();
  try {
    return await work();
  } finally {
    console.log(mark(`-- ${title}: ${duration(performance.now() - begin)}`));
  }
}

/**
 * Milliseconds as a person reads them.
 * @param {number} milliseconds
 */
export function duration(milliseconds) {
  const seconds = milliseconds / 1000;
  if (seconds < 60) return `${seconds.toFixed(1)} s`;
  return `${Math.floor(seconds / 60)} min ${Math.round(seconds % 60)} s`;
}

/**
 * Runs a script's main function when the script was started by itself; trouble ends it in a sentence.
 * @param {string} url the script's import.meta.url
 * @param {() => unknown} main
 */
export async function ifMain(url, main) {
  if (process.argv[1] !== fileURLToPath(url)) return;
  try {
    await main();
  } catch (error) {
    if (!(error instanceof Trouble)) throw error;
    console.error(`\n${error.message}`);
    process.exitCode = 1;
  }
}
