// Relievo as a library for Node: loads the WebAssembly and hands on everything it exports.

import { readFileSync } from "node:fs";

import { initSync } from "../pkg/relievo.js";

initSync({ module: readFileSync(new URL("../pkg/relievo_bg.wasm", import.meta.url)) });

export * from "../pkg/relievo.js";
