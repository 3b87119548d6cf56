/** While it runs: what is being done, how far it is, how long it will take. */

import AxeBuilder from "@axe-core/playwright";

import { estimate } from "../../www/progress";
import type { Report } from "../../www/worker/protocol";
import type { State } from "../../www/store";
import { moments, still } from "./films";
import {
  expect,
  look,
  open,
  passes,
  PATIENCE,
  png,
  read,
  runLong,
  test,
  until,
  inTransport,
  pressView,
} from "./helpers";

test("a run says what it does, shows a bar that grows, and the time left", async ({
  opened: page,
}) => {
  const bar = page.getByRole("progressbar");
  await expect(bar).toBeHidden();
  await (await inTransport(page)).getByLabel("Pace").selectOption("slow enough to watch");
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await until(page, ({ report }) => (report?.iterations ?? 0) >= 2);
  await expect(bar).toBeVisible();
  await expect(page.locator("#doing")).toContainText(/Estimating outlines.*scale \d of 2/);
  await expect(page.locator("#doing")).toContainText(/About .*left/);
  const values: number[] = [];
  // Its value and whether it is there, at once: when the run ends it is set back.
  const value = () =>
    page
      .locator("#progress")
      .evaluate((bar: HTMLProgressElement) => (bar.hidden ? null : bar.value));
  for (let now = await value(); now !== null; now = await value()) {
    values.push(now);
    await page.waitForTimeout(150);
  }
  expect(values.length).toBeGreaterThan(2);
  expect(values).toEqual(values.toSorted((a, b) => a - b));
  await expect(page.locator("#doing")).toHaveText("");
});

test("as printed, too", async ({ opened: page }) => {
  await runLong(page);
  await expect(page.locator("#doing")).toContainText("in every pass");
  await expect(page.getByRole("progressbar")).toBeVisible();
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.map(({ id }) => id)).toEqual([]);
});

/** A report as far as an estimate reads it. */
const report = (level: number, levels: number, regions: number, iterations: number) =>
  ({ level, levels, regions: Array.from({ length: regions }), iterations }) as unknown as Report;

test("time left follows the passes that were made", () => {
  const passes = (count: number, level: number, time: number) =>
    Array.from({ length: count }, () => ({ level, time }));
  expect(estimate(report(1, 2, 3, 0), [], 0)).toEqual({ done: 0, left: null });
  const slow = estimate(report(1, 2, 3, 2), passes(2, 1, 1000), 0);
  const fast = estimate(report(1, 2, 3, 2), passes(2, 1, 10), 0);
  expect(slow.left! / fast.left!).toBeCloseTo(100);
  expect(slow.done).toBeCloseTo(fast.done);
  // A finer scale has four times the pixels.
  expect(slow.left).toBeGreaterThan(5 * 4);
  const late = estimate(report(0, 2, 3, 11), [...passes(7, 1, 1000), ...passes(4, 0, 4000)], 0);
  expect(late.left).toBeCloseTo(4);
  expect(late.done).toBeGreaterThan(0.8);
  // More passes than usual: the next may always be the last.
  const long = estimate(report(0, 2, 3, 40), [...passes(7, 1, 1000), ...passes(33, 0, 4000)], 0);
  expect(long.left).toBeCloseTo(4);
  // Nothing is faster than the pace.
  expect(estimate(report(1, 2, 1, 1), passes(1, 1, 400), 400).left).toBeGreaterThan(2);
});

test("a view chosen in the middle of a long pass shows what the last one came to", async ({
  page,
}) => {
  // Each pass from the second on takes as long as nobody would wait.
  await page.route(/\/worker-[^/]*\.js$/, async (route) => {
    const response = await route.fetch();
    await route.fulfill({ response, body: `${SLOW}\n${await response.text()}` });
  });
  await open(page);
  await (await inTransport(page)).getByLabel("Pace").selectOption("as fast as possible");
  await page.getByRole("button", { name: "Run", exact: true }).click();
  await until(page, ({ report }) => (report?.iterations ?? 0) >= 2);
  for (const [name, id] of [
    ["Labels", "labels"],
    ["Confidence", "confidence"],
  ] as const) {
    const made = await passes(page);
    await pressView(page, name);
    await page.waitForFunction(
      (id) => (window as unknown as { relievo: State }).relievo.pictured.startsWith(id),
      id,
      { timeout: PATIENCE },
    );
    expect(await passes(page), "no pass has ended meanwhile").toBe(made);
    expect((await look(page)).colours).toBeGreaterThan(1);
  }
  expect(await read(page, ({ running, message }) => [running, message])).toEqual([true, null]);
});

test("of large frames a second worker is ready to draw before a run begins", async ({
  opened: page,
}) => {
  expect(page.workers().length).toBe(1);
  const files = await Promise.all(moments(2, 8, 640, 480).map((view) => still(page, view)));
  await page.locator("#film-file").setInputFiles(files.map((data, i) => png(`l${i}.png`, data)));
  await until(page, ({ source, busy }) => source?.kind === "files" && busy === null);
  await expect.poll(() => page.workers().length).toBe(2);
});

/** Put before the worker's script: steps are held up at the border to the core. */
const SLOW = `
{
  const wrap = (result) => {
    const real = result.instance.exports;
    let steps = 0;
    const exports = { ...real, solver_step: (...given) => {
      const end = performance.now() + ([400, 400][steps++] ?? 60000);
      while (performance.now() < end);
      return real.solver_step(...given);
    } };
    return { module: result.module, instance: { exports } };
  };
  for (const name of ["instantiate", "instantiateStreaming"]) {
    const real = WebAssembly[name];
    WebAssembly[name] = async (...given) => wrap(await real.apply(WebAssembly, given));
  }
}`;
