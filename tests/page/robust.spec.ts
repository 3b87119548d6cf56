/** What must not go wrong: panics, hangs, a worker faster than the screen, a main thread kept busy. */

import type { Page } from "@playwright/test";

import {
  chooseView,
  expect,
  open,
  openScene,
  PATIENCE,
  read,
  ready,
  runPasses,
  test,
  until,
  inResult,
  inSettings,
  inTransport,
} from "./helpers";

const message = (page: Page) => page.locator("#message");

/** Makes the core do `what` at the second step, in the first worker only. */
async function sabotage(page: Page, what: string): Promise<void> {
  let first = true;
  await page.route(/\/worker-[^/]*\.js$/, async (route) => {
    const response = await route.fetch();
    const script = await response.text();
    const body = first ? `${wrapper(what)}\n${script}` : script;
    first = false;
    await route.fulfill({ response, body });
  });
}

/** Stands between the worker and the module it loads, at the very border where a trap would show. */
const wrapper = (what: string) => `
{
  const wrap = (result) => {
    const real = result.instance.exports;
    let steps = 0;
    const exports = { ...real, solver_step: (...given) => {
      steps += 1;
      if (steps === 2) { ${what} }
      return real.solver_step(...given);
    } };
    return { module: result.module, instance: { exports } };
  };
  for (const name of ["instantiate", "instantiateStreaming"]) {
    const real = WebAssembly[name];
    WebAssembly[name] = async (...given) => wrap(await real.apply(WebAssembly, given));
  }
}`;

const PANIC = `
  const text = new TextEncoder().encode("the sky is falling");
  const at = real.__wbindgen_malloc(text.length, 1);
  new Uint8Array(real.memory.buffer).set(text, at);
  real.panicForTest(at, text.length);`;

test("a panic is told with its text; the worker is renewed, frames and curves stay", async ({
  page,
}) => {
  await sabotage(page, PANIC);
  await open(page);
  await (await inResult(page)).getByRole("button", { name: "Add a circle" }).click();
  const shapes = await read(page, (state) => state.shapes);
  await page.getByRole("button", { name: "Run" }).click();
  await expect(page.locator("#message")).toContainText("the sky is falling", { timeout: PATIENCE });
  // With the pass before, if that had reached the page.
  await until(page, (state) => !state.running && state.busy === null && state.report !== null);
  expect(await read(page, (state) => state.shapes)).toEqual(shapes);
  expect(shapes).toHaveLength(3);
  await runPasses(page, 3);
  expect(await read(page, (state) => state.report!.iterations)).toBeGreaterThan(0);
});

test("a hang can be cancelled, even with a focal length that no camera has", async ({ page }) => {
  await sabotage(page, "for (;;) {}");
  await open(page);
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, (state) => (state.report?.iterations ?? 0) >= 1);
  // Pausing asks a worker that no longer listens; the page itself must still answer.
  await page.getByRole("radio", { name: "Depth", exact: true }).check({ force: true });
  await expect(page.locator("#hint")).toContainText("Hatched");
  const focal = (await inSettings(page)).getByLabel("Focal length f, px");
  await focal.fill("0");
  await focal.press("Enter");
  await page.getByRole("button", { name: "Cancel" }).click();
  await until(page, (state) => !state.running && state.busy === null && !state.started);
  expect(await read(page, (state) => state.shapes.length)).toBe(2);
  await focal.fill("320");
  await focal.press("Enter");
  await runPasses(page, 3);
});

test("a core that cannot be loaded again can be once the line is back", async ({ page }) => {
  // Three workers, one after the other, each of which loads the core.
  test.slow();
  await sabotage(page, "for (;;) {}");
  await open(page);
  const shapes = await read(page, (state) => state.shapes);
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, (state) => (state.report?.iterations ?? 0) >= 1);
  // A worker that rests between two passes would answer.
  await page.waitForTimeout(1000);
  await page.route(/\.wasm$/, (route) => route.abort());
  await page.getByRole("button", { name: "Cancel" }).click();
  await expect(message(page)).toContainText("solver cannot be loaded", { timeout: PATIENCE });
  await until(page, (state) => !state.running && state.busy === null && state.report === null);
  await page.unroute(/\.wasm$/);
  // The worker that could not load it says so once more; the next one can.
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, (state) => !state.running && state.report?.iterations === 0);
  expect(await read(page, (state) => state.shapes)).toEqual(shapes);
  await runPasses(page, 2);
});

test("a core that cannot be loaded is said", async ({ page }) => {
  await page.route(/\.wasm$/, (route) => route.fulfill({ status: 404, body: "gone" }));
  await page.goto("./");
  await expect(page.locator("#message")).toBeVisible({ timeout: PATIENCE });
  await expect(page.locator("#message")).toContainText("solver cannot be loaded");
});

test("never more than one progress is on its way", async ({ page }) => {
  await page.addInitScript(watchProgress);
  await open(page);
  await openScene(page, "flight");
  await chooseView(page, "Depth");
  // Far more passes in a second than the screen shows pictures.
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await (await inTransport(page)).getByLabel("Pace").selectOption("as fast as possible");
  await page.getByRole("button", { name: "Run" }).click();
  await page.waitForFunction(
    () => {
      const { report, running } = (window as unknown as Watched).relievo;
      return !running || (report?.iterations ?? 0) >= 25;
    },
    undefined,
    { timeout: PATIENCE },
  );
  const seen = await page.evaluate(() => (window as unknown as Watched).progressSeen);
  expect(seen.messages).toBeGreaterThan(5);
  expect(seen.most).toBe(1);
});

