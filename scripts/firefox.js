// An installed Firefox for the page tests, where there is one: they run in Chromium all the same.

import { existsSync } from "node:fs";

import { which } from "./shell.js";

const NAMES = ["firefox-esr", "firefox"];
const MAC = "/Applications/Firefox.app/Contents/MacOS/firefox";

/** Path of an installed Firefox, or undefined. */
export function findFirefox() {
  const named = NAMES.map(which).find((path) => path !== null);
  return process.env.RELIEVO_FIREFOX ?? named ?? (existsSync(MAC) ? MAC : undefined);
}
