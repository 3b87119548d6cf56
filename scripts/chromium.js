// A Chromium for the page tests: the one that is here, else Debian's, else Playwright's own.

import { existsSync } from "node:fs";
import { platform } from "node:os";

import { ask, run, stage, Trouble, which } from "./shell.js";
import { apt } from "./setup.js";

const NAMES = ["chromium", "chromium-browser", "google-chrome", "google-chrome-stable"];
const MAC = [
  "/Applications/Google Chrome.app/Contents/MacOS/Google Chrome",
  "/Applications/Chromium.app/Contents/MacOS/Chromium",
];

/** Path of an installed Chromium, or undefined. */
export function findChromium() {
  const named = NAMES.map(which).find((path) => path !== null);
  return process.env.RELIEVO_CHROMIUM ?? named ?? MAC.find((path) => existsSync(path));
}

/** Finds a Chromium or installs one; its path, or undefined for Playwright's own. */
export async function ensureChromium() {
  const found = findChromium();
  if (found !== undefined) return found;
  if (platform() === "linux" && process.getuid?.() === 0 && ask("apt-get", "--version") !== null) {
    await apt("Chromium", "chromium");
    return findChromium();
  }
  try {
    await stage("Playwright's Chromium", () => run("playwright", ["install", "chromium"]));
  } catch {
    throw new Trouble(
      "No Chromium was found and none could be installed, so the page was not tested. " +
        "Install one (Debian: sudo apt-get install chromium) or name it in RELIEVO_CHROMIUM.",
    );
  }
}

/**
 * What a Chromium without a desktop, a graphics card or anyone logged in needs to be told. Pages are drawn by the processor:
 * through a graphics card that is simulated they take twice as long, and only WebGL needs one.
 */
export const chromiumFlags = [
  ...(process.getuid?.() === 0 ? ["--no-sandbox"] : []),
  "--disable-background-networking",
  "--disable-component-update",
  "--disable-sync",
  "--no-first-run",
  "--use-angle=swiftshader",
  "--enable-unsafe-swiftshader",
  "--disable-gpu-compositing",
  "--disable-gpu-rasterization",
];
