/** What a sequence shows at first: its curves drawn, ready to run. */

import { moments, photo } from "./films";
import { expect, look, read, ready, test, inSettings } from "./helpers";

/** Bytes of the WebAssembly that solves. */
const WASM_BYTES = 1_200_000;
/** Bytes of all that is sent until a sequence can be solved, compressed. */
const SENT_BYTES = 800_000;

test("a sequence is there with its curves drawn, ready to run", async ({ opened: page }) => {
  await expect(page).toHaveTitle(/Relievo/);
  expect(await read(page, (state) => state.source)).toMatchObject({
    kind: "scene",
    name: "blocks",
  });
  expect(await read(page, (state) => state.shapes.length)).toBe(2);
  await expect(page.getByRole("button", { name: "Run" })).toBeEnabled();
  await expect(page.locator("#regions > li")).toHaveCount(3);
  await expect(page.locator("#status")).toHaveText("Ready");
  await expect((await inSettings(page)).getByLabel("Preset")).toHaveValue("best");
  await expect(page.locator("#lesson")).not.toBeEmpty();
  expect((await look(page)).colours).toBeGreaterThan(20);
  expect((await look(page, "#overlay")).colours).toBeGreaterThan(2);
});

test("asks nothing of other hosts", async ({ page, baseURL }) => {
  const strangers: string[] = [];
  page.on("request", (request) => {
    const url = request.url();
    if (!url.startsWith(baseURL!) && !/^(data|blob):/.test(url)) strangers.push(url);
  });
  await page.goto("./");
  await expect(page.getByRole("button", { name: "Run" })).toBeEnabled({ timeout: 60_000 });
  expect(strangers).toEqual([]);
});

test("what comes before there is a solver is small, and decoders come with the first file that needs them", async ({
  page,
  request,
}) => {
  const asked = new Set<string>();
  page.on("response", (response) => asked.add(response.url()));
  await page.goto("./");
  await ready(page);
  let sent = 0;
  for (const url of asked) {
    const response = await request.get(url, { headers: { "Accept-Encoding": "br" } });
    sent += Number(response.headers()["content-length"]);
    if (!url.endsWith(".wasm")) continue;
    const plain = await request.get(url, { headers: { "Accept-Encoding": "identity" } });
    expect((await plain.body()).length).toBeLessThan(WASM_BYTES);
  }
  expect(sent).toBeGreaterThan(200_000);
  expect(sent).toBeLessThan(SENT_BYTES);
  const decoders = () => [...asked].filter((url) => /decoders.*\.wasm$/.test(url)).length;
  expect(decoders()).toBe(0);
  const [first] = moments(1);
  const buffer = await photo(page, first!, 72);
  await page.locator("#file-0").setInputFiles({ name: "a.jpg", mimeType: "image/jpeg", buffer });
  await expect(page.locator("#slots-note")).toContainText("second frame is still missing");
  expect(decoders()).toBe(1);
});

test("every sequence opens with a title and a lesson of its own", async ({ opened: page }) => {
  const names = await read(page, (state) => state.catalogues!.scenes.map(({ name }) => name));
  expect(names.length).toBeGreaterThanOrEqual(6);
  const lessons = new Set<string>();
  for (const name of names) {
    await page.getByLabel("Sequence").selectOption(name);
    await expect
      .poll(() => read(page, (state) => (state.source as { name?: string }).name), {
        timeout: 60_000,
      })
      .toBe(name);
    lessons.add((await page.locator("#lesson").textContent())!);
    expect((await look(page)).colours, name).toBeGreaterThan(10);
  }
  expect(lessons.size).toBe(names.length);
});

test("flickers between the two frames", async ({ opened: page }) => {
  const first = await look(page);
  await page.getByRole("radio", { name: "2nd" }).check({ force: true });
  const second = await look(page);
  expect(second.print).not.toBe(first.print);
  await page.getByRole("radio", { name: "Flicker" }).check({ force: true });
  const prints = new Set<number>();
  await expect
    .poll(async () => prints.add((await look(page)).print).size, { timeout: 20_000 })
    .toBe(2);
  expect(prints).toEqual(new Set([first.print, second.print]));
});
