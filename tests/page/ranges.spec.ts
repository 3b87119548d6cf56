/** Ranges of colours whose ends are typed, judged by the pixels that they colour. */

import AxeBuilder from "@axe-core/playwright";
import type { Page } from "@playwright/test";

import { chooseView, expect, look, open, read, runLong, solve, test, until } from "./helpers";

const legend = (page: Page) => page.locator("#legend");
const hold = (page: Page) => page.getByRole("button", { name: "Hold the range" });

async function type(page: Page, name: RegExp, text: string): Promise<void> {
  const field = page.getByRole("spinbutton", { name });
  await field.fill(text);
  await field.press("Enter");
}

/** Does something, and waits until the picture is another; gives its print. */
async function changing(page: Page, act: () => Promise<unknown>): Promise<number> {
  const { print } = await look(page);
  await act();
  await expect.poll(async () => (await look(page)).print).not.toBe(print);
  return (await look(page)).print;
}

const shows = (page: Page, print: number) =>
  expect.poll(async () => (await look(page)).print).toBe(print);

test("both ends of depth are typed, a bad one is said, and the range follows again", async ({
  opened: page,
}) => {
  await solve(page);
  await chooseView(page, "Depth");
  const { print: automatic } = await look(page);
  await expect(legend(page).getByRole("spinbutton")).toHaveCount(0);
  await hold(page).click();
  await expect(hold(page)).toBeFocused();
  const near = page.getByLabel("Nearest depth, × mean");
  const far = page.getByLabel("Farthest depth, × mean");
  // What is held is what was drawn.
  await shows(page, automatic);
  await changing(page, () => type(page, /Nearest/, "0.5"));
  const typed = await changing(page, () => type(page, /Farthest/, "1.7"));
  const marks = (await legend(page).locator("li").allTextContents()).map(Number);
  expect([marks[0], marks.at(-1)]).toEqual([1.7, 0.5]);
  await expect(page.locator("#announcer")).toContainText("from 0.5 to 1.7 × mean");

  for (const [text, words] of [
    ["", "no number was typed"],
    ["e", "not a number"],
    ["2", "2 is not less than the farthest depth, 1.7"],
    ["1.7", "not less"],
    ["-1", "between 0.0001 and 100000"],
    ["0", "between"],
  ] as const) {
    await near.selectText();
    await near.press("Delete");
    await near.pressSequentially(text);
    await near.press("Enter");
    await expect(page.locator("#message")).toContainText(words);
    await expect(near).toHaveValue("0.5");
    await page.getByRole("button", { name: "Dismiss" }).click();
  }
  await type(page, /Farthest/, "0.4");
  await expect(page.locator("#message")).toContainText("0.4 is not more than the nearest depth");
  await expect(far).toHaveValue("1.7");
  // One that is good takes the sentence down, by leaving the field as well.
  await near.fill("0.6");
  await near.press("Tab");
  await expect(far).toBeFocused();
  await expect(page.locator("#message")).toBeHidden();
  await changing(page, () => type(page, /Nearest/, "0.5"));
  await shows(page, typed);

  await near.fill("0.9");
  await near.press("Escape");
  await expect(near).toHaveValue("0.5");
  await near.press("Tab");
  await shows(page, typed);
  await hold(page).click();
  await expect(legend(page).getByRole("spinbutton")).toHaveCount(0);
  await shows(page, automatic);
});

test("what is held after a run that was watched is what is seen at its end", async ({
  opened: page,
}) => {
  await chooseView(page, "Depth");
  await solve(page);
  await expect(hold(page)).toBeVisible();
  const { print: automatic } = await look(page);
  const marks = await legend(page).locator("li").allTextContents();
  await hold(page).click();
  await expect(page.getByLabel("Nearest depth, × mean")).toBeVisible();
  await shows(page, automatic);
  expect(await legend(page).locator("li").allTextContents()).toEqual(marks);
});

test("motion, residual and errors have an end to type", async ({ opened: page }) => {
  await solve(page);
  const ends: [string, RegExp, string][] = [
    ["Motion", /Motion at the end of the colours, px\/frame/, "9"],
    ["Residual", /Residual .* at the end of the colours, grey levels/, "40"],
    ["Error", /Motion error at the end of the colours, px/, "3"],
  ];
  for (const [view, name, text] of ends) {
    await chooseView(page, view);
    const { print: automatic } = await look(page);
    await hold(page).click();
    await changing(page, () => type(page, name, text));
    const address = () => page.evaluate(() => location.hash);
    await expect.poll(address).toMatch(new RegExp(`:${text}(~|&|$)`));
    await hold(page).click();
    await shows(page, automatic);
  }
  await page.locator("#setting-error").selectOption("Depth");
  await expect(legend(page)).toContainText(/Depth error.*%/);
  await hold(page).click();
  await changing(page, () => type(page, /Depth error.*, %/, "80"));
  await chooseView(page, "Motion");
  await page.locator("#setting-motion").selectOption("Arrows");
  await expect(legend(page)).toContainText("longest");
  await hold(page).click();
  await changing(page, () => type(page, /longest arrow, px\/frame/, "9"));
});

