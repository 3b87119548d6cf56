/** Every view draws a picture, and one of its own. */

import { readFile } from "node:fs/promises";

import type { Page } from "@playwright/test";

import type { State } from "../../www/store";
import {
  chooseView,
  drawn,
  expect,
  look,
  read,
  ready,
  solve,
  test,
  until,
  inExport,
  inResult,
} from "./helpers";

const FLAT = ["Depth", "Motion", "Anaglyph", "Labels", "Confidence", "Occlusion", "Compare"];

test("each view shows something, and something else than the others", async ({ opened: page }) => {
  await solve(page);
  const prints = new Map<number, string>();
  for (const name of ["Curves", ...FLAT]) {
    await chooseView(page, name);
    await expect
      .poll(async () => (await look(page)).colours, { message: name, timeout: 30_000 })
      .toBeGreaterThan(2);
    const { print } = await look(page);
    expect(prints.get(print), `${name} looks like another`).toBeUndefined();
    prints.set(print, name);
  }
});

test("a view's own choices change its picture", async ({ opened: page }) => {
  await solve(page);
  const changes: [string, string][] = [
    ["Depth", "#setting-palette"],
    ["Motion", "#setting-motion"],
    ["Anaglyph", "#setting-glasses"],
    ["Compare", "#setting-compare"],
  ];
  for (const [view, select] of changes) {
    await chooseView(page, view);
    await until(page, (state) => state.pictures.length > 0 && state.pictures.every(Boolean));
    const { print } = await look(page);
    await page.locator(select).selectOption({ index: 1 });
    await expect
      .poll(async () => (await look(page)).print, { message: view, timeout: 30_000 })
      .not.toBe(print);
  }
});

test("parallax and convergence change the anaglyph", async ({ opened: page }) => {
  await solve(page);
  await chooseView(page, "Anaglyph");
  await until(page, (state) => state.pictures.length > 0 && state.pictures.every(Boolean));
  for (const name of ["Parallax", "Convergence"]) {
    const { print } = await look(page);
    await page.getByRole("slider", { name }).focus();
    await page.keyboard.press("End");
    await expect
      .poll(async () => (await look(page)).print, { message: name, timeout: 30_000 })
      .not.toBe(print);
  }
});

test("the truth, the found and Horn–Schunck stand side by side", async ({ opened: page }) => {
  await solve(page);
  await chooseView(page, "Compare");
  await expect(page.locator("#captions span")).toHaveText(["Truth", "Found", "Horn–Schunck"]);
});

test("no picture stands under another's name, nor is taken away under it", async ({
  opened: page,
}) => {
  await chooseView(page, "Compare");
  const stage = page.locator("#stage");
  const take = (await inExport(page)).getByRole("button", { name: "The stage: PNG" });
  await expect(stage).toHaveAttribute("aria-busy", "false");
  // Looked at before the worker can have answered.
  const [busy, unavailable, captions] = await page.evaluate(() => {
    const what = document.querySelector<HTMLSelectElement>("#setting-compare")!;
    what.value = "labels";
    what.dispatchEvent(new Event("change"));
    const take = document.querySelector<HTMLButtonElement>("#save-view")!;
    return [
      document.getElementById("stage")!.ariaBusy,
      take.disabled,
      getComputedStyle(document.getElementById("captions")!).visibility,
    ];
  });
  expect([busy, unavailable, captions]).toEqual(["true", true, "hidden"]);
  await until(page, ({ pictured }) => pictured === "compare labels");
  await expect(stage).toHaveAttribute("aria-busy", "false");
  await expect(take).toBeEnabled();
  await expect(page.locator("#captions span").first()).toBeVisible();
});

test("the depth slider of a region changes depth, not its outline", async ({ opened: page }) => {
  await solve(page);
  await chooseView(page, "Labels");
  await until(page, (state) => state.pictures.every(Boolean) && state.pictures.length === 1);
  const labels = await look(page);
  await chooseView(page, "Depth");
  await until(page, (state) => state.pictures.every(Boolean) && state.pictures.length === 1);
  await drawn(page);
  const depth = await look(page);
  await (await inResult(page)).locator("#scale-1").fill("1.5");
  await expect
    .poll(async () => (await look(page)).print, { timeout: 30_000 })
    .not.toBe(depth.print);
  await chooseView(page, "Labels");
  await expect.poll(async () => (await look(page)).print, { timeout: 30_000 }).toBe(labels.print);
});

test("depth factors start anew with another number of regions, as their sliders do", async ({
  opened: page,
}) => {
  await solve(page);
  await (await inResult(page)).locator("#scale-0").fill("2");
  expect(await read(page, (state) => state.scales)).toEqual([4, 1, 1]);
  await (await inResult(page)).getByRole("button", { name: "Delete curve 1" }).click();
  expect(await read(page, (state) => state.scales)).toEqual([]);
  await expect((await inResult(page)).locator("#scale-0")).toHaveValue("0");
});

