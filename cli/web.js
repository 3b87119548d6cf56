// Relievo as a library for browsers: a page or a worker waits for `init()`, then uses what the WebAssembly exports.

import load, { useDecoders } from "../pkg/relievo.js";

// A module of one function that needs SIMD.
const SIMD = [
  0, 97, 115, 109, 1, 0, 0, 0, 1, 5, 1, 96, 0, 1, 123, 3, 2, 1, 0, 10, 10, 1, 8, 0, 65, 0, 253, 15,
  253, 98, 11,
];

/**
 * @param {import("../pkg/relievo.js").InitInput | Promise<import("../pkg/relievo.js").InitInput>} [from]
 */
export default async function init(from) {
  if (!WebAssembly.validate(new Uint8Array(SIMD))) {
    throw new Error(
      "Relievo needs WebAssembly SIMD, which this browser does not have; Chrome and Edge 91, Firefox 89, Safari 16.4 and later do",
    );
  }
  await load(from === undefined ? undefined : { module_or_path: from });
}

/**
 * @param {import("../pkg/relievo.js").InitInput | Promise<import("../pkg/relievo.js").InitInput>} [from]
 */
export async function loadDecoders(from) {
  const [{ default: load }, { decoders }] = await Promise.all([
    import("../pkg/relievo_decoders.js"),
    import("./decoders.js"),
  ]);
  await load(from === undefined ? undefined : { module_or_path: from });
  useDecoders(decoders);
}

export * from "../pkg/relievo.js";
