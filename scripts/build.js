// The page, ready to be served as plain files, in dist/.

import { join } from "node:path";

import { compress } from "./compress.js";
import { ifMain, root, run, stage } from "./shell.js";
import { recordings } from "./recordings.js";
import { setup } from "./setup.js";
import { unlessFresh } from "./stamp.js";

const SOURCES = [
  "www",
  "pkg",
  "recordings",
  "vite.config.ts",
  "scripts/policy.js",
  "package-lock.json",
];

/** Builds the WebAssembly, the recordings made with it and the page, as far as they have changed. */
export async function build() {
  await recordings();
  await unlessFresh("dist", SOURCES, () =>
    stage("Page", async () => {
      await run("vite", ["build"]);
      compress(join(root, "dist"));
    }),
  );
}

await ifMain(import.meta.url, async () => {
  await setup();
  await build();
});
