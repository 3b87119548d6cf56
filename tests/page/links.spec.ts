/** Links restore what is seen, or say what they cannot; Back and Forward step through it. */

import type { Page } from "@playwright/test";

import {
  chooseView,
  expect,
  open,
  openScene,
  read,
  ready,
  solve,
  test,
  until,
  inResult,
  inSettings,
} from "./helpers";

const setting = (page: Page) =>
  read(page, ({ source, shapes, camera, options, view, viewParams, scales }) =>
    JSON.stringify({ source, shapes, camera, options, view, viewParams, scales }),
  );

test("a shared link restores sequence, curves, settings and view elsewhere", async ({
  page,
  browser,
  baseURL,
}) => {
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await open(page, "./#squares");
  await (await inResult(page)).getByRole("button", { name: "Delete curve 2" }).click();
  await (await inResult(page)).getByRole("button", { name: "Add a circle" }).click();
  await (await inSettings(page)).getByLabel("Focal length f, px").fill("400");
  await (await inSettings(page)).getByLabel("Focal length f, px").press("Enter");
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await chooseView(page, "Anaglyph");
  await page.locator("#setting-glasses").selectOption({ index: 1 });
  await page.getByRole("button", { name: "Share a link" }).click();
  await expect(page.locator("#share-note")).toHaveText("Link copied.");
  const link = await page.evaluate(() => navigator.clipboard.readText());
  expect(link.length).toBeLessThan(200);
  const sent = await setting(page);

  const other = await browser.newPage({ baseURL: baseURL! });
  await open(other, link);
  // Curves travel to a tenth of a pixel.
  const tenths = (text: string) =>
    text.replaceAll(/-?\d+\.\d+/g, (number) => String(Math.round(10 * Number(number)) / 10));
  expect(tenths(await setting(other))).toBe(tenths(sent));
  await expect(other.locator("#message")).toBeHidden();
  await solve(other);
  await other.close();
});

for (const [name, address, words] of [
  ["curves", "./#blocks/depth?c=c1,2,x", "its curves"],
  ["a camera", "./#blocks?f=-3", "its camera"],
  ["options", "./#blocks?c=&o=mu:1e99~nothing:3", "its options"],
  ["a view", "./#blocks/hologram", "hologram"],
  ["view settings", "./#blocks/depth?c=&p=palette:__proto__", "the settings of its view"],
  ["escapes", "./#blocks/depth?c=%E0%A4%A&f=%", "its curves and its camera"],
] as const) {
  test(`a link with bad ${name} says so, and the rest holds`, async ({ page }) => {
    const broken: string[] = [];
    page.on("pageerror", (error) => broken.push(error.message));
    await open(page, address);
    await expect(page.locator("#message")).toContainText(words);
    expect(await read(page, ({ source }) => source)).toMatchObject({ name: "blocks" });
    await expect(page.getByRole("button", { name: "Run", exact: true })).toBeEnabled();
    expect(broken).toEqual([]);
  });
}

test("a curve that the core refuses is said, and the sequence opens without", async ({ page }) => {
  await open(page, "./#blocks?c=c9000,9000,5");
  await expect(page.locator("#message")).toContainText("outside");
  expect(await read(page, ({ shapes }) => shapes.length)).toBe(2);
});

test("a link to what is not there says so and shows something", async ({ page }) => {
  await open(page, "./#atlantis/depth");
  await expect(page.locator("#message")).toContainText("atlantis");
  await page.getByRole("button", { name: "Dismiss" }).click();
  await page.evaluate(() => (location.hash = "#own-0123456789abcdef/depth"));
  await expect(page.locator("#message")).toContainText("not kept on this device");
});

test("Back and Forward step through sequences and views", async ({ opened: page }) => {
  await chooseView(page, "Labels");
  await openScene(page, "squares");
  await ready(page);
  await expect(page).toHaveURL(/#squares\/curves$/);
  await page.goBack();
  await until(page, ({ source, view, busy }) => {
    return (
      busy === null && source?.kind === "scene" && source.name === "blocks" && view === "labels"
    );
  });
  await page.goBack();
  await until(page, ({ view }) => view === "curves");
  await page.goForward();
  await until(page, ({ view }) => view === "labels");
  await page.goForward();
  await until(page, ({ source, busy }) => {
    return busy === null && source?.kind === "scene" && source.name === "squares";
  });
});

test("two views, a held range, a palette and a zoom are steps, and go along in a link", async ({
  opened: page,
  browser,
  baseURL,
}) => {
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  // Numbers travel with four digits.
  const seen = async (of: Page) => {
    const exact = await read(of, ({ view, split, ranges, zoom, viewParams }) => {
      return JSON.stringify({ view, split, ranges, zoom, palette: viewParams.palette });
    });
    return exact.replaceAll(/\d+\.\d+/g, (number) => Number(number).toPrecision(3));
  };
  const at = (part: string) =>
    expect.poll(() => page.evaluate(() => location.hash)).toContain(part);
  await chooseView(page, "Depth");
  await page.locator("#setting-palette").selectOption("Viridis");
  await at("l=viridis");
  await page.getByRole("button", { name: "Two views" }).click();
  await page.getByLabel("Left of the divider").selectOption("Truth: motion");
  await page.getByRole("slider", { name: /Divider/ }).fill("30");
  await at("s=truth.flow~found.depth~0.3");
  await page.getByLabel("Right of the divider").selectOption("Error: motion");
  await page.locator("#legend").getByRole("button", { name: "Hold" }).last().click();
  await at("r=error-flow:");
  const before = await seen(page);
  await page.getByRole("button", { name: "Zoom in" }).click();
  await at("m=1.5,");
  const zoomed = await seen(page);
  await page.goBack();
  await expect.poll(() => seen(page)).toBe(before);
  await page.goForward();
  await expect.poll(() => seen(page)).toBe(zoomed);

  await page.getByRole("button", { name: "Share a link" }).click();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  const other = await browser.newPage({ baseURL: baseURL! });
  await open(other, link);
  await expect.poll(() => seen(other)).toBe(zoomed);
  await expect(other.locator("#message")).toBeHidden();
  await expect(other.locator("#side-left")).toHaveValue("truth flow");
  await other.evaluate(() => (location.hash = "#blocks/depth?s=found.depth~magic~2&l=mud"));
  await expect(other.locator("#message")).toContainText("its palette");
  await other.close();
});

test("what a link replaces can be had again", async ({ opened: page }) => {
  await (await inResult(page)).getByRole("button", { name: "Delete curve 2" }).click();
  await until(page, ({ memory }) => (memory?.length ?? 0) > 0);
  await page.waitForTimeout(700);
  await page.evaluate(() => (location.hash = "#blocks/curves?c="));
  await until(page, ({ shapes, busy }) => shapes.length === 0 && busy === null);
  await page.getByRole("button", { name: "Undo" }).click();
  await until(page, ({ shapes }) => shapes.length === 1);
});
