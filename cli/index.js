// Relievo as a library for Node: loads the WebAssembly and hands on everything it exports.

import { readFileSync } from "node:fs";

import { initSync } from "../pkg/relievo.js";

initSync({ module: readFileSync(new URL("../pkg/relievo_bg.wasm", import.meta.url)) });

/** Nothing to wait for: for programs that run in browsers as well. */
export default async function init() {}

export * from "../pkg/relievo.js";
