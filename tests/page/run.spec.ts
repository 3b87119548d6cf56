/** Running: energy falls, curves crawl, and every button does what it says. */

import type { Page } from "@playwright/test";

import {
  expect,
  goesOn,
  look,
  openScene,
  passes,
  PATIENCE,
  pauseRun,
  read,
  runLong,
  runPasses,
  solve,
  test,
  until,
  inExport,
  inResult,
  inSettings,
  inTransport,
} from "./helpers";

const message = (page: Page) => page.locator("#message");

test("a run makes the energy fall and the curves move on the frame", async ({ opened: page }) => {
  const before = await look(page);
  await solve(page);
  const history = await read(page, (state) => state.report!.history);
  // Only after the last break are energies of one kind.
  const last = await read(page, ({ report }) => {
    const made = report!.breaks.filter((after) => after < report!.history.length);
    return report!.history.slice(made.at(-1) ?? 0);
  });
  expect(history.length).toBeGreaterThan(3);
  expect(last.at(-1)!).toBeLessThanOrEqual(last[0]!);
  expect(await read(page, (state) => state.contours.length)).toBeGreaterThan(1);
  expect((await look(page)).print).not.toBe(before.print);
  await expect((await inResult(page)).locator("#energy-panel")).toBeVisible();
  await expect(page.locator("#energy-text")).toContainText(/\d/);
  expect((await look(page, "#energy-plot canvas")).colours).toBeGreaterThan(1);
});

test("pictures change while it runs", async ({ opened: page }) => {
  await page.getByRole("button", { name: "Run" }).click();
  const prints = new Set<number>();
  await expect
    .poll(async () => prints.add((await look(page)).print).size, { timeout: 60_000 })
    .toBeGreaterThan(3);
});

test("pausing holds, running goes on from there", async ({ opened: page }) => {
  await runPasses(page, 2);
  const held = await passes(page);
  const energy = await read(page, (state) => state.report!.energy.total);
  await expect(page.locator("#status")).toContainText(/Paused|Converged/);
  await page.getByRole("button", { name: "Step" }).click();
  await expect.poll(() => passes(page), { timeout: 60_000 }).toBe(held + 1);
  expect(await read(page, (state) => state.report!.energy.total)).not.toBe(energy);
});

test("each part of a pass can be taken by itself", async ({ opened: page }) => {
  const motion = () => read(page, (state) => JSON.stringify(state.report?.regions));
  await (await inTransport(page)).getByRole("button", { name: "Motion", exact: true }).click();
  await expect.poll(motion, { timeout: 30_000 }).toMatch(/[1-9]/);
  await until(page, (state) => (state.report?.seconds.motion ?? 0) > 0);
  // The first passes have no depth.
  await (await inTransport(page)).getByRole("button", { name: "Depth", exact: true }).click();
  await expect(message(page)).toContainText("no depth yet");
  const { depth, curves } = await read(page, (state) => state.report!.seconds);
  expect([depth, curves]).toEqual([0, 0]);
  await (await inTransport(page)).getByRole("button", { name: "Curves", exact: true }).click();
  await until(page, (state) => state.report!.seconds.curves > 0);
  // The curves end a pass.
  await expect.poll(() => passes(page), { timeout: PATIENCE }).toBe(1);
});

test("depth can be taken by itself", async ({ opened: page }) => {
  // By steps: a run may be over before it is paused.
  const count = 8;
  for (let done = 1; done <= count; done += 1) {
    await page.getByRole("button", { name: "Step" }).click();
    await expect.poll(() => passes(page), { timeout: PATIENCE }).toBe(done);
  }
  const spent = await read(page, (state) => state.report!.seconds);
  await page.evaluate(() =>
    Object.assign(window, { then: (window as unknown as Seen).relievo.report }),
  );
  await (await inTransport(page)).getByRole("button", { name: "Depth", exact: true }).click();
  await page.waitForFunction(
    () => (window as unknown as Seen).relievo.report !== (window as unknown as Seen).then,
    undefined,
    { timeout: PATIENCE },
  );
  const { motion, curves } = await read(page, (state) => state.report!.seconds);
  expect([motion, curves]).toEqual([spent.motion, spent.curves]);
  expect(await passes(page)).toBe(count);
});

interface Passes {
  relievo: { report: { iterations: number } };
}

