/** Nothing is lost: by a reload, another sequence, a change of mind, a broken worker. */

import AxeBuilder from "@axe-core/playwright";
import type { Page } from "@playwright/test";

import {
  chooseView,
  expect,
  framesOf,
  look,
  open,
  openScene,
  PATIENCE,
  png,
  read,
  ready,
  solve,
  test,
  until,
  inExport,
  inResult,
  inSettings,
  inTransport,
} from "./helpers";

/** Waits until this device keeps what is seen, with its result. */
async function kept(page: Page, id: string, result = true): Promise<void> {
  await page.waitForFunction(
    ([id, result]) => {
      const { memory } = (
        window as unknown as { relievo: { memory: { id: string; resultBytes: number }[] } }
      ).relievo;
      return memory.some(
        (one) => one.id.startsWith(id as string) && one.resultBytes > 0 === result,
      );
    },
    [id, result] as const,
    { timeout: PATIENCE },
  );
}

const resumed = (page: Page) =>
  until(page, ({ frames, busy, started }) => frames !== null && busy === null && started);

test("curves, settings, view and result are there after a reload", async ({ opened: page }) => {
  await (await inResult(page)).getByRole("button", { name: "Delete curve 2" }).click();
  await (
    await inSettings(page)
  )
    .getByLabel("Brightness change")
    .evaluate((box: HTMLInputElement) => box.click());
  await solve(page);
  await chooseView(page, "Depth");
  await page.locator("#setting-palette").selectOption({ index: 1 });
  await until(page, ({ viewParams }) => viewParams.palette !== "ember");
  await kept(page, "blocks");
  await page.waitForTimeout(600);
  const facts = () =>
    read(page, ({ shapes, options, view, viewParams, report, contours, scores }) =>
      JSON.stringify({ shapes, options, view, viewParams, report, contours, scores }),
    );
  const before = await facts();
  const seen = await look(page);
  await page.reload();
  await resumed(page);
  await until(page, ({ pictured }) => pictured.startsWith("depth"));
  expect(await facts()).toBe(before);
  expect((await look(page)).print).toBe(seen.print);
  await expect((await inResult(page)).locator("#energy-panel")).toBeVisible();
  // It can be worked on as if nothing had been.
  const take = (await inExport(page)).getByRole("button", { name: "Depth Z: PFM" });
  await Promise.all([page.waitForEvent("download"), take.click()]);
  await page.keyboard.press("Escape");
  await solve(page);
});

test("a reload without an address finds what was left last", async ({ opened: page }) => {
  await openScene(page, "squares");
  await solve(page);
  await kept(page, "squares");
  await page.goto("about:blank");
  await page.goto("./");
  await resumed(page);
  expect(await read(page, ({ source }) => source)).toMatchObject({ name: "squares" });
});

test("another sequence and back: the result is still there", async ({ opened: page }) => {
  await solve(page);
  const before = await read(page, ({ report }) => JSON.stringify(report));
  await openScene(page, "squares");
  await until(page, ({ started }) => !started);
  await openScene(page, "blocks");
  await resumed(page);
  expect(await read(page, ({ report }) => JSON.stringify(report))).toBe(before);
});

test("frames of one's own survive a reload, and are in the list beside the sequences", async ({
  opened: page,
}) => {
  const [one, two] = await framesOf(page, "squares");
  await page.locator("#file-0").setInputFiles([png("a.png", one), png("b.png", two)]);
  await until(page, ({ source, busy }) => source?.kind === "files" && busy === null);
  await (await inResult(page)).getByRole("button", { name: "Add a circle" }).click();
  await solve(page);
  await kept(page, "own-");
  await page.reload();
  await resumed(page);
  expect(await read(page, ({ shapes, title }) => [shapes.length, title])).toEqual([
    1,
    "Your own frames",
  ]);
  await expect(page.locator("#slots")).toContainText("a.png");
  await openScene(page, "blocks");
  await page.locator("#scene").selectOption({ label: "Your own frames" });
  await resumed(page);
  await expect(page.locator("#slots-note")).toContainText("These are your frames");
});

