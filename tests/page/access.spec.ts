/** For everyone: axe in light and dark, the phone, the keyboard, the theme. */

import AxeBuilder from "@axe-core/playwright";
import type { Page } from "@playwright/test";

import {
  chooseView,
  expect,
  inOpen,
  inResult,
  inSettings,
  open,
  openTab,
  read,
  runPasses,
  test,
} from "./helpers";

async function faults(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target.join(" ")).join(", ")}`);
}

for (const colorScheme of ["light", "dark"] as const) {
  test.describe(colorScheme, () => {
    test.use({ colorScheme });

    test("axe finds nothing serious, before and after a run, in any view", async ({
      opened: page,
    }) => {
      expect(await faults(page)).toEqual([]);
      await runPasses(page, 2);
      await inSettings(page);
      expect(await faults(page)).toEqual([]);
      for (const view of ["Depth", "Anaglyph", "Relief", "Compare"]) {
        await chooseView(page, view);
        expect(await faults(page), view).toEqual([]);
      }
    });

    for (const width of [1280, 390]) {
      test(`axe finds nothing serious in any panel, ${width} pixels wide`, async ({ page }) => {
        await page.setViewportSize({ width, height: 820 });
        await open(page);
        await runPasses(page, 2);
        for (const tab of ["Result", "Settings", "Learn"] as const) {
          await openTab(page, tab);
          expect(await faults(page), tab).toEqual([]);
        }
        await page.keyboard.press("Escape");
        await chooseView(page, "Depth");
        await page.getByRole("button", { name: "Two views" }).click();
        await page.locator("#overlay").focus();
        await page.keyboard.press("ArrowUp");
        await expect(page.locator("#readout")).toContainText("confidence");
        expect(await faults(page), "two views and the readout").toEqual([]);
        await inOpen(page);
        expect(await faults(page), "Open").toEqual([]);
      });
    }

    test("axe finds nothing serious beside an error", async ({ opened: page }) => {
      await (await inSettings(page)).getByLabel("Focal length f, px").fill("0");
      await (await inSettings(page)).getByLabel("Focal length f, px").press("Enter");
      await expect(page.locator("#message")).toBeVisible();
      expect(await faults(page)).toEqual([]);
    });
  });
}

const brightness = (page: Page) =>
  page.evaluate(() => {
    const probe = document.createElement("canvas").getContext("2d")!;
    probe.fillStyle = getComputedStyle(
      document.querySelector(".panels:not([hidden])")!,
    ).backgroundColor;
    probe.fillRect(0, 0, 1, 1);
    return probe.getImageData(0, 0, 1, 1).data[0]!;
  });

test("follows the system's colours until the button says otherwise, and remembers", async ({
  page,
}) => {
  await page.emulateMedia({ colorScheme: "dark" });
  await open(page);
  expect(await brightness(page)).toBeLessThan(80);
  await page.getByRole("button", { name: "Dark colours" }).click();
  expect(await brightness(page)).toBeGreaterThan(180);
  await page.reload();
  expect(await brightness(page)).toBeGreaterThan(180);
});

test("the chosen view stays in sight when the window becomes narrow", async ({ opened: page }) => {
  await page.setViewportSize({ width: 1280, height: 800 });
  await chooseView(page, "Compare");
  await page.setViewportSize({ width: 390, height: 844 });
  await expect(page.locator("#views label:has(:checked)")).toBeInViewport({ ratio: 0.99 });
});

test.describe("on a phone", () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true });

  test("nothing sticks out, the stage is in the first screen, targets are large", async ({
    opened: page,
  }) => {
    const fits = () => page.evaluate(() => document.documentElement.scrollWidth <= innerWidth);
    expect(await fits()).toBe(true);
    const run = (await page.getByRole("button", { name: "Run" }).boundingBox())!;
    expect(run.y + run.height).toBeLessThan(844);
    const stage = (await page.locator("#stage").boundingBox())!;
    expect(stage.width).toBeGreaterThan(380);
    await inSettings(page);
    // Once more: the sheet goes, and the stage has its room.
    await page.getByRole("tab", { name: "Settings" }).click();
    await runPasses(page, 1);
    for (const view of ["Motion", "Anaglyph", "Relief", "Compare", "Curves"]) {
      await chooseView(page, view);
      expect(await fits(), view).toBe(true);
    }
    const small = await page.evaluate(() =>
      [...document.querySelectorAll("button, select, input[type=range], .pick, .tools label")]
        .filter((element) => (element as HTMLElement).checkVisibility())
        .filter((element) => element.getBoundingClientRect().height < 43.5)
        .map((element) => element.id || element.className || element.textContent),
    );
    expect(small).toEqual([]);
  });
});

test("the keyboard keeps its place when what it pressed goes away", async ({ opened: page }) => {
  const press = (name: string) => page.getByRole("button", { name }).press("Enter");
  await press("Delete curve 1");
  await expect(
    (await inResult(page)).getByRole("button", { name: "Delete curve 1" }),
  ).toBeFocused();
  await press("Delete curve 1");
  await expect((await inResult(page)).getByRole("button", { name: "Add a circle" })).toBeFocused();
  await runPasses(page, 1);
  await press("Reset");
  await expect(page.getByRole("button", { name: "Run" })).toBeFocused();
});

test("the keyboard reaches everything and always shows where it is", async ({ opened: page }) => {
  const reached = new Set<string>();
  for (let i = 0; i < 60; i++) {
    await page.keyboard.press("Tab");
    const here = await page.evaluate(() => {
      const element = document.activeElement!;
      if (element === document.body) return { id: "", ringed: false };
      const label = element.closest("label");
      const ringed = [element, element.nextElementSibling, label].some(
        (one) => one && getComputedStyle(one).outlineStyle !== "none",
      );
      return {
        id: element.id || element.getAttribute("name") || element.textContent!.trim(),
        ringed,
      };
    });
    if (here.id) {
      expect(here.ringed, here.id).toBe(true);
      reached.add(here.id);
    }
  }
  for (const id of [
    "scene",
    "open",
    "theme",
    "view-curves",
    "overlay",
    "run",
    "step",
    "tab-result",
  ]) {
    expect([...reached], id).toContain(id);
  }
  expect(await read(page, (state) => state.message)).toBeNull();
});

test("frames of one's own are opened from the masthead", async ({ opened: page }) => {
  await page.setViewportSize({ width: 1280, height: 800 });
  await page.getByRole("button", { name: "Open", exact: true }).click();
  await expect(page.locator("#frames-title")).toBeInViewport({ ratio: 1 });
  await expect(page.locator(".masthead")).toBeInViewport({ ratio: 1 });
  await expect(page.getByText("Clip or pictures…")).toBeInViewport({ ratio: 1 });
  await page.keyboard.press("Escape");
  await expect(page.locator("#frames-title")).toBeHidden();
});

for (const [what, size] of [
  ["on a phone held sideways", { width: 844, height: 390 }],
  ["on a small phone held sideways", { width: 667, height: 375 }],
  ["enlarged twice", { width: 640, height: 400 }],
] as const) {
  test(`Run is in sight ${what}`, async ({ page }) => {
    await page.setViewportSize(size);
    await open(page);
    const run = page.getByRole("button", { name: "Run" });
    await expect(run).toBeInViewport({ ratio: 1 });
    await expect(page.locator("#stage")).toBeInViewport({ ratio: 0.4 });
    await runPasses(page, 1);
    await expect(page.getByRole("button", { name: /Run/ })).toBeInViewport({ ratio: 1 });
    expect(await faults(page)).toEqual([]);
    expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth)).toBe(
      true,
    );
  });
}

test("in forced colours what is chosen looks different from what is not", async ({ page }) => {
  await page.emulateMedia({ forcedColors: "active" });
  await open(page);
  await page
    .getByRole("button", { name: /^Curve 1/ })
    .first()
    .click();
  const differ = (chosen: string, other: string) =>
    page.evaluate(
      ([chosen, other]) => {
        const look = (selector: string) => {
          const element = document.querySelector(selector);
          if (!element) return null;
          const { backgroundColor, color, outlineStyle } = getComputedStyle(element);
          return [backgroundColor, color, outlineStyle].join();
        };
        const [one, two] = [look(chosen!), look(other!)];
        return one !== null && two !== null && one !== two;
      },
      [chosen, other],
    );
  // Panels follow a frame later.
  for (const [chosen, other] of [
    [".tools label:has(:checked)", ".tools label:not(:has(:checked))"],
    ["#views input:checked + span", "#views input:not(:checked) + span"],
    [".region.selected", ".region:not(.selected)"],
    ["[role=tab][aria-selected=true]", "[aria-selected=false]"],
  ] as const) {
    await expect.poll(() => differ(chosen, other), { message: chosen }).toBe(true);
  }
});
