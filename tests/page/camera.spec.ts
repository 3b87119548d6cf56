/** The camera, as far as a machine without one can tell: Chromium lends a make-believe one. */

import AxeBuilder from "@axe-core/playwright";

import { chromiumFlags, findChromium } from "../../scripts/chromium.js";
import { expect, PATIENCE, read, test, until, inOpen } from "./helpers";

test.use({
  launchOptions: {
    executablePath: findChromium(),
    args: [
      ...chromiumFlags,
      "--use-fake-device-for-media-stream",
      "--use-fake-ui-for-media-stream",
    ],
  },
});

test("nobody is asked for the camera before they want it", async ({ page }) => {
  await page.addInitScript(() => {
    const { mediaDevices } = navigator;
    const ask = mediaDevices.getUserMedia.bind(mediaDevices);
    Object.assign(window, { asked: 0 });
    mediaDevices.getUserMedia = (wishes) => {
      Object.assign(window, { asked: (window as unknown as { asked: number }).asked + 1 });
      return ask(wishes);
    };
  });
  await page.goto("./");
  await until(page, (state) => state.frames !== null && state.busy === null);
  const asked = () => page.evaluate(() => (window as unknown as { asked: number }).asked);
  expect(await asked()).toBe(0);
  await (await inOpen(page)).getByRole("button", { name: "Camera…" }).click();
  await expect(page.locator("#camera-sheet")).toContainText("Ready for the first shot");
  expect(await asked()).toBe(1);
});

test("two shots go to the filmstrip and open as a pair; the camera is let go", async ({
  opened: page,
}) => {
  await (await inOpen(page)).getByRole("button", { name: "Camera…" }).click();
  const sheet = page.locator("#camera-sheet");
  const shot = page.getByRole("button", { name: "Take a shot" });
  await expect(shot).toBeEnabled({ timeout: PATIENCE });
  const { violations } = await new AxeBuilder({ page }).analyze();
  expect(violations.filter(({ impact }) => impact === "serious" || impact === "critical")).toEqual(
    [],
  );
  const track = await page.locator("#camera-sheet video").evaluateHandle((video) => {
    const stream = (video as HTMLVideoElement).srcObject as MediaStream;
    return stream.getVideoTracks()[0]!;
  });
  await shot.click();
  await expect(sheet).toContainText("then take the second");
  await page.waitForTimeout(300);
  await shot.click();
  await expect(page.locator("#filmstrip")).toContainText("the camera's shots");
  expect(await track.evaluate((track) => track.readyState)).toBe("ended");
  await expect(page.locator("#filmstrip .sheet-status")).toContainText(/fastest|Too much|Nothing/, {
    timeout: PATIENCE,
  });
  await page.getByRole("button", { name: "Open these two" }).click();
  await until(page, (state) => state.source?.kind === "files" && state.busy === null);
  expect(await read(page, (state) => state.names[0])).toContain("first shot");
});

test("one press takes several, of which two are proposed", async ({ opened: page }) => {
  await (await inOpen(page)).getByRole("button", { name: "Camera…" }).click();
  const several = page.getByRole("button", { name: "Take several" });
  await expect(several).toBeEnabled({ timeout: PATIENCE });
  await several.click();
  await expect(page.locator("#filmstrip")).toContainText("1 of 12", { timeout: PATIENCE });
  await expect(page.locator("#filmstrip .sheet-status")).toContainText(/fastest|Too much|Nothing/, {
    timeout: PATIENCE,
  });
  const second = await page.getByRole("slider", { name: "Second frame" }).inputValue();
  expect(Number(second)).toBeGreaterThan(0);
});

test("why there is no picture is said in words", async ({ opened: page }) => {
  for (const [name, says] of [
    ["NotAllowedError", "not allowed to use the camera"],
    ["NotFoundError", "No camera was found"],
    ["NotReadableError", "Another program may be using it"],
  ] as const) {
    await page.evaluate((name) => {
      navigator.mediaDevices.getUserMedia = () => Promise.reject(new DOMException("no", name));
    }, name);
    await (await inOpen(page)).getByRole("button", { name: "Camera…" }).click();
    await expect(page.locator("#camera-sheet")).toContainText(says);
    await expect(page.getByRole("button", { name: "Take a shot" })).toBeDisabled();
    await page.getByRole("button", { name: "Cancel" }).click();
  }
});
