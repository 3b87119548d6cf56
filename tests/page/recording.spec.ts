/** What a newcomer sees: a result at once, before there is a solver; and sequences to choose from by their looks. */

import AxeBuilder from "@axe-core/playwright";

import type { State } from "../../www/store";
import {
  expect,
  look,
  open,
  openScene,
  read,
  ready,
  solve,
  test,
  until,
  inResult,
  openTab,
  pressView,
} from "./helpers";

test("a finished result plays before the core is there, and is the core's once it is", async ({
  page,
}) => {
  // The core is slow to come.
  let release = () => {};
  const held = new Promise<void>((go) => (release = go));
  await page.route(/\.wasm$/, async (route) => {
    await held;
    await route.continue();
  });
  await page.goto("./");
  await until(page, ({ playing, report }) => playing && report?.status === "converged");
  await expect(page.locator("#status")).toContainText("Recorded");
  await expect(page.getByRole("radio", { name: "Depth", exact: true })).toBeChecked();
  const recorded = await look(page);
  expect(recorded.colours).toBeGreaterThan(50);
  expect(await read(page, (state) => state.frames)).toBeNull();
  release();
  await until(page, ({ frames, busy, playing }) => frames !== null && busy === null && !playing);
  await expect(page.locator("#status")).toContainText("Converged");
  await expect((await inResult(page)).locator("#scores-panel")).toBeVisible();
  // Any view can be had of it now.
  await pressView(page, "Anaglyph");
  await until(page, ({ pictured }) => pictured.startsWith("anaglyph"));
  expect((await look(page)).colours).toBeGreaterThan(50);
});

test("the recording is what the page's own solver comes to", async ({ page }) => {
  await page.goto("./");
  await until(page, ({ playing, frames, busy }) => !playing && frames !== null && busy === null);
  await until(page, ({ scores }) => scores !== null);
  const facts = () =>
    read(page, ({ report, scores }) => ({
      history: report!.history,
      T: report!.regions.map(({ translation }) => translation),
      aee: scores!.found.aee!,
    }));
  const recorded = await facts();
  const passes = recorded.history.length;
  await solve(page);
  const live = await facts();
  expect(live.history).toHaveLength(passes);
  for (const [i, energy] of live.history.entries()) {
    expect(recorded.history[i]! / energy).toBeCloseTo(1, 6);
  }
  expect(recorded.T).toEqual(live.T);
  // To what an eye sees: 1/64 of a pixel.
  expect(Math.abs(recorded.aee - live.aee)).toBeLessThan(1 / 64);
});

test("those who want no motion see the end of it at once", async ({ page }) => {
  await page.emulateMedia({ reducedMotion: "reduce" });
  await page.route(/\.wasm$/, () => {});
  await page.goto("./");
  await until(page, ({ playing, pictures }) => playing && pictures.length > 0);
  expect(await read(page, ({ report }) => report!.status)).toBe("converged");
});

test("the picture comes before the core is asked for, within a second on a line of 10 Mbit/s", async ({
  browser,
  baseURL,
}) => {
  /** Milliseconds until there is a picture, and bytes that it took. */
  const load = async () => {
    const context = await browser.newContext({ baseURL, bypassCSP: true, serviceWorkers: "block" });
    const page = await context.newPage();
    const client = await context.newCDPSession(page);
    await client.send("Network.enable");
    await client.send("Network.emulateNetworkConditions", {
      offline: false,
      latency: 20,
      downloadThroughput: 10e6 / 8,
      uploadThroughput: 10e6 / 8,
    });
    let bytes = 0;
    client.on("Network.loadingFinished", ({ encodedDataLength }) => (bytes += encodedDataLength));
    await page.route(/\.wasm$/, () => {});
    await page.goto("./");
    const shown = await page.waitForFunction(() => {
      const state = (window as unknown as { relievo?: State }).relievo;
      return !!state?.playing && state.pictures.length > 0 && performance.now();
    });
    expect((await look(page)).colours).toBeGreaterThan(20);
    const passed = (await shown.jsonValue()) as number;
    await context.close();
    return { passed, bytes };
  };
  const loads = [await load()];
  expect(loads[0]!.bytes).toBeGreaterThan(50_000);
  expect(loads[0]!.bytes).toBeLessThan(300_000);
  // A busy machine delays a load, a slow page delays each.
  while (Math.min(...loads.map(({ passed }) => passed)) > 1000 && loads.length < 8) {
    loads.push(await load());
  }
  expect(Math.min(...loads.map(({ passed }) => passed))).toBeLessThan(1000);
});

test("a recording can be played again, and what was there before is a step back", async ({
  opened: page,
}) => {
  await (await inResult(page)).getByRole("button", { name: "Add a circle" }).click();
  await (
    await openTab(page, "Learn")
  )
    .getByRole("button", { name: "Play a recorded solve" })
    .click();
  await until(page, ({ playing, report }) => playing && (report?.iterations ?? 0) > 2);
  await until(page, ({ playing, started, busy }) => !playing && started && busy === null);
  await expect(page.locator("#status")).toContainText("Converged");
  expect(await read(page, ({ shapes }) => shapes.length)).toBe(2);
  await page.getByRole("button", { name: "Undo" }).click();
  await until(page, ({ shapes, started }) => shapes.length === 3 && !started);
});

test("every sequence has a thumbnail and a recording", async ({ opened: page }) => {
  const names = await read(page, (state) => state.catalogues!.scenes.map(({ name }) => name));
  for (const name of names) {
    const picture = page.locator(`#scene option[value=${name}] img`);
    const loads = await picture.evaluate(async (image: HTMLImageElement) => {
      const whole = new Image();
      whole.src = image.src;
      await whole.decode();
      return whole.naturalWidth;
    });
    expect(loads, name).toBeGreaterThan(100);
  }
  await page.locator("#scene").click();
  await expect(page.getByRole("option", { name: "Toy bear" }).locator("img")).toBeVisible();
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
  await page.getByRole("option", { name: "Two squares" }).click();
  await until(
    page,
    ({ source, busy }) => busy === null && source?.kind === "scene" && source.name === "squares",
  );
});

test("an unvisited sequence opens on its frame, whatever was looked at before", async ({
  page,
}) => {
  await open(page, "./#blocks/depth");
  await openScene(page, "squares");
  await ready(page);
  await expect(page.getByRole("radio", { name: "Outlines", exact: true })).toBeChecked();
  expect((await look(page)).colours).toBeGreaterThan(20);
});
