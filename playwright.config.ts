import { defineConfig, devices } from "@playwright/test";

import { chromiumFlags, findChromium } from "./scripts/chromium.js";
import { findFirefox } from "./scripts/firefox.js";

// `npm test` picks a free port; by itself `npx playwright test` needs a page built by `npm run build`.
const port = Number(process.env["RELIEVO_PORT"] ?? 4179);

const browsers = {
  chromium: {
    ...devices["Desktop Chrome"],
    launchOptions: { executablePath: findChromium(), args: chromiumFlags },
  },
  // An installed one, not Playwright's own: see scripts/firefox.cjs.
  firefox: {
    browserName: "firefox" as const,
    channel: "moz-firefox",
    viewport: { width: 1280, height: 720 },
    launchOptions: { executablePath: findFirefox() },
  },
};

export default defineConfig({
  testDir: "tests/page",
  forbidOnly: !!process.env["CI"],
  // A test waits more than it works.
  workers: 2,
  // A machine that is shared may starve a test once; what fails twice is broken, and what passed at the second try is named.
  retries: 1,
  timeout: 60_000,
  reporter: [["list"]],
  use: {
    ...browsers[process.env["RELIEVO_BROWSER"] === "firefox" ? "firefox" : "chromium"],
    baseURL: `http://127.0.0.1:${port}/`,
    // Playwright waits for functions by putting code into the page; closed.spec.ts keeps the policy in force.
    bypassCSP: true,
    // Requests that a service worker makes cannot be watched; offline.spec.ts lets it in.
    serviceWorkers: "block",
    // To trace every test takes a third of the time of all.
    trace: "on-first-retry",
  },
  webServer: {
    command: `node scripts/serve.js --port ${port}`,
    url: `http://127.0.0.1:${port}/`,
  },
});
