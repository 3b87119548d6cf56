/** Initial curves by mouse, finger and keyboard: drawn, moved, resized, deleted, undone. */

import type { Page } from "@playwright/test";

import {
  expect,
  look,
  onScreen,
  openScene,
  PATIENCE,
  read,
  ready,
  runLong,
  runPasses,
  test,
  until,
  inResult,
  inTransport,
} from "./helpers";

const shapes = (page: Page) => read(page, (state) => state.shapes);

async function drag(page: Page, ...way: [number, number][]): Promise<void> {
  const [start, ...rest] = way;
  const first = await onScreen(page, ...start!);
  await page.mouse.move(first.x, first.y);
  await page.mouse.down();
  for (const stop of rest) {
    const { x, y } = await onScreen(page, ...stop);
    await page.mouse.move(x, y, { steps: 6 });
  }
  await page.mouse.up();
}

async function click(page: Page, x: number, y: number): Promise<void> {
  const place = await onScreen(page, x, y);
  await page.mouse.click(place.x, place.y);
}

const pick = (page: Page, name: string) =>
  page.getByRole("radio", { name, exact: true }).check({ force: true });

test("tools stand beside the picture, not on it", async ({ opened: page }) => {
  const tools = (await page.locator("#tools").boundingBox())!;
  const stage = (await page.locator("#overlay").boundingBox())!;
  expect(tools.x + tools.width).toBeLessThanOrEqual(stage.x);
});

test("a circle is pulled out from its centre", async ({ opened: page }) => {
  await pick(page, "Draw a circle");
  await drag(page, [60, 190], [90, 190]);
  const drawn = await shapes(page);
  expect(drawn).toHaveLength(3);
  const circle = drawn[2]!;
  expect(circle.kind).toBe("circle");
  if (circle.kind !== "circle") return;
  expect(circle.x).toBeCloseTo(60, 0);
  expect(circle.y).toBeCloseTo(190, 0);
  expect(circle.r).toBeGreaterThan(28);
  expect(circle.r).toBeLessThan(32);
  await expect(page.locator("#regions > li")).toHaveCount(4);
});

test("a freehand line closes where it is let go", async ({ opened: page }) => {
  await pick(page, "Draw freehand");
  await drag(page, [40, 180], [90, 175], [95, 215], [45, 220], [40, 185]);
  const drawn = (await shapes(page))[2]!;
  expect(drawn.kind).toBe("polygon");
  if (drawn.kind === "polygon") expect(drawn.points.length).toBeGreaterThan(10);
});

test("a polygon takes a click for each corner and closes on the first", async ({
  opened: page,
}) => {
  await pick(page, "Draw a polygon");
  for (const [x, y] of [
    [40, 180],
    [90, 180],
    [90, 220],
    [40, 180],
  ] as const) {
    await click(page, x, y);
  }
  const drawn = (await shapes(page))[2]!;
  expect(drawn).toMatchObject({ kind: "polygon" });
  if (drawn.kind === "polygon") expect(drawn.points).toHaveLength(3);
});

test("a double click sets the last corner of a polygon and closes it", async ({ opened: page }) => {
  await pick(page, "Draw a polygon");
  await click(page, 40, 180);
  await click(page, 90, 180);
  const { x, y } = await onScreen(page, 90, 220);
  await page.mouse.dblclick(x, y);
  await expect(page.locator("#regions > li").nth(3)).toContainText("3 corners");
});

test("Enter closes a polygon whose corners were clicked", async ({ opened: page }) => {
  await pick(page, "Draw a polygon");
  for (const [x, y] of [
    [40, 180],
    [90, 180],
    [90, 220],
    [40, 220],
  ] as const) {
    await click(page, x, y);
  }
  await page.keyboard.press("Enter");
  await expect(page.locator("#regions > li").nth(3)).toContainText("4 corners");
});

test("a curve is moved, resized and deleted by mouse, and all of it undone", async ({
  opened: page,
}) => {
  const start = await shapes(page);
  const first = start[0]!;
  if (first.kind !== "circle") throw new Error("the first curve of blocks is a circle");
  const picture = await look(page, "#overlay");

  await drag(page, [first.x, first.y], [first.x + 30, first.y - 10]);
  let now = (await shapes(page))[0]!;
  if (now.kind !== "circle") throw new Error("a moved circle is a circle");
  expect(now.x).toBeCloseTo(first.x + 30, 0);
  expect(now.y).toBeCloseTo(first.y - 10, 0);
  expect((await look(page, "#overlay")).print).not.toBe(picture.print);

  const corner = now.r * Math.SQRT1_2;
  await drag(page, [now.x + corner, now.y + corner], [now.x + corner + 12, now.y + corner + 12]);
  const larger = (await shapes(page))[0]!;
  if (larger.kind !== "circle") throw new Error("a resized circle is a circle");
  expect(larger.r).toBeGreaterThan(now.r + 10);
  expect(larger.x).toBeCloseTo(now.x, 5);

  await page.getByRole("button", { name: "Delete the selected curve" }).click();
  expect(await shapes(page)).toHaveLength(1);

  const undo = page.getByRole("button", { name: "Undo", exact: true });
  for (let i = 0; i < 3; i++) await undo.click();
  expect(await shapes(page)).toEqual(start);
  await expect(undo).toBeDisabled();
  await page.getByRole("button", { name: "Redo", exact: true }).click();
  now = (await shapes(page))[0]!;
  if (now.kind === "circle") expect(now.x).toBeCloseTo(first.x + 30, 0);
});

