import { defineConfig, devices } from "@playwright/test";

import { chromiumFlags, findChromium } from "./scripts/chromium.js";

// `npm test` picks a free port; by itself `npx playwright test` needs a page built by `npm run build`.
const port = Number(process.env["RELIEVO_PORT"] ?? 4179);

export default defineConfig({
  testDir: "tests/page",
  forbidOnly: !!process.env["CI"],
  workers: 1,
  timeout: 60_000,
  reporter: [["list"]],
  use: {
    ...devices["Desktop Chrome"],
    baseURL: `http://127.0.0.1:${port}/`,
    trace: "retain-on-failure",
    launchOptions: { executablePath: findChromium(), args: chromiumFlags },
  },
  webServer: {
    command: `npx vite preview --host 127.0.0.1 --port ${port} --strictPort`,
    url: `http://127.0.0.1:${port}/`,
  },
});
