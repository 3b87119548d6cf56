/** Both eyes' pictures: as an anaglyph, side by side, in turn, on the full screen. */

import type { Page } from "@playwright/test";

import { chooseView, expect, look, read, solve, test, until } from "./helpers";

const EYES = "canvas.eyes";

async function shownAs(page: Page, value: string): Promise<void> {
  await page.getByLabel("Shown as").selectOption(value);
  await until(page, ({ pictured, pictures }) => {
    return pictured.startsWith("anaglyph ") && pictures.length === 1 && pictures[0] !== null;
  });
}

/** The picture that the core sent, its halves one after the other, as sums of their pixels. */
const halves = (page: Page) =>
  page.evaluate(() => {
    const { pictures } = (window as unknown as { relievo: { pictures: ImageBitmap[] } }).relievo;
    const canvas = document.createElement("canvas");
    [canvas.width, canvas.height] = [pictures[0]!.width, pictures[0]!.height];
    const context = canvas.getContext("2d")!;
    context.drawImage(pictures[0]!, 0, 0);
    return [0, 1].map((half) => {
      const width = canvas.width / 2;
      const { data } = context.getImageData(half * width, 0, width, canvas.height);
      return data.reduce((sum, value, i) => (Math.imul(sum, 31) + value * ((i % 7) + 1)) | 0, 0);
    });
  });

test("pairs stand side by side, crossed the other way round, as swapped eyes do", async ({
  opened: page,
}) => {
  await solve(page);
  await chooseView(page, "Anaglyph");
  await expect(page.locator(EYES)).toBeHidden();
  await shownAs(page, "parallel");
  await expect(page.locator(EYES)).toBeVisible();
  await until(page, ({ pictures }) => pictures[0]!.width > 1.9 * pictures[0]!.height);
  const [left, right] = await halves(page);
  expect(left).not.toBe(right);
  await shownAs(page, "crossed");
  await expect.poll(() => halves(page)).toEqual([right, left]);
  await page.getByLabel("Swap eyes").check();
  await expect.poll(() => halves(page)).toEqual([left, right]);
  expect((await look(page, EYES)).colours).toBeGreaterThan(8);
});

test("wiggling shows one eye after the other until it is stopped", async ({ opened: page }) => {
  await solve(page);
  await chooseView(page, "Anaglyph");
  await shownAs(page, "wiggle");
  const prints = new Set<number>();
  await expect
    .poll(async () => prints.add((await look(page, EYES)).print).size, {
      intervals: [40],
      timeout: 30_000,
    })
    .toBeGreaterThan(1);
  await page.getByRole("button", { name: "Stop wiggling" }).click();
  const { print } = await look(page, EYES);
  await page.waitForTimeout(500);
  expect((await look(page, EYES)).print).toBe(print);
});

test.describe("who wants less motion", () => {
  test.use({ contextOptions: { reducedMotion: "reduce" } });

  test("sees one eye's picture until the button is pressed", async ({ opened: page }) => {
    await solve(page);
    await chooseView(page, "Anaglyph");
    await shownAs(page, "wiggle");
    const { print } = await look(page, EYES);
    await page.waitForTimeout(500);
    expect((await look(page, EYES)).print).toBe(print);
    await page.getByRole("button", { name: "Wiggle", exact: true }).click();
    await expect.poll(async () => (await look(page, EYES)).print).not.toBe(print);
  });
});

test("the method is named, parallax is told in percent, convergence is automatic until it is set", async ({
  opened: page,
}) => {
  await solve(page);
  await chooseView(page, "Anaglyph");
  const method = page.locator(".method");
  await expect(method).toHaveText("Least squares, E. Dubois, ICASSP 2001");
  await page.getByLabel("Glasses").selectOption("half-colour");
  await expect(method).toContainText("Half colour");
  await expect(page.locator("output[for=setting-baseline]")).toHaveText("2.5\u00a0%");
  const automatic = page.getByLabel("Automatic convergence");
  await expect(automatic).toBeChecked();
  await page.getByRole("slider", { name: "Convergence" }).fill("0.1");
  await expect(automatic).not.toBeChecked();
  expect(await read(page, ({ viewParams }) => viewParams.convergence)).toBe(0.1);
});

test("anaglyph and relief fill the screen on demand", async ({ opened: page }) => {
  await solve(page);
  await chooseView(page, "Anaglyph");
  await page.getByRole("button", { name: "Full screen" }).click();
  const filling = () => page.evaluate(() => document.fullscreenElement?.id ?? null);
  await expect.poll(filling).toBe("stage");
  await page.getByRole("button", { name: "Leave full screen" }).click();
  await expect.poll(filling).toBe(null);
});