interface Watched {
  relievo: { running: boolean; report: { iterations: number } | null };
  progressSeen: { messages: number; most: number };
}

/** Runs in the page before its scripts: listens in on the ports that progress arrives on. */
function watchProgress(): void {
  const seen = { messages: 0, most: 0 };
  Object.assign(window, { progressSeen: seen });
  const open = new Set<string>();
  const listen = MessagePort.prototype.addEventListener;
  MessagePort.prototype.addEventListener = function (
    this: MessagePort,
    type: string,
    listener: EventListener,
    ...rest: never[]
  ) {
    const heard = (event: Event) => {
      const { data } = event as MessageEvent;
      if (data?.type === "APPLY") {
        open.add(data.id);
        seen.messages += 1;
        seen.most = Math.max(seen.most, open.size);
      }
      listener.call(this, event);
    };
    listen.call(this, type, type === "message" ? heard : listener, ...rest);
  } as typeof listen;
  const answer = MessagePort.prototype.postMessage;
  MessagePort.prototype.postMessage = function (this: MessagePort, ...given: never[]) {
    open.delete((given[0] as unknown as { id?: string })?.id ?? "");
    return (answer as (...all: never[]) => void).apply(this, given);
  } as typeof answer;
}

test("the built page asks for the relief's library only when the relief is opened", async ({
  page,
}) => {
  const scripts: string[] = [];
  page.on("response", (response) => {
    if (response.url().endsWith(".js")) scripts.push(response.url());
  });
  await open(page);
  const before = scripts.length;
  await chooseView(page, "Relief");
  await expect(page.locator("#relief canvas")).toBeVisible({ timeout: PATIENCE });
  expect(scripts.length).toBeGreaterThan(before);
});

test("a browser without WebAssembly SIMD is told what it lacks", async ({ page }) => {
  await page.route(/\/worker-[^/]*\.js$/, async (route) => {
    const response = await route.fetch();
    const body = `WebAssembly.validate = () => false;\n${await response.text()}`;
    await route.fulfill({ response, body });
  });
  await page.goto("./");
  await expect(page.locator("#message")).toContainText("WebAssembly SIMD", { timeout: PATIENCE });
});

/** A worker that the browser ends, for want of memory, says `error` and no more. */
function keepWorkers(): void {
  const Real = Worker;
  const made: Worker[] = [];
  Object.assign(window, { workersMade: made });
  window.Worker = class extends Real {
    constructor(address: string | URL, options?: WorkerOptions) {
      super(address, options);
      if (options?.name === "solver") made.push(this);
    }
  };
}

const killWorker = (page: Page) =>
  page.evaluate(() => {
    const worker = (window as unknown as { workersMade: Worker[] }).workersMade.at(-1)!;
    worker.terminate();
    worker.dispatchEvent(new ErrorEvent("error", { message: "out of memory" }));
  });

test("a worker killed at any moment is told; frames, curves and settings are there again", async ({
  page,
}, info) => {
  // More of them with RELIEVO_KILLS.
  const kills = Number(process.env["RELIEVO_KILLS"] ?? 4);
  info.setTimeout((2 + kills) * PATIENCE);
  await page.addInitScript(keepWorkers);
  await open(page);
  await (await inResult(page)).getByRole("button", { name: "Add a circle" }).click();
  await (await inSettings(page)).getByLabel("Preset").selectOption("paper");
  await (await inTransport(page)).getByLabel("Pace").selectOption("as fast as possible");
  const shapes = await read(page, (state) => state.shapes);
  const source = await read(page, (state) => state.source);
  let state = 7;
  for (let i = 0; i < kills; i += 1) {
    await page.getByRole("button", { name: "Run" }).click();
    await expect(page.locator("#message")).toBeHidden();
    // A moment of its own each time, the same in each run of the test.
    state = (state * 16_807) % 2_147_483_647;
    await page.waitForTimeout(state % 700);
    await killWorker(page);
    await expect(page.locator("#message")).toContainText(/out of memory/i, { timeout: PATIENCE });
    await until(page, ({ running, busy, frames }) => !running && busy === null && frames !== null);
    expect(await read(page, (state) => state.shapes)).toEqual(shapes);
    expect(await read(page, (state) => state.source)).toEqual(source);
    await expect((await inSettings(page)).getByLabel("Preset")).toHaveValue("paper");
  }
  await runPasses(page, 3);
  expect(await read(page, (state) => state.report!.iterations)).toBeGreaterThan(0);
});

test("the built page runs from any folder of a server", async ({ page }) => {
  await page.route("**/some/folder/**", async (route) => {
    const url = route.request().url().replace("/some/folder/", "/");
    await route.fulfill({ response: await route.fetch({ url }) });
  });
  const elsewhere: string[] = [];
  page.on("request", (request) => {
    const { protocol, pathname } = new URL(request.url());
    if (/^http/.test(protocol) && !pathname.startsWith("/some/folder/")) elsewhere.push(pathname);
  });
  await page.goto("./some/folder/");
  await ready(page);
  await runPasses(page, 2);
  await chooseView(page, "Relief");
  await expect(page.locator("#relief canvas")).toBeVisible({ timeout: PATIENCE });
  expect(elsewhere).toEqual([]);
});