interface Seen {
  relievo: { report: unknown };
  then: unknown;
}

test("where energies do not compare the line is broken, and that is said", async ({
  opened: page,
}) => {
  await solve(page);
  const report = (await read(page, (state) => state.report))!;
  const made = report.breaks.filter((after) => after < report.history.length);
  expect(made.length).toBeGreaterThan(0);
  await expect(
    page.getByRole("img", { name: "Energy after each pass" }),
  ).toHaveAccessibleDescription(
    /^Since the last dashed line: .*compared only between two dashed lines/,
  );
  // Nothing is drawn in the column of a break but its dashed line, which is grey.
  const columns = await page.evaluate(
    ({ passes, after }) => {
      const canvas = document.querySelector<HTMLCanvasElement>("#energy-plot canvas")!;
      const box = document.querySelector<HTMLElement>("#energy-plot .u-over")!;
      const ratio = canvas.width / canvas.clientWidth;
      const { data, width } = canvas
        .getContext("2d")!
        .getImageData(0, 0, canvas.width, canvas.height);
      // Passes 1 to the last span the plot.
      const coloured = (pass: number) => {
        const share = (pass - 1) / (passes - 1);
        const x = Math.round((box.offsetLeft + share * box.offsetWidth) * ratio);
        for (let y = 0; y < canvas.height; y++) {
          const [r, g, b] = data.slice(4 * (y * width + x), 4 * (y * width + x) + 3);
          if (Math.max(r!, g!, b!) - Math.min(r!, g!, b!) > 60) return true;
        }
        return false;
      };
      return after.map((one) => [coloured(one), coloured(one + 0.5)]);
    },
    { passes: report.history.length, after: made },
  );
  for (const column of columns) expect(column).toEqual([true, false]);
});

test("a sequence runs slowly enough to watch, one's own pace is kept, and pausing does not wait", async ({
  opened: page,
}) => {
  const pace = (await inTransport(page)).getByLabel("Pace");
  await expect(pace).toHaveValue("400");
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await expect(pace).toHaveValue("100");
  await (await inSettings(page)).getByLabel("Preset").selectOption("best");
  // Three rests lie between the start and the fourth pass, however slow the machine.
  const elapsed = await page.evaluate(async () => {
    const start = performance.now();
    document.getElementById("run")!.click();
    const made = () => (window as unknown as Passes).relievo.report.iterations;
    while (made() < 4) await new Promise((next) => setTimeout(next, 5));
    return performance.now() - start;
  });
  expect(elapsed).toBeGreaterThan(3 * 400 - 10);
  await pauseRun(page);
  await (await inTransport(page)).getByLabel("Pace").selectOption("as fast as possible");
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, (state) => state.report!.status !== "running" && !state.running);
  await openScene(page, "squares");
  await expect(pace).toHaveValue("0");
});

test("how good the result is expected to be is said", async ({ opened: page }) => {
  await solve(page);
  await expect(page.locator("#expected")).toHaveText(
    /^Expected errors: image motion about 0\.\d+\spx, labels about \d+\.\d\s%\.$/,
  );
  await page.getByRole("button", { name: "Reset" }).click();
  await expect(page.locator("#expected")).toBeEmpty();
});

test("options without effect under the preset are out of reach, and it is said why", async ({
  opened: page,
}) => {
  await inSettings(page);
  const idle = page.locator("#panel-settings .option").filter({ hasText: "No effect under" });
  const [steps, occlusion] = [
    (await inSettings(page)).locator("#option-depth_steps"),
    (await inSettings(page)).locator("#option-occlusion"),
  ];
  await expect(steps).toBeDisabled();
  await expect(steps).toHaveAccessibleDescription(/^No effect under best\./);
  await expect(occlusion).toBeEnabled();
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await expect(steps).toBeEnabled();
  await expect(occlusion).toBeDisabled();
  await expect(occlusion).toHaveAccessibleDescription(/^No effect under paper\./);
  const without = await read(
    page,
    ({ catalogues }) =>
      catalogues!.options.filter(({ presets }) => !presets.includes("paper")).length,
  );
  await expect(idle).toHaveCount(without);
});

