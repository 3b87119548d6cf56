// The page, ready to be served as plain files, in dist/.

import { ifMain, run, stage } from "./shell.js";
import { setup } from "./setup.js";
import { unlessFresh } from "./stamp.js";
import { wasm } from "./wasm.js";

const SOURCES = ["www", "pkg", "vite.config.ts", "package-lock.json"];

/** Builds the WebAssembly and the page, as far as they have changed. */
export async function build() {
  await wasm();
  await unlessFresh("dist", SOURCES, () => stage("Page", () => run("vite", ["build"])));
}

await ifMain(import.meta.url, async () => {
  await setup();
  await build();
});
