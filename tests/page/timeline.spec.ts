/** Back and forth through a solve, and on from any pass: judged by what is seen. */

import AxeBuilder from "@axe-core/playwright";

import {
  PATIENCE,
  chooseView,
  drawn,
  expect,
  inSettings,
  inTransport,
  look,
  open,
  openScene,
  pauseRun,
  read,
  ready,
  solve,
  test,
  until,
} from "./helpers";
import type { Page } from "@playwright/test";

import type { State } from "../../www/store";
import { heightsOf } from "../../www/timeline/heights";
import type { Line } from "../../www/timeline/line";

const slider = (page: Page) => page.getByRole("slider", { name: "Pass", exact: true });
const told = (page: Page) => page.locator("#pass-sentence");

/** Scrubs to a pass, and waits for its picture: another object than the one before. */
async function scrub(page: Page, at: number): Promise<void> {
  await page.evaluate(() => {
    const { pictures } = (window as unknown as { relievo: State }).relievo;
    Object.assign(window, { before: pictures });
  });
  await slider(page).fill(String(at));
  const there = `(({ visit, pictures }) =>
    (visit === null || visit.at === ${at}) && pictures !== window.before)(window.relievo)`;
  await expect.poll(() => page.evaluate(there), { timeout: PATIENCE, message: there }).toBe(true);
  await drawn(page);
}

