// What opens files that are no PNG, for the module that solves: a module of its own, which begins with every file anew,
// since WebAssembly gives no memory back.

import { __wbg_reset_state as startAnew, panicMessage, unpack } from "../pkg/relievo_decoders.js";

/** @type {import("../pkg/relievo.js").Decoders} */
export const decoders = {
  unpack(bytes, name, all, take) {
    try {
      const { kind, cut } = unpack(bytes, name, all, take);
      return { kind, cut };
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) throw error;
      // A decoder that gives up has broken nothing but itself.
      const reason = panicMessage() || "it is damaged, or takes more memory than there is";
      const message = `${name} cannot be read as an image (${reason})`;
      throw Object.assign(new Error(message), { name: "InputError" });
    } finally {
      startAnew();
    }
  },
};
