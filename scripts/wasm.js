// The core as WebAssembly, in pkg/: one module for the page's worker and for Node alike.

import { rmSync } from "node:fs";
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

/** Compiles, binds and optimises, unless nothing changed since the last time. */
export function wasm() {
  return made("pkg", process.env.CARGO_TARGET_DIR ?? "target", "javascript");
}

/** The same with kernels to be timed, elsewhere: see `src/wasm/bench.rs`. */
export async function benchWasm() {
  const folder = "out/kernels";
  // A target folder of its own, or each of the two would be compiled anew after the other.
  await made(folder, join(process.env.CARGO_TARGET_DIR ?? "target", "bench"), "bench");
  return folder;
}

/**
 * @param {string} folder
 * @param {string} targets cargo's
 * @param {string} feature
 */
function made(folder, targets, feature) {
  return unlessFresh(folder, SOURCES, () =>
    stage("WebAssembly: compile, bind, optimise", async () => {
      const target = "wasm32-unknown-unknown";
      const lib = ["build", "--locked", "--release", "--lib", "--features", feature];
      await run("cargo", [...lib, "--target", target, "--target-dir", targets]);
      const built = join(targets, target, "release/relievo.wasm");
      rmSync(join(root, folder), { recursive: true, force: true });
      await run("wasm-bindgen", ["--target", "web", "--out-dir", folder, built]);
      const bound = join(folder, "relievo_bg.wasm");
      await run("wasm-opt", ["-O3", ...FEATURES, bound, "-o", bound]);
    }),
  );
}

await ifMain(import.meta.url, async () => {
  await setup();
  await wasm();
});
