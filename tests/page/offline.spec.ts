/** The page keeps itself: works without a network after the first visit, says when it is new, and asks nobody else. */

import { expect, look, read, test, until } from "./helpers";

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
  await page.getByRole("radio", { name: "Relief" }).check({ force: true });
  await expect(page.locator("#relief canvas")).toBeVisible();
  await context.setOffline(false);
});

test("a new version says so, and takes over when it is asked to", async ({ page, context }) => {
  await page.goto("./#blocks");
  await until(page, ({ frames, busy }) => frames !== null && busy === null);
  await page.evaluate(installed);
  await page.waitForFunction(() => navigator.serviceWorker.controller !== null);
  await expect(page.locator("#update")).toBeHidden();
  // The same worker with another build's name.
  await context.route(/service-worker\.js$/, async (route) => {
    const response = await route.fetch();
    const body = (await response.text()).replace(/relievo-(?=`|"|')/, "relievo-next-");
    await route.fulfill({ response, body: `${body}\n// next` });
  });
  await page.evaluate(() => navigator.serviceWorker.ready.then((it) => it.update()));
  await expect(page.locator("#update")).toBeVisible();
  await expect(page.locator("#update")).toContainText("new version");
  const loaded = page.waitForEvent("load");
  await page.getByRole("button", { name: "Reload" }).click();
  await loaded;
  await until(page, ({ frames, busy }) => frames !== null && busy === null);
  expect(await read(page, ({ source }) => source)).toMatchObject({ name: "blocks" });
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
