/** What a sequence shows at first: its curves drawn, ready to run. */

import { expect, look, read, test, inSettings } from "./helpers";

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
