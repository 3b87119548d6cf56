/** Lessons: on the live solver in one click, step by step, and by link. */

import AxeBuilder from "@axe-core/playwright";
import type { Page } from "@playwright/test";

import { expect, inTransport, open, PATIENCE, read, test, until } from "./helpers";

const lessons = (page: Page) => page.locator("#lessons");

async function faults(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations.map(({ id, nodes }) => `${id}: ${nodes[0]?.target.join(" ")}`);
}

test("a lesson opens in one click on the live solver", async ({ opened: page }) => {
  await page.getByRole("tab", { name: "Learn" }).click();
  await lessons(page).getByRole("link", { name: "The aperture problem" }).click();
  await expect(lessons(page).getByRole("heading", { name: "The aperture problem" })).toBeVisible();
  await expect(lessons(page)).toContainText("One equation, two unknowns");
  await until(page, (state) => state.view === "compare" && state.report?.status === "converged");
  const highlighted = lessons(page).locator(".term-data");
  await expect(highlighted).toHaveCSS("outline-style", "solid");
  await expect(lessons(page).locator(".term-length")).toHaveCSS("outline-style", "none");
  expect(await faults(page)).toEqual([]);

  // The next step looks at the same result in another way.
  const before = await read(page, (state) => state.revision);
  await lessons(page).getByRole("link", { name: "Next step" }).click();
  await until(page, (state) => state.view === "motion");
  expect(await read(page, (state) => state.revision)).toBe(before);
  const answer = lessons(page).getByText("Texture is what makes motion visible");
  await expect(answer).toBeHidden();
  await lessons(page).locator("summary").click();
  await expect(answer).toBeVisible();
  await page.goBack();
  await until(page, (state) => state.view === "compare");
  await expect(lessons(page)).toContainText("One equation, two unknowns");
});

test("every step of every lesson is set up, and says something", async ({ opened: page }) => {
  test.setTimeout(12 * PATIENCE);
  await (await inTransport(page)).getByLabel("Pace").selectOption("as fast as possible");
  await page.getByRole("tab", { name: "Learn" }).click();
  const links = lessons(page).locator("ol a");
  await expect(links).toHaveCount(12);
  await links.first().click();
  let steps = 0;
  for (let next = true; next;) {
    const address = await page.evaluate(() => location.hash);
    await expect
      .poll(() => read(page, (state) => state.lessonStep), { timeout: PATIENCE })
      .toBe(address);
    // The first step of each; the others are passed through.
    if (address.endsWith("/1")) await until(page, (state) => state.started && state.busy === null);
    expect(await read(page, (state) => state.message), address).toBeNull();
    expect(await lessons(page).locator(".look").innerText(), address).toMatch(/^\w/);
    await expect(lessons(page).locator(".lesson-text p").first()).not.toBeEmpty();
    steps += 1;
    const forward = lessons(page).locator("a.primary");
    next = (await forward.count()) > 0;
    if (next) await forward.click();
    await expect.poll(() => page.evaluate(() => location.hash)).not.toBe(next ? address : "");
  }
  expect(steps).toBeGreaterThan(24);
});

test("a step can be linked to, set up again, and left", async ({ page }) => {
  await open(page, "./#learn/start/2");
  await expect(page.getByRole("tab", { name: "Learn" })).toHaveAttribute("aria-selected", "true");
  await until(page, (state) => state.shapes.length === 1 && state.started);
  expect(await page.evaluate(() => location.hash)).toBe("#learn/start/2");
  await until(page, (state) => !state.running);
  await page.getByRole("button", { name: "Reset" }).click();
  await until(page, (state) => !state.started);
  await lessons(page).getByRole("button", { name: "Set this step up again" }).click();
  await until(page, (state) => state.started);
  await lessons(page).getByRole("button", { name: "All lessons" }).click();
  await expect(lessons(page).locator("ol a")).toHaveCount(12);
  await expect.poll(() => page.evaluate(() => location.hash)).toBe("#squares/curves");

  await page.evaluate(() => (location.hash = "#learn/nothing"));
  await expect(page.locator("#message")).toContainText("no lesson called “nothing”");
});

test.describe("on a phone", () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true });

  test("a lesson is read in a sheet over the stage", async ({ page }) => {
    await open(page, "./#learn/anaglyph/1");
    await until(page, (state) => state.view === "anaglyph" && state.started);
    await expect(lessons(page).getByRole("heading", { level: 2 })).toBeInViewport();
    expect(await faults(page)).toEqual([]);
  });
});