test("the relief stands, turns by keyboard and mouse, and takes plaster", async ({
  opened: page,
}) => {
  await solve(page);
  await chooseView(page, "Relief");
  const canvas = page.locator("#relief canvas");
  await expect(canvas).toBeVisible({ timeout: 60_000 });
  const seen = () => look(page, "#relief canvas");
  await expect.poll(async () => (await seen()).colours, { timeout: 60_000 }).toBeGreaterThan(8);
  let last = (await seen()).print;
  const changed = async (what: string) => {
    await expect
      .poll(async () => (await seen()).print, { message: what, timeout: 30_000 })
      .not.toBe(last);
    last = (await seen()).print;
  };
  await canvas.focus();
  await page.keyboard.press("ArrowRight");
  await changed("arrow key");
  await page.keyboard.press("+");
  await changed("plus");
  const box = (await canvas.boundingBox())!;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 80, box.y + box.height / 2 + 20, { steps: 4 });
  await page.mouse.up();
  await changed("drag");
  await page.getByLabel("Surface").selectOption("plaster");
  await changed("plaster");
  for (const surface of ["wireframe", "normals", "plaster"]) {
    await page.getByLabel("Surface").selectOption(surface);
    await changed(surface);
  }
  const lamp = page.getByRole("button", { name: /^Light from above/ });
  await lamp.focus();
  await page.keyboard.press("ArrowDown");
  await changed("light by keyboard");
  const at = (await page.locator(".lamp").boundingBox())!;
  await page.mouse.move(at.x + at.width / 2, at.y + at.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + 0.7 * box.width, box.y + 0.7 * box.height, { steps: 3 });
  await page.mouse.up();
  await changed("light by its handle");
  await expect(page.getByRole("button", { name: /^Light from below and the right/ })).toBeVisible();
  await canvas.focus();
  await page.keyboard.press("Shift+ArrowUp");
  await changed("light by Shift");
});

/** The present view as it is saved. */
async function saved(page: Page): Promise<Buffer> {
  const take = (await inExport(page)).getByRole("button", { name: "The stage: PNG" });
  const [picture] = await Promise.all([page.waitForEvent("download"), take.click()]);
  await page.keyboard.press("Escape");
  return readFile(await picture.path());
}

test("curves that are only drawn are on the picture of their view", async ({ opened: page }) => {
  const both = await saved(page);
  await (await inResult(page)).getByRole("button", { name: "Delete curve 1" }).click();
  await drawn(page);
  expect((await saved(page)).equals(both)).toBe(false);
});

test("pictures compared keep their names when they are taken away", async ({ opened: page }) => {
  await chooseView(page, "Compare");
  const png = (await saved(page)).toString("base64");
  const [edge, line] = await page.evaluate(async (png) => {
    const picture = await createImageBitmap(
      await (await fetch(`data:image/png;base64,${png}`)).blob(),
    );
    const context = new OffscreenCanvas(picture.width, picture.height).getContext("2d")!;
    context.drawImage(picture, 0, 0);
    return [0, 13].map((y) => {
      const { data } = context.getImageData(0, y, picture.width, 1);
      return new Set(new Uint32Array(data.buffer)).size;
    });
  }, png);
  expect(edge, "colours above the names").toBe(1);
  expect(line, "colours across the names").toBeGreaterThan(1);
});

test("compared depth has the truth's colours whatever unit a region has", async ({
  opened: page,
}) => {
  await solve(page);
  await chooseView(page, "Compare");
  await page.locator("#setting-compare").selectOption("depth");
  await until(page, ({ pictured, pictures }) => {
    return pictured === "compare depth" && pictures.every((one) => one !== null);
  });
  /** Mean difference between what was found and the truth, in levels, where both are in colour. */
  const apart = () =>
    page.evaluate(() => {
      const { pictures } = (window as unknown as { relievo: State }).relievo;
      const [truth, found] = pictures.map((picture) => {
        const canvas = document.createElement("canvas");
        [canvas.width, canvas.height] = [picture!.width, picture!.height];
        const context = canvas.getContext("2d")!;
        context.drawImage(picture!, 0, 0);
        return context.getImageData(0, 0, canvas.width, canvas.height).data;
      });
      let [sum, count] = [0, 0];
      for (let i = 0; i < truth!.length; i += 4) {
        // Hatching is grey: no depth is told there.
        if (found![i]! - found![i + 2]! < 12 || truth![i]! - truth![i + 2]! < 12) continue;
        count += 3;
        for (let k = 0; k < 3; k++) sum += Math.abs(truth![i + k]! - found![i + k]!);
      }
      return { apart: sum / count, share: (4 * count) / (3 * truth!.length) };
    });
  const first = await apart();
  expect(first.share).toBeGreaterThan(0.05);
  expect(first.apart).toBeLessThan(16);
  await (await inResult(page)).locator("#scale-1").fill("2");
  await drawn(page);
  await ready(page);
  expect((await apart()).apart).toBeCloseTo(first.apart, 1);
});