test("what is said of the energy is what its line shows", async ({ opened: page }) => {
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await page.getByRole("button", { name: "Step" }).click();
  const text = page.locator("#energy-text");
  await expect(text).toHaveText(/^[\d.\s]+ after one pass\. /, { timeout: PATIENCE });
  await (await inResult(page)).getByRole("button", { name: "Curve 1", exact: true }).click();
  await page.keyboard.press("Shift+ArrowRight");
  await until(page, ({ report }) => report!.energy.total !== report!.history[0]);
  // Curves elsewhere: the number of the pass before is that of another sum.
  await expect(text).toHaveText(/^The next energies cannot be compared/);
});

test("reset goes back to the drawn curves, and running again starts over", async ({
  opened: page,
}) => {
  const back = async () => {
    await page.getByRole("button", { name: "Reset" }).click();
    await until(page, (state) => !state.started && state.report?.iterations === 0);
  };
  // From the first pass on there is a timeline, which leaves the picture less room.
  await runPasses(page, 1);
  await back();
  const before = await look(page);
  await runPasses(page, 3);
  expect((await look(page)).print).not.toBe(before.print);
  await back();
  expect((await look(page)).print).toBe(before.print);
  await expect((await inResult(page)).locator("#energy-panel")).toBeHidden();
  await runPasses(page, 1);
  expect(await passes(page)).toBeGreaterThan(0);
});

test("runs to an end by itself and says which", async ({ opened: page }) => {
  await openScene(page, "squares");
  await solve(page);
  await expect(page.locator("#status")).toContainText(/Converged|Pass limit reached/);
  await expect(page.getByRole("button", { name: "Run" })).toBeVisible();
  await expect(page.getByRole("button", { name: "Step" })).toBeDisabled();
  await expect(page.locator("#announcer")).toContainText(/passes/);
});

test("numbers stand beside each region, and scores where the truth is known", async ({
  opened: page,
}) => {
  await solve(page);
  const curve = page.locator("#regions > li").nth(1);
  await expect(curve).toContainText(/px.* · (still|rotation|translation)/);
  await expect(curve.locator("[data-number]")).toHaveCount(6);
  for (const cell of await curve.locator("[data-number]").allTextContents()) {
    expect(cell).toMatch(/^−?\d+\.\d+$/);
  }
  const scores = page.locator("#scores");
  await expect(scores).toBeVisible();
  await expect(scores).toContainText("Horn–Schunck");
  await expect(scores.getByRole("row", { name: /AEE/ })).toContainText(/\d\.\d+ px.*\d\.\d+ px/);
  await expect(scores.getByRole("row", { name: /Labels wrong/ })).toContainText("%");
});

test("what belongs to the default preset is shown, and can be turned off while it runs", async ({
  opened: page,
}) => {
  await inSettings(page);
  const levers = page.locator("#panel-settings .option input[type=checkbox]:not([id$=-auto])");
  expect(await levers.count()).toBeGreaterThanOrEqual(4);
  for (const lever of await levers.all()) {
    await expect(lever).toBeVisible();
    await expect(lever).toBeChecked();
  }
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, (state) => (state.report?.iterations ?? 0) >= 1);
  await (await inSettings(page)).getByLabel("Brightness change").uncheck();
  await (await inSettings(page)).locator("#option-occlusion").uncheck();
  await goesOn(page);
  await expect(page.locator("#message")).toBeHidden();
  await (await inSettings(page)).getByRole("button", { name: "Back to the preset" }).click();
  await expect((await inSettings(page)).locator("#option-occlusion")).toBeChecked();
});

test("the paper's preset is one choice away, also while it runs", async ({ opened: page }) => {
  const preset = (await inSettings(page)).getByLabel("Preset");
  await expect(preset).toHaveValue("best");
  await runPasses(page, 2);
  await page.getByRole("button", { name: "Run" }).click();
  await preset.selectOption("paper");
  await until(page, ({ report }) => report!.levels === 1 && report!.iterations >= 3);
  await pauseRun(page);
  const history = await read(page, (state) => state.report!.history);
  expect(history.at(-1)!).toBeLessThan(history[0]!);
  await preset.selectOption("best");
  await until(page, ({ report }) => report!.levels > 1);
  // All has started anew, so that there is nothing to reset.
  await expect(page.locator("#status")).toHaveText("Ready");
  await expect(page.getByRole("button", { name: "Reset" })).toBeDisabled();
  await runPasses(page, 1);
  await expect(page.locator("#status")).toContainText("scale 1/");
});

