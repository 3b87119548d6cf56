// Loaded into Playwright (`node --require`) when it drives an installed Firefox. One command of its start-up, which sets
// the colour scheme, is too new for Firefox's long-term releases and fails all; the tests do without it.

/** @type {any} */
const Module = require("node:module");

const COMMAND =
  /await this\.(_session|_browser\._browserSession)\.send\("emulation\.setMediaFeaturesOverride",/g;

const compile = Module.prototype._compile;

/**
 * @this {unknown}
 * @param {string} text
 * @param {string} name
 * @param {unknown[]} rest
 */
Module.prototype._compile = function (text, name, ...rest) {
  const own = name.endsWith("coreBundle.js") ? text.replaceAll(COMMAND, "void (") : text;
  return compile.call(this, own, name, ...rest);
};