test("a hand that trembles in a click chooses a curve and moves nothing", async ({
  opened: page,
}) => {
  const start = await shapes(page);
  const { x, y } = await onScreen(page, 107, 80);
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 1, y);
  await page.mouse.move(x + 2, y + 2);
  await page.mouse.up();
  expect(await read(page, (state) => state.selected)).toBe(0);
  expect(await shapes(page)).toEqual(start);
  await expect(page.getByRole("button", { name: "Undo", exact: true })).toBeDisabled();
});

test("a curve is out of one's hand once others take its place", async ({ opened: page }) => {
  const hold = async () => {
    const { x, y } = await onScreen(page, 107, 80);
    await page.mouse.move(x, y);
    await page.mouse.down();
    await page.mouse.move(x + 20, y, { steps: 2 });
    return async () => {
      await page.mouse.move(x + 40, y, { steps: 2 });
      await page.mouse.up();
    };
  };
  let letGo = await hold();
  await page.evaluate(() => document.getElementById("find")!.click());
  await expect(page.locator("#hint")).toHaveText("2 curves found.", { timeout: PATIENCE });
  const found = await shapes(page);
  await letGo();
  expect(await shapes(page)).toEqual(found);
  await expect(page.locator("#hint")).toHaveText("2 curves found.");

  letGo = await hold();
  await openScene(page, "squares");
  const own = await shapes(page);
  await letGo();
  expect(await shapes(page)).toEqual(own);
  await expect(page.getByRole("button", { name: "Undo", exact: true })).toBeDisabled();
});

test("everything can be done by keyboard", async ({ opened: page }) => {
  const start = await shapes(page);
  const stage = page.getByRole("application", { name: "Curves on the frame" });
  await stage.focus();
  await page.keyboard.press("c");
  expect(await shapes(page)).toHaveLength(3);
  await page.keyboard.press("ArrowLeft");
  await page.keyboard.press("Shift+ArrowDown");
  await page.keyboard.press("+");
  const moved = (await shapes(page))[2]!;
  if (moved.kind !== "circle") throw new Error("C adds a circle");
  const { width, height } = await read(page, ({ width, height }) => ({ width, height }));
  expect(moved.y).toBeCloseTo((height - 1) / 2 + 10, 5);
  expect(moved.r).toBeGreaterThan(Math.min(width, height) / 7);
  await expect(page.locator("#announcer")).toContainText("Curve 3");
  await page.keyboard.press("n");
  expect(await read(page, (state) => state.selected)).toBe(0);
  await page.keyboard.press("Delete");
  expect(await shapes(page)).toHaveLength(2);
  for (let i = 0; i < 5; i++) await page.keyboard.press("Control+z");
  expect(await shapes(page)).toEqual(start);
  await page.keyboard.press("Control+Shift+z");
  expect(await shapes(page)).toHaveLength(3);
});

test("a polygon and a circle are drawn by keyboard with the crosshair", async ({
  opened: page,
}) => {
  const stage = page.getByRole("application", { name: "Curves on the frame" });
  await pick(page, "Draw a polygon");
  await stage.focus();
  await page.keyboard.press("Enter");
  for (let i = 0; i < 3; i++) await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Enter");
  for (let i = 0; i < 3; i++) await page.keyboard.press("Shift+ArrowDown");
  await page.keyboard.press("Enter");
  await page.keyboard.press("Enter");
  const polygon = (await shapes(page))[2]!;
  expect(polygon.kind).toBe("polygon");
  if (polygon.kind === "polygon") expect(polygon.points).toHaveLength(3);

  await pick(page, "Draw a circle");
  await stage.focus();
  await page.keyboard.press("Enter");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Shift+ArrowRight");
  await page.keyboard.press("Enter");
  const circle = (await shapes(page))[3]!;
  if (circle.kind !== "circle") throw new Error("the circle tool draws circles");
  expect(circle.r).toBeCloseTo(20, 5);
});

test("Escape gives up a half-drawn curve", async ({ opened: page }) => {
  await pick(page, "Draw a polygon");
  await click(page, 40, 180);
  await click(page, 90, 180);
  await page.getByRole("application", { name: "Curves on the frame" }).focus();
  await page.keyboard.press("Escape");
  await page.keyboard.press("Escape");
  expect(await shapes(page)).toHaveLength(2);
  expect(await read(page, (state) => state.tool)).toBe("select");
});

test("curves can be moved while it runs, and the run takes them up", async ({ opened: page }) => {
  await runPasses(page, 2);
  const before = await read(page, (state) => JSON.stringify(state.contours));
  await (await inResult(page)).getByRole("button", { name: "Curve 1", exact: true }).click();
  for (let i = 0; i < 3; i++) await page.keyboard.press("Shift+ArrowUp");
  await page.waitForFunction(
    (old) =>
      JSON.stringify((window as unknown as { relievo: { contours: unknown } }).relievo.contours) !==
      old,
    before,
    { timeout: 30_000 },
  );
  await runPasses(page, 1);
  await expect(page.locator("#message")).toBeHidden();
});

