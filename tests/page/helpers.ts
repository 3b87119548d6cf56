/** What the page tests share: opening the page, reading its state and its pixels, making frames. */

import { test as base, expect, type Page } from "@playwright/test";

import type { State } from "../../www/store";

/** The machine may be slow and shared: wait for what must happen, not for how fast. */
export const PATIENCE = Number(process.env["RELIEVO_PATIENCE"] ?? 60_000);

export const test = base.extend<{ opened: Page; patient: void }>({
  patient: [
    async ({}, use, info) => {
      info.setTimeout(3 * PATIENCE);
      await use();
    },
    { auto: true },
  ],
  opened: async ({ page }, use) => {
    const broken: string[] = [];
    page.on("pageerror", (error) => broken.push(error.message));
    await open(page);
    await use(page);
    expect(broken, "errors nobody caught").toEqual([]);
  },
});

export { expect };

/** Two marble blocks with a circle on each, ready to run. */
export async function open(page: Page, address = "./#blocks"): Promise<void> {
  await page.goto(address);
  await ready(page);
}

export async function ready(page: Page): Promise<void> {
  await until(page, (state) => state.frames !== null && state.busy === null);
}

/** Reads from the page's state; the function runs in the page and must stand alone. */
export function read<T>(page: Page, select: (state: State) => T): Promise<T> {
  return page.evaluate(`(${select})(window.relievo)`) as Promise<T>;
}

/** Asked from here again and again: the page's policy lets nobody leave code in it to wait. */
export async function until(page: Page, holds: (state: State) => boolean): Promise<void> {
  const answer = () => page.evaluate(`(${holds})(window.relievo)`).catch(() => false);
  const often = { timeout: PATIENCE, intervals: [50], message: String(holds) };
  await expect.poll(answer, often).toBe(true);
}

export const passes = (page: Page): Promise<number> =>
  read(page, (state) => state.report?.iterations ?? 0);

/** Runs until at least `count` passes are made, then pauses. */
export async function runPasses(page: Page, count: number): Promise<void> {
  await page.getByRole("button", { name: "Run" }).click();
  await page.waitForFunction(
    (least) => {
      const { report, running } = (window as unknown as { relievo: State }).relievo;
      return (report?.iterations ?? 0) >= least || (!running && (report?.iterations ?? 0) > 0);
    },
    count,
    { timeout: PATIENCE },
  );
  await pauseRun(page);
}

/** Opens a tab of the panel, with everything that can be unfolded in it. */
export async function openTab(page: Page, name: "Result" | "Settings" | "Learn"): Promise<Page> {
  const tab = page.getByRole("tab", { name });
  if ((await tab.getAttribute("aria-selected")) !== "true") await tab.click();
  await page.evaluate(() => {
    for (const one of document.querySelectorAll("[role=tabpanel]:not([hidden]) details")) {
      one.setAttribute("open", "");
    }
  });
  return page;
}

export const inSettings = (page: Page) => openTab(page, "Settings");
export const inResult = (page: Page) => openTab(page, "Result");

/** The panel in which frames of one's own are opened. */
export async function inOpen(page: Page): Promise<Page> {
  const panel = page.locator("#frames-panel");
  if (!(await panel.isVisible()))
    await page.getByRole("button", { name: "Open", exact: true }).click();
  return page;
}

/** The dialog with all there is to take away. */
export async function inExport(page: Page): Promise<Page> {
  await page.getByRole("button", { name: "Export", exact: true }).click();
  await page.locator("#export-sheet").waitFor();
  return page;
}

/** The pace and the parts of a pass; behind a button where the window is not wide. */
export async function inTransport(page: Page): Promise<Page> {
  const more = page.getByRole("button", { name: "Single parts and speed" });
  if (!(await page.locator("#pace").isVisible())) await more.click();
  return page;
}

/** Sets a run going that lasts far longer than any test looks at it. */
export async function runLong(page: Page): Promise<void> {
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await (await inTransport(page)).getByLabel("Pace").selectOption("slow enough to watch");
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, (state) => (state.report?.iterations ?? 0) >= 1);
}

/** Runs to the end, as fast as possible. */
export async function solve(page: Page): Promise<void> {
  await (await inTransport(page)).getByLabel("Pace").selectOption("as fast as possible");
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, ({ report, running, started }) => {
    return started && !running && report !== null && report.status !== "running";
  });
}

/** Waits for another pass, or for the end. */
export async function goesOn(page: Page): Promise<void> {
  const then = await passes(page);
  await page.waitForFunction(
    (least) => {
      const { report } = (
        window as unknown as { relievo: { report: { iterations: number; status: string } } }
      ).relievo;
      return report.iterations > least || report.status !== "running";
    },
    then,
    { timeout: PATIENCE },
  );
}

/** Pauses, unless it has come to its end by itself. */
export async function pauseRun(page: Page): Promise<void> {
  // At once, lest the run end in between and the button start it again.
  await page.evaluate(() =>
    document.querySelector<HTMLElement>("body[data-running=true] #run")?.click(),
  );
  await until(page, (state) => !state.running);
}

