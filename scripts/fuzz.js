// npm run fuzz -- SECONDS [TARGET …]: hostile files, settings and frames, thought up by libFuzzer on a stable Rust.
// What makes the core panic, hang or take too much memory is kept in out/fuzz/faults.

import { mkdirSync, rmSync } from "node:fs";
import { join } from "node:path";

import { apt, setup } from "./setup.js";
import { ask, duration, ifMain, root, run, stage, Trouble } from "./shell.js";

/** Each with the longest input that it is given, in bytes. */
const TARGETS = { frames: 8192, files: 4096, settings: 1024, solves: 1024 };

const HELP = `npm run fuzz -- SECONDS [${Object.keys(TARGETS).join(" | ")} …]

SECONDS are shared among the targets. What is found goes to out/fuzz/faults; inputs that reached
something new are kept in out/fuzz, for the next run.`;

/** An input that takes longer is a fault. */
const HANG_SECONDS = 5;
/** A process that grows larger is a fault: 4096×4096 pixels of 16 bits, decoded, take less. */
const MEMORY_MB = 2048;

// Coverage, as libFuzzer reads it, is made by LLVM itself: no option here needs a nightly compiler.
const COVERAGE = [
  "-Cpasses=sancov-module",
  "-Cllvm-args=-sanitizer-coverage-level=4",
  "-Cllvm-args=-sanitizer-coverage-inline-8bit-counters",
  "-Cllvm-args=-sanitizer-coverage-pc-table",
  "-Cllvm-args=-sanitizer-coverage-trace-compares",
  // Decoders leave out checksums then, which no fuzzer guesses.
  "--cfg",
  "fuzzing",
];

function asked() {
  const [first = "", ...names] = process.argv.slice(2);
  const seconds = Number(first);
  const unknown = names.find((name) => !Object.hasOwn(TARGETS, name));
  if (!(seconds >= 1) || unknown !== undefined) {
    throw new Trouble(unknown === undefined ? HELP : `There is no target ${unknown}.\n\n${HELP}`);
  }
  const chosen = Object.entries(TARGETS).filter(([name]) => !names.length || names.includes(name));
  return { chosen, seconds: Math.max(1, Math.floor(seconds / chosen.length)) };
}

/** Builds the targets; the folder that they are in. */
async function built() {
  if (ask("c++", "--version") === null) await apt("a C++ compiler", "g++");
  const host = /^host: (.+)$/m.exec(ask("rustc", "-vV") ?? "")?.[1];
  if (host === undefined) throw new Trouble("rustc does not say what machine this is.");
  const targets = join(root, process.env.CARGO_TARGET_DIR ?? "target", "fuzz");
  // With a target named, flags do not reach build scripts and macros, which run without libFuzzer.
  const options = ["--locked", "--release", "--bins", "--target", host, "--target-dir", targets];
  await stage("Fuzz targets", () =>
    run("cargo", ["build", "--manifest-path", "fuzz/Cargo.toml", ...options], {
      CARGO_ENCODED_RUSTFLAGS: COVERAGE.join("\x1f"),
    }),
  );
  return join(targets, host, "release");
}

/**
 * Runs one target until its time is up; how many inputs it took.
 * @param {string} program
 * @param {string} name
 * @param {number} longest
 * @param {number} seconds
 */
async function fuzz(program, name, longest, seconds) {
  const [kept, faults] = [`out/fuzz/${name}`, `out/fuzz/faults/${name}-`];
  for (const folder of [kept, "out/fuzz/faults"])
    mkdirSync(join(root, folder), { recursive: true });
  const limits = [`-timeout=${HANG_SECONDS}`, `-rss_limit_mb=${MEMORY_MB}`];
  const until = performance.now() + 1000 * seconds;
  let inputs = 0;
  while (performance.now() < until) {
    const left = Math.ceil((until - performance.now()) / 1000);
    const words = [kept, `fuzz/corpus/${name}`, `-max_len=${longest}`, `-max_total_time=${left}`];
    const more = [`-artifact_prefix=${faults}`, "-print_final_stats=1", "-verbosity=0"];
    /** @type {string} */
    let output;
    try {
      output = await run(program, [...words, ...limits, ...more]);
    } catch (error) {
      output = String(Object(error).output);
      const [, slow] = /Test unit written to (\S*-timeout-\S*)/.exec(output) ?? [];
      if (slow === undefined) throw error;
      // Its clock runs on while a busy machine lets it wait: a second time is a fault.
      await run(program, [...limits, slow]);
      rmSync(join(root, slow));
    }
    inputs += Number(/number_of_executed_units: (\d+)/.exec(output)?.[1] ?? 0);
  }
  return inputs;
}

await ifMain(import.meta.url, async () => {
  const { chosen, seconds } = asked();
  await setup();
  const folder = await built();
  const lines = [];
  /** @type {string[]} */
  const failed = [];
  for (const [name, longest] of chosen) {
    const from = performance.now();
    try {
      const inputs = await stage(name, () => fuzz(join(folder, name), name, longest, seconds));
      lines.push(`${name.padEnd(9)} ${inputs} inputs, ${duration(performance.now() - from)}`);
    } catch (error) {
      if (!(error instanceof Trouble)) throw error;
      failed.push(name);
      lines.push(`${name.padEnd(9)} FAILED`);
    }
  }
  console.log(`\n== Summary\n${lines.join("\n")}`);
  if (failed.length) {
    throw new Trouble(
      `${failed.join(" and ")} failed: out/fuzz/faults has the inputs. Mend what they show, and put them into ` +
        "fuzz/corpus, whose inputs are tests.",
    );
  }
});
