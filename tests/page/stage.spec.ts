/** The stage: zoom, the readout, legends, two views at once. */

import type { Page } from "@playwright/test";

import { chooseView, drawn, expect, look, onScreen, read, solve, test } from "./helpers";

/** Colours of the picture along a row, from a place of the screen on, one for each CSS pixel. */
async function row(page: Page, x: number, y: number, count: number): Promise<number[]> {
  await drawn(page);
  return page.locator("#picture").evaluate(
    (element, [x, y, count]) => {
      const canvas = element as HTMLCanvasElement;
      const box = canvas.getBoundingClientRect();
      const dense = canvas.width / box.width;
      // A copy: a canvas that is read often is drawn another way.
      const copy = document.createElement("canvas");
      [copy.width, copy.height] = [canvas.width, canvas.height];
      const context = copy.getContext("2d", { willReadFrequently: true })!;
      context.drawImage(canvas, 0, 0);
      return Array.from({ length: count! }, (_, i) => {
        const [r, g, b] = context.getImageData(
          Math.round((x! + i - box.left) * dense),
          Math.round((y! - box.top) * dense),
          1,
          1,
        ).data;
        return (r! << 16) | (g! << 8) | b!;
      });
    },
    [x, y, count],
  );
}

async function wheel(page: Page, x: number, y: number, notches: number): Promise<void> {
  await page.mouse.move(x, y);
  for (let i = 0; i < Math.abs(notches); i++) await page.mouse.wheel(0, -100 * Math.sign(notches));
  await drawn(page);
}

test("under a zoom the pixel under the pointer stays, is a square, and is drawn on", async ({
  opened: page,
}) => {
  const whole = await look(page);
  const { x, y } = await onScreen(page, 210, 150);
  await wheel(page, x, y, 9);
  // Nine notches of 1.3 make a pixel more than 20 CSS pixels wide.
  const colours = await row(page, x - 40, y, 80);
  const changes = colours.filter((colour, i) => i > 0 && colour !== colours[i - 1]).length;
  expect(changes).toBeLessThan(8);
  expect(changes).toBeGreaterThan(0);

  await page.getByRole("radio", { name: "Draw a circle" }).check({ force: true });
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x + 60, y, { steps: 4 });
  await page.mouse.up();
  const circle = (await read(page, (state) => state.shapes)).at(-1)!;
  expect(circle).toMatchObject({ kind: "circle" });
  if (circle.kind !== "circle") return;
  expect(circle.x).toBeCloseTo(210, 0);
  expect(circle.y).toBeCloseTo(150, 0);
  expect(circle.r).toBeLessThan(5);

  await page.getByRole("button", { name: /whole frame/ }).click();
  expect((await look(page)).print).toBe(whole.print);
});

test("the keyboard zooms, and a double click goes there and back", async ({ opened: page }) => {
  const whole = await look(page);
  await chooseView(page, "Depth");
  await chooseView(page, "Curves");
  await page.locator("#overlay").focus();
  await page.keyboard.press("+");
  expect((await look(page)).print).not.toBe(whole.print);
  await page.keyboard.press("0");
  expect((await look(page)).print).toBe(whole.print);
  const { x, y } = await onScreen(page, 300, 20);
  await page.mouse.dblclick(x, y);
  expect((await look(page)).print).not.toBe(whole.print);
  await page.mouse.dblclick(x, y);
  expect((await look(page)).print).toBe(whole.print);
});

test("pointer and crosshair tell what is found at a pixel", async ({ opened: page }) => {
  await solve(page);
  const readout = page.locator("#readout");
  await chooseView(page, "Depth");
  const inside = await onScreen(page, 107, 80);
  await page.mouse.move(inside.x, inside.y);
  await expect(readout).toContainText("x 107, y 80");
  await expect(readout).toContainText("regioncurve 1");
  for (const what of [
    /depth\d\.\d+ × mean/,
    /motion\d+\.\d\d px/,
    /ψ−?\d+\.\d/,
    /confidence[\d.]+/,
  ]) {
    await expect(readout).toContainText(what);
  }
  const outside = await onScreen(page, 8, 8);
  await page.mouse.move(outside.x, outside.y);
  await expect(readout).toContainText("regionbackground");
  await page.mouse.move(2, 2);
  await expect(readout).toBeHidden();

  await page.locator("#overlay").focus();
  await page.keyboard.press("ArrowRight");
  const [x] = (await readout.locator("p").textContent())!.match(/\d+/g)!;
  await page.keyboard.press("Shift+ArrowRight");
  await expect(readout).toContainText(`x ${Number(x) + 10},`);
  await expect(page.locator("#announcer")).toContainText("confidence");
});

