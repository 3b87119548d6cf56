// The core as WebAssembly, in pkg/: two modules, what solves and what opens files, for the page's worker and for Node alike.

import { readdirSync, rmSync } from "node:fs";
import { homedir } from "node:os";
import { join } from "node:path";

import { ifMain, root, run, stage } from "./shell.js";
import { setup } from "./setup.js";
import { unlessFresh } from "./stamp.js";

const SOURCES = [
  "src",
  "Cargo.toml",
  "Cargo.lock",
  ".cargo",
  "package-lock.json",
  "scripts/wasm.js",
];

// What rustc turns on for this target, and SIMD: wasm-opt must know it, and no more.
const FEATURES = [
  "bulk-memory",
  "bulk-memory-opt",
  "call-indirect-overlong",
  "multivalue",
  "mutable-globals",
  "nontrapping-float-to-int",
  "reference-types",
  "sign-ext",
  "simd",
].map((feature) => `--enable-${feature}`);

// Less is inlined than usual, and no loop is unrolled in part: engines do that themselves. 130 kB less, and no slower.
const LLVM = ["inline-threshold=50", "unroll-runtime=false", "unroll-allow-partial=false"];
const CODE = LLVM.map((setting) => `-Cllvm-args=-${setting}`);

// Nothing lies in the first kilobyte of memory, where the stack ends: sums of addresses and constants may so become
// offsets, which makes the solver faster by some percent.
const ADDRESSES = ["--low-memory-unused", "--optimize-added-constants-propagate"];

const TARGET = "wasm32-unknown-unknown";

/** @typedef {{ name: string, feature: string, profile: string, optimise: string[], binding: string[] }} Module */

/** @type {Module} */
const SOLVER = {
  name: "relievo",
  feature: "javascript",
  profile: "release",
  optimise: ["-O3", ...ADDRESSES],
  binding: [],
};

/** @type {Module} */
const DECODERS = {
  name: "relievo_decoders",
  feature: "javascript-decoders",
  profile: "decoders",
  optimise: ["-Oz", ...ADDRESSES],
  // Its memory is given back by starting anew.
  binding: ["--experimental-reset-state-function"],
};

/** Compiles, binds and optimises, unless nothing changed since the last time. */
export function wasm() {
  const targets = process.env.CARGO_TARGET_DIR ?? "target";
  return unlessFresh("pkg", SOURCES, async () => {
    rmSync(join(root, "pkg"), { recursive: true, force: true });
    await made("pkg", targets, SOLVER);
    await made("pkg", targets, DECODERS);
  });
}

/** What solves, with kernels to be timed, elsewhere: see `src/wasm/solving/bench.rs`. */
export async function benchWasm() {
  const folder = "out/kernels";
  const targets = join(process.env.CARGO_TARGET_DIR ?? "target", "bench");
  await unlessFresh(folder, SOURCES, async () => {
    rmSync(join(root, folder), { recursive: true, force: true });
    await made(folder, targets, { ...SOLVER, feature: "bench" });
  });
  return folder;
}

/**
 * @param {string} folder
 * @param {string} targets cargo's
 * @param {Module} module
 */
function made(folder, targets, { name, feature, profile, optimise, binding }) {
  return stage(`WebAssembly: compile, bind, optimise ${name}`, async () => {
    const lib = ["rustc", "--locked", "--profile", profile, "--lib", "--crate-type", "cdylib"];
    const words = ["--no-default-features", "--features", feature];
    const where = ["--target", TARGET, "--target-dir", targets];
    await run("cargo", [...lib, ...words, ...where, ...(await unplaced()), "--", ...CODE]);
    const built = join(targets, TARGET, profile, "relievo.wasm");
    const bind = ["--target", "web", "--out-dir", folder, "--out-name", name, ...binding];
    await run("wasm-bindgen", [...bind, built]);
    const bound = join(folder, `${name}_bg.wasm`);
    await run("wasm-opt", [...optimise, ...FEATURES, bound, "-o", bound]);
  });
}

/**
 * So that panics name the sources of other crates without the folders of this machine: fewer bytes, and the same ones on
 * every machine.
 */
async function unplaced() {
  await run("cargo", ["fetch", "--locked", "--quiet", "--target", TARGET]);
  const sources = join(process.env.CARGO_HOME ?? join(homedir(), ".cargo"), "registry", "src");
  const flags = readdirSync(sources).map((registry) => {
    return `--remap-path-prefix=${join(sources, registry)}/=`;
  });
  return ["--config", `target.${TARGET}.rustflags=${JSON.stringify(flags)}`];
}

await ifMain(import.meta.url, async () => {
  await setup();
  await wasm();
});