/** The picture on the stage, whatever the stage's size. */
async function picture(page: Page): Promise<number> {
  return page.evaluate(() => {
    const [bitmap] = (window as unknown as { relievo: State }).relievo.pictures;
    const canvas = new OffscreenCanvas(bitmap!.width, bitmap!.height);
    const context = canvas.getContext("2d")!;
    context.drawImage(bitmap!, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    return data.reduce((print, byte) => (Math.imul(print, 31) + byte) | 0, 0);
  });
}

const energies = (page: Page) =>
  read(page, ({ timeline }) => timeline!.lines.map((line) => line.energies));

test("an earlier pass looks as it did when it was live, in every view", async ({
  opened: page,
}) => {
  await chooseView(page, "Depth");
  await expect(page.locator("#timeline")).toBeHidden();
  const live: number[] = [];
  const step = page.getByRole("button", { name: "Step", exact: true });
  for (let pass = 1; pass <= 8; pass++) {
    await step.click();
    await until(page, new Function("s", `return s.report?.iterations === ${pass}`) as never);
    await expect(told(page)).toContainText(`Pass ${pass},`);
    live.push((await look(page)).print);
  }
  expect(live[6]).not.toBe(live[7]);
  for (const pass of [7, 3, 6]) {
    await scrub(page, pass);
    expect((await look(page)).print, `pass ${pass}`).toBe(live[pass - 1]);
    await expect(told(page)).toContainText(`Pass ${pass}, scale 1 of 2`);
    const report = await read(page, (state) => state.report!);
    expect(report.iterations).toBe(pass);
    expect(report.history).toHaveLength(pass);
    expect(report.history.at(-1)).toBe((await energies(page))[0]![pass - 1]);
  }
  // The others are of that pass, too: it is another than the last.
  const seen: number[] = [];
  for (const name of ["Labels", "Motion"]) {
    await chooseView(page, name);
    seen.push((await look(page)).print);
  }
  await scrub(page, 8);
  expect(await read(page, (state) => state.visit)).toBeNull();
  for (const [i, name] of ["Labels", "Motion"].entries()) {
    await chooseView(page, name);
    expect((await look(page)).print, name).not.toBe(seen[i]);
  }
  await chooseView(page, "Depth");
  expect((await look(page)).print).toBe(live[7]);
  // The start: curves as drawn.
  await chooseView(page, "Outlines");
  await scrub(page, 0);
  await expect(told(page)).toContainText("curves as drawn");
  expect(await read(page, (state) => state.started)).toBe(false);
});

test("arrow keys step, the passes play, and a run is followed unless someone went back", async ({
  opened: page,
}) => {
  await (await inTransport(page)).getByLabel("Pace").selectOption("slow enough to watch");
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await until(page, ({ report }) => (report?.iterations ?? 0) >= 4);
  // At the end it follows.
  await expect.poll(async () => Number(await slider(page).inputValue())).toBeGreaterThanOrEqual(4);
  await slider(page).focus();
  await page.keyboard.press("Home");
  await page.keyboard.press("ArrowRight");
  await page.keyboard.press("ArrowRight");
  await until(page, ({ visit }) => visit?.at === 2);
  await until(page, ({ working }) => (working?.iterations ?? 0) >= 7);
  await expect(slider(page)).toHaveValue("2");
  await expect(told(page)).toContainText("Pass 2,");
  await expect(page.locator("#status")).toContainText(/[7-9]|1\d/);
  await until(
    page,
    ({ running, working, timeline }) =>
      !running && timeline!.lines[0]!.energies.length === working?.iterations,
  );
  const last = await read(page, ({ timeline }) => timeline!.lines[0]!.energies.length);
  await page.getByLabel("Time for each pass").selectOption("0.5 s per pass");
  await page.getByRole("button", { name: "Play the passes" }).click();
  await until(page, ({ visit }) => (visit?.at ?? 0) >= 4);
  await page.keyboard.press("End");
  await slider(page).press("End");
  await until(page, ({ visit }) => visit === null);
  await expect(slider(page)).toHaveValue(String(last));
  await page.getByRole("button", { name: "Previous pass" }).click();
  await expect(slider(page)).toHaveValue(String(last - 1));
});

test("a second line goes on with other settings, and both are compared", async ({
  opened: page,
}) => {
  await solve(page);
  const [first] = await energies(page);
  const end = first!.length;
  // What the last pass says is what it did.
  const last = await read(page, ({ report }) => report!.last!);
  if (last.stage === "steps") {
    await expect(told(page)).toContainText(last.adopted > 0 ? "adopted in" : "Nothing changed");
  }
  await chooseView(page, "Labels");
  const before = await picture(page);
  await scrub(page, 7);
  await (await inSettings(page)).locator("#option-lambda-auto").uncheck();
  await page.locator("#option-lambda").fill("40000");
  await page.locator("#option-lambda").press("Enter");
  await page.getByRole("button", { name: "Go on from here" }).click();
  await until(
    page,
    ({ running, timeline }) => !running && (timeline?.lines[1]?.energies.length ?? 0) > 8,
  );
  const [one, other] = await energies(page);
  expect(one).toEqual(first);
  expect(other!.slice(0, 7)).toEqual(first!.slice(0, 7));
  expect(other![7]).not.toBe(first![7]);
  await expect(page.locator("#apart")).toContainText(/Labels differ in [0-9.]+\s%/, {
    timeout: PATIENCE,
  });
  await expect(page.locator("#apart")).not.toContainText("differ in 0.00");
  await chooseView(page, "Labels");
  const after = await picture(page);
  expect(after).not.toBe(before);
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
  // Back to the first line, at its end.
  await page.getByRole("radio", { name: "First" }).check({ force: true });
  await until(page, ({ visit }) => visit?.line === 0);
  await scrub(page, end - 1);
  await scrub(page, end);
  await expect.poll(() => picture(page), { timeout: PATIENCE }).toBe(before);
  // In turn.
  await page.getByRole("button", { name: "Flicker" }).click();
  for (const print of [after, before, after]) {
    await expect.poll(() => picture(page), { timeout: PATIENCE }).toBe(print);
  }
  await page.getByRole("button", { name: "Flicker" }).click();
  // The reliefs of both under one light.
  await page.getByRole("button", { name: "Side by side" }).click();
  const canvases = page.locator("#relief canvas");
  await expect(canvases).toHaveCount(2);
  const relief = (i: number) => look(page, `.relief-pane:nth-of-type(${i}) canvas`);
  const often = { timeout: PATIENCE };
  for (const i of [1, 2]) {
    await expect.poll(async () => (await relief(i)).colours, often).toBeGreaterThan(20);
  }
  await expect(page.locator(".relief-name").first()).toContainText("First:");
  const [dark, second] = [await relief(1), await relief(2)];
  await page.getByRole("button", { name: /^Light from/ }).press("ArrowRight");
  await expect.poll(async () => (await relief(1)).print, often).not.toBe(dark.print);
  await expect.poll(async () => (await relief(2)).print, often).not.toBe(second.print);
  // One is turned, and the other with it.
  const lit = await relief(2);
  await canvases.first().press("ArrowLeft");
  await expect.poll(async () => (await relief(2)).print, often).not.toBe(lit.print);
});

test("where the settings allow no more, the curves alone go along, and that is said", async ({
  opened: page,
}) => {
  await solve(page);
  await scrub(page, 5);
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await until(page, ({ visit }) => visit?.at === 5);
  await page.getByRole("button", { name: "Go on from here" }).click();
  await until(page, ({ timeline }) => (timeline?.lines[1]?.energies.length ?? 0) >= 6);
  await pauseRun(page);
  await scrub(page, 6);
  await expect(told(page)).toContainText("curves of pass 5 only");
  await expect(told(page)).toContainText("(17) for curves");
  expect(await read(page, ({ shapes }) => shapes.map(({ kind }) => kind))).toEqual([
    "polygon",
    "polygon",
  ]);
});

test("all passes are there after a reload, and can be gone on from", async ({ opened: page }) => {
  await openScene(page, "squares");
  await ready(page);
  await solve(page);
  await chooseView(page, "Labels");
  await scrub(page, 4);
  const seen = await picture(page);
  const kept = await energies(page);
  await expect
    .poll(() => read(page, ({ memory }) => memory?.[0]?.timelineBytes ?? 0), {
      timeout: PATIENCE,
    })
    .toBeGreaterThan(1000);
  await page.reload();
  await ready(page);
  await until(page, ({ timeline, started }) => timeline !== null && started);
  expect(await energies(page)).toEqual(kept);
  await expect(slider(page)).toHaveValue(String(kept[0]!.length));
  await scrub(page, 4);
  await expect.poll(() => picture(page), { timeout: PATIENCE }).toBe(seen);
  await page.getByRole("button", { name: "Go on from here" }).click();
  await until(
    page,
    ({ running, report, timeline }) =>
      !running && report?.status !== "running" && (timeline?.lines[1]?.energies.length ?? 0) > 4,
  );
  // With the same settings it is the same way.
  const [one, other] = await energies(page);
  expect(other).toEqual(one);
});

test("the energy is one line, which falls where two energies compare", () => {
  const line = (from: number, energies: number[], breaks: number[]): Line => {
    return { solve: "one", from, whole: true, energies, breaks, passes: [] };
  };
  const first = line(0, [80, 40, 900, 450, 450, 500], [2]);
  // Another way from the third pass on, the same sum in the end.
  const second = line(3, [80, 40, 900, 7, 6, 500], [2, 3]);
  const timeline = { first: 0, lines: [first, second] };
  const half = Math.log(0.5);
  const heights = heightsOf(timeline, first).map(({ height }) => height / half);
  expect(heights.map((one) => Number(one.toFixed(3)))).toEqual([0, 1, 1, 2, 2, 1.848]);
  expect(heightsOf(timeline, first).map(({ compares }) => compares)).toEqual([
    ...[false, true, false],
    ...[true, true, true],
  ]);
  const other = heightsOf(timeline, second).map(({ height }) => height / half);
  expect(other.slice(0, 3)).toEqual(heights.slice(0, 3));
  expect(other[3]).toBe(heights[2]);
  expect(other[4]).toBeGreaterThan(other[3]!);
  expect(other[5]).toBe(heights[5]);
});

test("on a phone what a pass did takes two lines, and all of it comes with a press", async ({
  page,
}) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await open(page);
  await solve(page);
  const lines = () =>
    told(page).evaluate((one) => {
      const { lineHeight } = getComputedStyle(one);
      return Math.round(one.getBoundingClientRect().height / parseFloat(lineHeight));
    });
  const [made] = await energies(page);
  for (let pass = 0; pass <= made!.length; pass++) {
    await slider(page).fill(String(pass));
    await expect(told(page)).toContainText(pass === 0 ? "Start" : `Pass ${pass}`);
    expect(await lines(), `pass ${pass}`).toBeLessThanOrEqual(2);
  }
  const said = told(page).getByText(/From \(7\)/);
  await expect(said).toBeHidden();
  await page.getByRole("button", { name: "All on this pass" }).click();
  await expect(said).toBeVisible();
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
  await page.getByRole("button", { name: "All on this pass" }).click();
  await expect(said).toBeHidden();
});

test("on a phone a finger goes through the solve", async ({ page }) => {
  await page.setViewportSize({ width: 390, height: 844 });
  await open(page);
  await solve(page);
  const track = slider(page);
  await track.scrollIntoViewIfNeeded();
  const box = (await track.boundingBox())!;
  expect(box.height).toBeGreaterThanOrEqual(44);
  expect(box.width).toBeGreaterThan(300);
  await page.mouse.move(box.x + box.width - 20, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2, { steps: 5 });
  await page.mouse.up();
  await until(page, ({ visit }) => visit !== null && visit.at > 2 && visit.at < 10);
  await expect(told(page)).toContainText(/Pass \d/);
  const wide = await page.evaluate(() => document.documentElement.scrollWidth);
  expect(wide).toBeLessThanOrEqual(390);
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
});