test("a weight can be changed while it runs", async ({ opened: page }) => {
  await inSettings(page);
  await runLong(page);
  await (await inSettings(page)).getByLabel("Diffusion").selectOption("isotropic");
  await until(page, (state) => state.options["diffusion"] === "isotropic");
  await goesOn(page);
  await expect(page.locator("#message")).toBeHidden();
});

test("a pause asked for before the run has begun is not lost", async ({ opened: page }) => {
  // One task, so that nothing is answered in between.
  await page.evaluate(() => {
    const focal = document.getElementById("focal") as HTMLInputElement;
    focal.value = "300";
    focal.dispatchEvent(new Event("change"));
    const run = document.getElementById("run") as HTMLButtonElement;
    run.click();
    run.click();
  });
  await until(page, (state) => !state.running);
  await page.getByRole("button", { name: "Step" }).click();
  await until(page, (state) => state.started && !state.running);
});

test("a run can be cancelled while a refused value stands in its field", async ({
  opened: page,
}) => {
  const focal = (await inSettings(page)).getByLabel("Focal length f, px");
  await runLong(page);
  await focal.fill("0");
  await focal.press("Enter");
  await expect(message(page)).toContainText("focal length is 0");
  await page.getByRole("button", { name: "Cancel" }).click();
  await until(page, (state) => !state.started && state.report?.iterations === 0);
  await focal.fill("320");
  await focal.press("Enter");
  await runPasses(page, 1);
  await expect(message(page)).toBeHidden();
  expect(await read(page, (state) => state.shapes.length)).toBe(2);
});

test("a value put right before the wrong one is refused is the one that holds", async ({
  opened: page,
}) => {
  await runPasses(page, 1);
  await page.evaluate(async () => {
    const field = document.getElementById("focal") as HTMLInputElement;
    for (const value of ["0", "500"]) {
      field.value = value;
      field.dispatchEvent(new Event("change"));
      // Time enough for it to be sent, not to be answered.
      for (let i = 0; i < 20; i++) await Promise.resolve();
    }
  });
  // Another focal length takes what was found with it.
  await until(page, (state) => !state.started && state.report?.iterations === 0);
  await expect(page.locator("#status")).toHaveText("Ready");
  await expect((await inResult(page)).locator("#scores-panel")).toBeHidden();
  await expect(page.getByRole("button", { name: "Reset" })).toBeDisabled();
  await expect(message(page)).toBeHidden();
});

test("once it runs it does not seem paused, whatever was still being drawn", async ({
  opened: page,
}) => {
  await page.evaluate(() => {
    const seen: string[] = [];
    Object.assign(window, { seen });
    new MutationObserver(() => seen.push(document.body.dataset["running"]!)).observe(
      document.body,
      {
        attributeFilter: ["data-running"],
      },
    );
    document.getElementById("view-compare")!.click();
    document.getElementById("run")!.click();
  });
  await until(page, (state) => (state.report?.iterations ?? 0) >= 1);
  const seen = await page.evaluate(() => (window as unknown as { seen: string[] }).seen);
  expect(seen).not.toContain("false");
});

test("a refused value leaves the run alone, and its sentence goes with it", async ({
  opened: page,
}) => {
  await inSettings(page);
  await runLong(page);
  // Files of one pass would be gone with the next.
  const take = (await inExport(page)).getByRole("button", { name: "Depth Z: PFM" });
  await expect(take).toBeDisabled();
  await page.keyboard.press("Escape");
  const epsilon = (await inSettings(page)).locator("#option-epsilon");
  const good = await epsilon.inputValue();
  await epsilon.fill("99");
  await epsilon.press("Enter");
  await expect(page.locator("#message")).toContainText("Epsilon is 99");
  expect(await read(page, (state) => state.running)).toBe(true);
  await goesOn(page);
  await epsilon.fill(good);
  await epsilon.press("Enter");
  await expect(page.locator("#message")).toBeHidden();
  await pauseRun(page);
  const focal = (await inSettings(page)).getByLabel("Focal length f, px");
  await focal.fill("-5");
  await focal.press("Enter");
  await expect(page.locator("#message")).toContainText("focal length is -5");
  await openScene(page, "head");
  await expect(page.locator("#message")).toBeHidden();
});