test("a curve drawn while it runs joins in", async ({ opened: page }) => {
  await runLong(page);
  await (await inResult(page)).getByRole("button", { name: "Add a circle" }).click();
  await until(page, (state) => state.report!.regions.length === 4);
  await page.getByRole("button", { name: "Undo", exact: true }).click();
  await until(page, (state) => state.report!.regions.length === 3);
  expect(await read(page, (state) => state.running)).toBe(true);
  await (await inTransport(page)).getByLabel("Pace").selectOption("as fast as possible");
  await until(page, (state) => !state.running);
  await expect(page.locator("#status")).toContainText("Converged");
  await expect(page.locator("#message")).toBeHidden();
});

test("a curve off the frame is refused with a sentence, and stays to be moved back", async ({
  opened: page,
}) => {
  await (await inResult(page)).getByRole("button", { name: "Curve 1", exact: true }).click();
  for (let i = 0; i < 30; i++) await page.keyboard.press("Shift+ArrowLeft");
  await expect(page.locator("#message")).toContainText("curve 1 lies outside", {
    ignoreCase: true,
    timeout: 30_000,
  });
  expect(await shapes(page)).toHaveLength(2);
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, (state) => !state.running);
  await expect(page.locator("#message")).toContainText("outside");
  for (let i = 0; i < 30; i++) await page.keyboard.press("Control+z");
  await runPasses(page, 1);
});

test("no more curves than regions", async ({ opened: page }) => {
  const most = await read(page, (state) => state.catalogues!.limits.maxCurves);
  const add = (await inResult(page)).getByRole("button", { name: "Add a circle" });
  for (let i = 2; i < most + 1; i++) await add.click();
  expect(await shapes(page)).toHaveLength(most);
  await expect(page.locator("#message")).toContainText(`${most} curves are drawn`);
});

test.describe("by touch", () => {
  test.use({ hasTouch: true, viewport: { width: 390, height: 844 } });

  /** Strokes of a finger, through pixels of the frame. */
  async function fingerOf(page: Page): Promise<(...way: [number, number][]) => Promise<void>> {
    const finger = await page.context().newCDPSession(page);
    return async (...way) => {
      const points = await Promise.all(way.map((place) => onScreen(page, ...place)));
      await finger.send("Input.dispatchTouchEvent", {
        type: "touchStart",
        touchPoints: [points[0]!],
      });
      for (const point of points.slice(1)) {
        await finger.send("Input.dispatchTouchEvent", { type: "touchMove", touchPoints: [point] });
      }
      await finger.send("Input.dispatchTouchEvent", { type: "touchEnd", touchPoints: [] });
    };
  }

  test("a finger moves the curve that it has chosen, and no other", async ({ opened: page }) => {
    const stroke = await fingerOf(page);
    await page.locator("#overlay").scrollIntoViewIfNeeded();
    const middle = async () => {
      const circle = (await shapes(page))[0]!;
      return circle.kind === "circle" ? [Math.round(circle.x), Math.round(circle.y)] : [];
    };
    expect(await middle()).toEqual([107, 80]);
    await stroke([107, 80], [127, 80], [147, 80], [167, 80]);
    await expect.poll(() => read(page, (state) => state.selected)).toBe(0);
    await stroke([107, 80], [107, 100], [107, 120], [107, 140]);
    await expect.poll(middle).toEqual([107, 140]);
  });

  test("a finger draws and moves a curve", async ({ opened: page }) => {
    const stroke = await fingerOf(page);
    await ready(page);
    await page.locator("#overlay").scrollIntoViewIfNeeded();
    await pick(page, "Draw a circle");
    await stroke([60, 190], [70, 190], [80, 190], [90, 190]);
    await expect.poll(async () => (await shapes(page)).length).toBe(3);
    const scrolled = await page.evaluate(() => scrollY);
    await stroke([60, 190], [70, 180], [90, 160], [110, 150]);
    await expect
      .poll(async () => {
        const circle = (await shapes(page))[2]!;
        return circle.kind === "circle" ? Math.round(circle.x) : 0;
      })
      .toBe(110);
    expect(await page.evaluate(() => scrollY)).toBe(scrolled);
  });
});

test("curves are found, announced, and taken back in one step", async ({ opened: page }) => {
  const before = await shapes(page);
  await page.getByRole("button", { name: "Find curves" }).click();
  await expect(page.locator("#hint")).toHaveText("2 curves found.");
  const found = await shapes(page);
  expect(found.map((shape) => shape.kind)).toEqual(["polygon", "polygon"]);
  await expect(page.locator("#regions > li")).toHaveCount(3);
  await page.getByRole("button", { name: "Undo" }).click();
  expect(await shapes(page)).toEqual(before);
  await expect(page.locator("#hint")).not.toHaveText("2 curves found.");
});
