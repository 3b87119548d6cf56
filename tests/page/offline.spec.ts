/** The page keeps itself: works without a network after the first visit, says when it is new, and asks nobody else. */

import { appendFileSync, cpSync, rmSync } from "node:fs";
import { join } from "node:path";

import { serve } from "../../scripts/serve.js";
import { moments, photo } from "./films";
import { expect, look, PATIENCE, read, test, until, pressView } from "./helpers";

test.use({ serviceWorkers: "allow" });

const installed = () => navigator.serviceWorker.ready.then(({ active }) => active?.state);

test("after the first visit it works without a network", async ({ page, context }) => {
  await page.goto("./#squares");
  await until(page, ({ frames, busy }) => frames !== null && busy === null);
  await page.evaluate(installed);
  await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
  await context.setOffline(true);
  await page.goto("about:blank");
  await page.goto("./#blocks");
  await until(page, ({ frames, busy }) => frames !== null && busy === null);
  expect((await look(page)).colours).toBeGreaterThan(20);
  // What is loaded late is there, too.
  await pressView(page, "Relief");
  await expect(page.locator("#relief canvas")).toBeVisible();
  const photos = await Promise.all(moments(2).map((view) => photo(page, view, 72)));
  const files = photos.map((buffer, i) => ({ name: `${i}.jpg`, mimeType: "image/jpeg", buffer }));
  await page.locator("#film-file").setInputFiles(files);
  await until(page, ({ source, busy }) => source?.kind === "files" && busy === null);
  await context.setOffline(false);
});

test("a new version says so, and takes over when it is asked to", async ({ page }, info) => {
  // Served from a copy, in which another build can be put.
  const folder = info.outputPath("dist");
  cpSync("dist", folder, { recursive: true });
  const { server, address } = await serve("127.0.0.1", 0, folder);
  try {
    await page.goto(`${address}#blocks`);
    await until(page, ({ frames, busy }) => frames !== null && busy === null);
    await page.evaluate(installed);
    await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
    await expect(page.locator("#update")).toBeHidden();
    const worker = join(folder, "service-worker.js");
    appendFileSync(worker, "// another build\n");
    for (const ending of [".br", ".gz"]) rmSync(worker + ending, { force: true });
    await page.evaluate(() => navigator.serviceWorker.ready.then((it) => it.update()));
    const offer = page.locator("#update");
    await expect(offer).toContainText("new version", { timeout: PATIENCE });
    await expect(offer).toBeVisible({ timeout: PATIENCE });
    const loaded = page.waitForEvent("load", { timeout: PATIENCE });
    await page.getByRole("button", { name: "Reload" }).click();
    await loaded;
    await until(page, ({ frames, busy }) => frames !== null && busy === null);
    await expect(offer).toBeHidden();
    expect(await read(page, ({ source }) => source)).toMatchObject({ name: "blocks" });
  } finally {
    server.closeAllConnections();
    server.close();
  }
});

test("the manifest makes it installable", async ({ page, request, baseURL }) => {
  await page.goto("./");
  const address = await page.locator("link[rel=manifest]").getAttribute("href");
  const manifest = await (await request.get(new URL(address!, baseURL).href)).json();
  expect(manifest).toMatchObject({ name: "Relievo", display: "standalone" });
  for (const { src } of manifest.icons) {
    expect((await request.get(new URL(src, baseURL).href)).ok(), src).toBe(true);
  }
});