export async function openScene(page: Page, scene: string): Promise<void> {
  await page.getByLabel("Sequence").selectOption(scene);
  await page.waitForFunction(
    (name) => {
      const { source, busy } = (window as unknown as { relievo: State }).relievo;
      return source?.kind === "scene" && source.name === name && busy === null;
    },
    scene,
    { timeout: PATIENCE },
  );
}

/** The first row names some views otherwise, or several of them at once. */
const ROW: Record<string, string> = {
  Curves: "Outlines",
  Relief: "3-D",
  Anaglyph: "3-D",
  Labels: "Diagnostics",
  Confidence: "Diagnostics",
  Occlusion: "Diagnostics",
  Residual: "Diagnostics",
  Compare: "Diagnostics",
  Error: "Diagnostics",
};

/** As a person would: the row of views, then the choice within. */
export async function pressView(page: Page, name: string): Promise<void> {
  const row = ROW[name] ?? name;
  await page
    .locator("#views")
    .getByRole("radio", { name: row, exact: true })
    .check({ force: true });
  if (row === name || row === "Outlines") return;
  const within = page.locator("#views-within").getByRole("radio", { name, exact: true });
  await within.check({ force: true });
}

export async function chooseView(page: Page, name: string): Promise<void> {
  await pressView(page, name);
  await until(
    page,
    ({ view, pictured, pictures }) =>
      pictured.split(" ")[0] === view && pictures.every((one) => one !== null),
  );
  await drawn(page);
}

/** Resolves when everything asked of the screen so far is on it. */
export async function drawn(page: Page): Promise<void> {
  await page.evaluate(
    () => new Promise((done) => requestAnimationFrame(() => requestAnimationFrame(done))),
  );
}

export interface Look {
  /** Changes when any pixel does. */
  print: number;
  /** How many different colours, coarsely. */
  colours: number;
}

/** What a canvas shows. */
export async function look(page: Page, canvas = "#picture"): Promise<Look> {
  await drawn(page);
  return page.locator(canvas).evaluate((element) => {
    const source = element as HTMLCanvasElement;
    const copy = document.createElement("canvas");
    copy.width = source.width;
    copy.height = source.height;
    const context = copy.getContext("2d")!;
    context.drawImage(source, 0, 0);
    const { data } = context.getImageData(0, 0, copy.width, copy.height);
    let print = 0;
    const seen = new Set<number>();
    for (let i = 0; i < data.length; i += 4) {
      const colour = (data[i]! << 16) | (data[i + 1]! << 8) | data[i + 2]!;
      print = (Math.imul(print, 31) + colour + data[i + 3]!) | 0;
      if (data[i + 3]! > 0) seen.add(colour & 0xf0f0f0);
    }
    return { print, colours: seen.size };
  });
}

/** Where a pixel of the frame lies on the screen. */
export async function onScreen(
  page: Page,
  x: number,
  y: number,
): Promise<{ x: number; y: number }> {
  return page.evaluate(
    ([x, y]) => {
      const { width, height } = (window as unknown as { relievo: State }).relievo;
      const box = document.getElementById("overlay")!.getBoundingClientRect();
      // The frame is centred and as large as margins of at most 16 px leave room.
      const margin = Math.min(16, box.width / 40);
      // On a narrow stage the zoom's bar has its room below.
      const bar = box.width < 560 ? 52 : 0;
      const room = box.height - bar - 2 * margin;
      const scale = Math.min((box.width - 2 * margin) / width, room / height);
      const free = box.height - height * scale;
      return {
        x: box.left + (box.width - width * scale) / 2 + (x! + 0.5) * scale,
        y: box.top + Math.min(free / 2, Math.max(margin, free - bar)) + (y! + 0.5) * scale,
      };
    },
    [x, y],
  );
}

/** A built-in sequence's frames as PNG files, as if they were someone's own. */
export async function framesOf(page: Page, scene: string): Promise<[Buffer, Buffer]> {
  await openScene(page, scene);
  const pictures = await page.evaluate(() => {
    const { frames } = (window as unknown as { relievo: State }).relievo;
    return frames!.map((frame) => {
      const canvas = document.createElement("canvas");
      canvas.width = frame.width;
      canvas.height = frame.height;
      canvas.getContext("2d")!.drawImage(frame, 0, 0);
      return canvas.toDataURL("image/png").split(",")[1]!;
    });
  });
  return pictures.map((text) => Buffer.from(text, "base64")) as [Buffer, Buffer];
}

/** A PNG of one colour, or of stripes. */
export async function plainPng(
  page: Page,
  width: number,
  height: number,
  stripes = false,
): Promise<Buffer> {
  const text = await page.evaluate(
    ({ width, height, stripes }) => {
      const canvas = document.createElement("canvas");
      canvas.width = width;
      canvas.height = height;
      const context = canvas.getContext("2d")!;
      context.fillStyle = "#777";
      context.fillRect(0, 0, width, height);
      context.fillStyle = "#ccc";
      for (let x = 0; stripes && x < width; x += 8) context.fillRect(x, 0, 4, height);
      return canvas.toDataURL("image/png").split(",")[1]!;
    },
    { width, height, stripes },
  );
  return Buffer.from(text, "base64");
}

export const png = (name: string, buffer: Buffer) => ({ name, mimeType: "image/png", buffer });
