// Relievo as a library for Node: loads the WebAssembly and hands on everything it exports.

import { readFileSync } from "node:fs";

import { initSync, useDecoders } from "../pkg/relievo.js";
import { initSync as initDecoders } from "../pkg/relievo_decoders.js";
import { decoders } from "./decoders.js";

initSync({ module: readFileSync(new URL("../pkg/relievo_bg.wasm", import.meta.url)) });

let loaded = false;
useDecoders({
  unpack(...file) {
    if (!loaded) {
      const address = new URL("../pkg/relievo_decoders_bg.wasm", import.meta.url);
      initDecoders({ module: readFileSync(address) });
      loaded = true;
    }
    return decoders.unpack(...file);
  },
});

/** Nothing to wait for: for programs that run in browsers as well. */
export default async function init() {}

/** The same: they are loaded with the first file that needs them. */
export async function loadDecoders() {}

export * from "../pkg/relievo.js";
