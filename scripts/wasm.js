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
  return unlessFresh("pkg", SOURCES, () =>
    stage("WebAssembly: compile, bind, optimise", async () => {
      const target = "wasm32-unknown-unknown";
      await run("cargo", ["build", "--locked", "--release", "--lib", "--target", target]);
      const built = join(process.env.CARGO_TARGET_DIR ?? "target", target, "release/relievo.wasm");
      rmSync(join(root, "pkg"), { recursive: true, force: true });
      await run("wasm-bindgen", ["--target", "web", "--out-dir", "pkg", built]);
      const bound = "pkg/relievo_bg.wasm";
      await run("wasm-opt", ["-O3", ...FEATURES, bound, "-o", bound]);
    }),
  );
}

await ifMain(import.meta.url, async () => {
  await setup();
  await wasm();
});