test("typed ends hold on both sides of a divider, in a link, for Back and for another day", async ({
  opened: page,
  browser,
  baseURL,
}) => {
  await page.context().grantPermissions(["clipboard-read", "clipboard-write"]);
  await solve(page);
  await chooseView(page, "Depth");
  await page.getByRole("button", { name: "Two views" }).click();
  await page.getByLabel("Left of the divider").selectOption("Found: residual");
  const [first, second] = [hold(page).first(), hold(page).last()];
  await first.click();
  await second.click();
  await changing(page, () => type(page, /Residual/, "30"));
  const before = await changing(page, () => type(page, /Nearest/, "0.7"));
  const typed = await changing(page, () => type(page, /Farthest/, "1.3"));
  await page.goBack();
  await expect(page.getByRole("spinbutton", { name: /Farthest/ })).not.toHaveValue("1.3");
  await shows(page, before);
  await page.goForward();
  await expect(page.getByRole("spinbutton", { name: /Farthest/ })).toHaveValue("1.3");
  await shows(page, typed);

  await page.getByRole("button", { name: "Share a link" }).click();
  const link = await page.evaluate(() => navigator.clipboard.readText());
  const other = await browser.newPage({ baseURL: baseURL! });
  await open(other, link);
  await solve(other);
  await expect(other.getByRole("spinbutton", { name: /Residual/ })).toHaveValue("30");
  await expect(other.getByRole("spinbutton", { name: /Nearest/ })).toHaveValue("0.7");
  await expect(other.getByRole("spinbutton", { name: /Farthest/ })).toHaveValue("1.3");
  await shows(other, typed);
  await other.close();

  // Beside the truth depth has another unit, and so a range of its own.
  await page.getByLabel("Left of the divider").selectOption("Truth: depth");
  const unit = page.getByLabel("Nearest depth, unit of the truth");
  await expect(legend(page)).toContainText("unit of the truth");
  await expect(unit).toHaveCount(0);
  await hold(page).click();
  await changing(page, () => type(page, /Nearest/, "0.1"));
  await page.getByLabel("Left of the divider").selectOption("Found: residual");
  await expect(page.getByLabel("Nearest depth, × mean")).toHaveValue("0.7");
  await shows(page, typed);

  // Kept with the pair.
  await until(page, ({ memory }) => (memory?.length ?? 0) > 0);
  await page.waitForTimeout(700);
  await page.goto("about:blank");
  await open(page, "./#blocks/depth");
  await expect(page.getByLabel("Nearest depth, × mean")).toHaveValue("0.7");
});

test("who types while it runs is not disturbed", async ({ opened: page }) => {
  await chooseView(page, "Curves");
  await runLong(page);
  await chooseView(page, "Residual");
  await hold(page).click();
  const end = page.getByRole("spinbutton", { name: /Residual/ });
  await end.selectText();
  await end.pressSequentially("3");
  const passes = await read(page, ({ report }) => report!.iterations);
  await page.waitForFunction(
    (before) =>
      (window as unknown as { relievo: { report: { iterations: number } } }).relievo.report
        .iterations >
      before + 1,
    passes,
  );
  await end.pressSequentially("7");
  await end.press("Enter");
  await expect(end).toBeFocused();
  expect(await read(page, ({ ranges }) => ranges.most)).toEqual({ residual: 37 });
});

test.describe("on a phone", () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true });

  test("the ends are in sight, large enough to touch, and axe finds nothing", async ({
    opened: page,
  }) => {
    await solve(page);
    for (const view of ["Depth", "Motion", "Residual"]) {
      await chooseView(page, view);
      await hold(page).tap();
      const fields = await legend(page).getByRole("spinbutton").all();
      expect(fields.length, view).toBeGreaterThan(0);
      for (const field of fields) {
        await expect(field).toBeInViewport({ ratio: 1 });
        const { width, height } = (await field.boundingBox())!;
        expect(Math.min(width, height), view).toBeGreaterThanOrEqual(24);
        // The whole number is seen.
        expect(await field.evaluate((one) => one.scrollWidth - one.clientWidth)).toBe(0);
      }
      const { violations } = await new AxeBuilder({ page }).analyze();
      expect(violations.map(({ id }) => id)).toEqual([]);
      const wide = await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
      expect(wide, view).toBe(true);
    }
    await page.emulateMedia({ forcedColors: "active" });
    const border = () =>
      legend(page)
        .getByRole("spinbutton")
        .evaluate((field) => getComputedStyle(field).borderTopStyle);
    expect(await border()).toBe("solid");
  });
});