test("what is kept is said, and can be forgotten", async ({ opened: page }) => {
  await solve(page);
  await kept(page, "blocks");
  await expect(page.locator("#kept")).toContainText(/1 pair .* of at most 256/);
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
  await (await inResult(page)).getByRole("button", { name: "Forget all" }).click();
  await expect(page.locator("#kept")).toContainText("Nothing is kept");
  // What is open stays.
  expect(await read(page, ({ started }) => started)).toBe(true);
  await page.goto("about:blank");
  await page.goto("./");
  await until(page, ({ playing }) => playing);
});

test("a browser that keeps nothing is no hindrance", async ({ page }) => {
  await page.addInitScript(() => Object.defineProperty(window, "indexedDB", { value: undefined }));
  await open(page);
  await expect(page.locator("#kept")).toContainText("does not let the page keep anything");
  await solve(page);
  await openScene(page, "squares");
  await expect(page.locator("#message")).toBeHidden();
});

test("nudging a curve after a solve starts anew, and undo brings the result back", async ({
  opened: page,
}) => {
  await solve(page);
  const report = await read(page, (state) => JSON.stringify(state.report));
  const seen = await look(page);
  const energy = await page.locator("#energy-text").textContent();
  await (await inResult(page)).getByRole("button", { name: "Curve 1", exact: true }).click();
  await page.keyboard.press("Shift+ArrowUp");
  await until(page, ({ started, report }) => !started && report?.iterations === 0);
  // No number of another result.
  await expect((await inResult(page)).locator("#energy-panel")).toBeHidden();
  await expect(page.locator("#status")).toHaveText("Ready");
  await page.getByRole("button", { name: "Undo" }).click();
  await resumed(page);
  expect(await read(page, (state) => JSON.stringify(state.report))).toBe(report);
  await expect(page.locator("#energy-text")).toHaveText(energy!);
  expect((await look(page)).print).toBe(seen.print);
  await page.getByRole("button", { name: "Redo" }).click();
  await until(page, ({ started, report }) => !started && report?.iterations === 0);
  await expect((await inResult(page)).locator("#energy-panel")).toBeHidden();
});

test("settings and resets are undone as well, in any view", async ({ opened: page }) => {
  await solve(page);
  const passes = await read(page, ({ report }) => report!.iterations);
  await chooseView(page, "Depth");
  await (await inSettings(page)).getByLabel("Focal length f, px").fill("500");
  await (await inSettings(page)).getByLabel("Focal length f, px").press("Enter");
  await until(page, ({ started }) => !started);
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await until(page, ({ report }) => report?.levels === 1);
  const undo = page.getByRole("button", { name: "Undo" });
  await undo.click();
  await until(page, ({ report, options }) => report!.levels > 1 && options.preset === undefined);
  await undo.click();
  await resumed(page);
  await expect((await inSettings(page)).getByLabel("Focal length f, px")).toHaveValue("320");
  expect(await read(page, ({ report }) => report!.iterations)).toBe(passes);
  await page.getByRole("button", { name: "Reset" }).click();
  await until(page, ({ started }) => !started);
  await undo.click();
  await resumed(page);
  expect(await read(page, ({ report }) => report!.iterations)).toBe(passes);
});

test("a cancelled run gives back the result from before it", async ({ opened: page }) => {
  // Long enough to be cancelled, however slow the machine.
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await solve(page);
  const passes = await read(page, ({ report }) => report!.iterations);
  await until(page, ({ heldFound }) => heldFound !== null);
  await (await inTransport(page)).getByLabel("Pace").selectOption("slow enough to watch");
  await page.getByRole("button", { name: "Run again" }).click();
  await until(page, ({ running, report }) => running && report!.iterations < 6);
  await page.getByRole("button", { name: "Cancel" }).click();
  await until(page, ({ started, running }) => !started && !running);
  await page.getByRole("button", { name: "Undo" }).click();
  await resumed(page);
  expect(await read(page, ({ report }) => report!.iterations)).toBe(passes);
});

test("a new pair is set up with the present settings", async ({ opened: page }) => {
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  const [one, two] = await framesOf(page, "squares");
  await page.locator("#file-0").setInputFiles([png("a.png", one), png("b.png", two)]);
  await until(page, ({ source, busy }) => source?.kind === "files" && busy === null);
  // One scale is paper's: it was opened with that preset, not with the default.
  await until(page, ({ report }) => report?.levels === 1);
  await expect((await inSettings(page)).getByLabel("Preset")).toHaveValue("paper");
  await ready(page);
});