test("every map has a legend with its unit", async ({ opened: page }) => {
  await solve(page);
  const legend = page.locator("#legend");
  await expect(legend).toBeEmpty();
  await chooseView(page, "Depth");
  await expect(legend).toContainText("× mean");
  const told = async () => (await legend.locator("li").allTextContents()).map(Number);
  const marks = await told();
  expect(marks).toHaveLength(5);
  expect(marks).toEqual(marks.toSorted((a, b) => b - a));
  // Held, the range stays whatever becomes of the depth.
  const hold = page.getByRole("button", { name: "Hold the range" });
  await hold.click();
  const before = await look(page);
  await page.locator("#scale-1").fill("1");
  await expect.poll(async () => (await look(page)).print).not.toBe(before.print);
  expect(await told()).toEqual(marks);
  await hold.click();
  await expect.poll(told).not.toEqual(marks);
  await chooseView(page, "Motion");
  await expect(legend).toContainText(/px\/frame.*\d/);
  await chooseView(page, "Confidence");
  await expect(legend).toContainText("Confidence");
  const ember = await look(page);
  await page.locator("#setting-palette").selectOption("Turbo");
  await expect.poll(async () => (await look(page)).print).not.toBe(ember.print);
  await chooseView(page, "Residual");
  await expect(legend).toContainText("grey levels");
  await chooseView(page, "Error");
  await expect(legend).toContainText(/Motion error.*px/);
  await page.locator("#setting-error").selectOption("Depth");
  await expect(legend).toContainText(/Depth error.*%/);
  await chooseView(page, "Labels");
  await expect(legend.locator("li")).toHaveText(["Backgr.", "Curve 1", "Curve 2"]);
});

test("a divider shows two views at once, the same pixels on both sides", async ({
  opened: page,
}) => {
  await solve(page);
  const { x, y } = await onScreen(page, 240, 60);
  const at = () => row(page, x, y, 6);
  // Where a picture is cut off, a level more or less is rounding.
  const shows = (those: number[]) => async () =>
    (await at()).every((colour, i) =>
      [16, 8, 0].every(
        (bits) => Math.abs(((colour >> bits) & 255) - ((those[i]! >> bits) & 255)) < 4,
      ),
    );
  const frame = await at();
  await chooseView(page, "Labels");
  const labels = await at();
  await chooseView(page, "Curves");
  await page.getByRole("button", { name: "Two views" }).click();
  await page.getByLabel("Right of the divider").selectOption("Found: labels");
  await expect.poll(shows(labels)).toBe(true);
  // The pointer takes the bar, and the pixel changes sides.
  const bar = page.getByRole("slider", { name: /Divider/ });
  const box = (await bar.boundingBox())!;
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width - 30, box.y + box.height / 2, { steps: 6 });
  await page.mouse.up();
  await expect.poll(shows(frame)).toBe(true);
  // The keyboard as well.
  await bar.focus();
  await page.keyboard.press("Home");
  await expect.poll(shows(labels)).toBe(true);
  await page.getByLabel("Right of the divider").selectOption("Truth: motion");
  await expect.poll(shows(labels)).toBe(false);
  await expect(page.locator("#message")).toBeHidden();
  await page.getByRole("button", { name: "Two views" }).click();
  await expect.poll(shows(frame)).toBe(true);
});

test.describe("by touch", () => {
  test.use({ hasTouch: true, viewport: { width: 390, height: 844 } });

  test("two fingers zoom and draw nothing, and a panel leaves Run and the picture in sight", async ({
    opened: page,
  }) => {
    const whole = await look(page);
    const drawnBefore = await read(page, (state) => state.shapes.length);
    await page.getByRole("radio", { name: "Draw a circle" }).check({ force: true });
    const fingers = await page.context().newCDPSession(page);
    const { x, y } = await onScreen(page, 160, 120);
    const touch = (type: "touchStart" | "touchMove" | "touchEnd", ...apart: number[]) =>
      fingers.send("Input.dispatchTouchEvent", {
        type,
        touchPoints: apart.map((dx, id) => ({ x: x + dx, y, id })),
      });
    await touch("touchStart", -20);
    await touch("touchStart", -20, 20);
    for (const far of [30, 50, 70, 90]) await touch("touchMove", -far, far);
    await touch("touchEnd");
    expect((await look(page)).print).not.toBe(whole.print);
    await expect(page.locator("#zoom-level")).toHaveText(/[3-9]\d\d/);
    expect(await read(page, (state) => state.shapes.length)).toBe(drawnBefore);

    const tab = page.getByRole("tab", { name: "Settings" });
    await tab.click();
    await expect(page.getByLabel("Preset")).toBeInViewport({ ratio: 1 });
    await expect(page.getByRole("button", { name: "Run" })).toBeInViewport({ ratio: 1 });
    await expect(page.locator("#stage")).toBeInViewport({ ratio: 1 });
    await tab.click();
    await expect(page.getByLabel("Preset")).toBeHidden();
  });
});

test("the panel's tabs go by arrow keys", async ({ opened: page }) => {
  await page.getByRole("tab", { name: "Result" }).focus();
  await page.keyboard.press("ArrowRight");
  await expect(page.getByRole("tab", { name: "Settings" })).toBeFocused();
  await expect(page.getByRole("tabpanel", { name: "Settings" })).toBeVisible();
  await page.keyboard.press("End");
  await expect(page.getByRole("tabpanel", { name: "Learn" })).toContainText("About the method");
  await expect(page.getByRole("tabpanel", { name: "Settings" })).toBeHidden();
});
