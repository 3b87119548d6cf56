/** Whatever holds two moments: clips, animations, piles of pictures, two views in one file; and what nobody opens. */

import AxeBuilder from "@axe-core/playwright";
import type { Page } from "@playwright/test";

import type { State } from "../../www/store";
import {
  apng,
  clip,
  gif,
  matroska,
  moments,
  mp4,
  mpo,
  numberOn,
  photo,
  still,
  webp,
} from "./films";
import {
  chooseView,
  expect,
  inOpen,
  inResult,
  inSettings,
  PATIENCE,
  png,
  read,
  ready,
  solve,
  test,
  until,
} from "./helpers";

const any = (page: Page) => page.locator("#film-file");
const strip = (page: Page) => page.locator("#filmstrip");
const status = (page: Page) => strip(page).locator(".sheet-status");
const slider = (page: Page, name: string) => page.getByRole("slider", { name });
const file = (name: string, mimeType: string, buffer: Buffer) => ({ name, mimeType, buffer });

/** Waits until the motion between the two has been measured, and reads which frames are marked. */
async function marked(page: Page): Promise<[number, number]> {
  await expect(status(page)).toContainText(
    /fastest objects|Nothing moves|Too much|differ in size/,
    {
      timeout: PATIENCE,
    },
  );
  const value = (name: string) => slider(page, name).inputValue();
  return [Number(await value("First frame")), Number(await value("Second frame"))];
}

/** What the two large pictures show, once they have been drawn. */
async function seen(page: Page): Promise<[number, number]> {
  const numbers: number[] = [];
  for (const side of [0, 1]) {
    const view = `.film-view:nth-child(${side + 1})`;
    const index = await page.locator(`${view} input[type=range]`).inputValue();
    await expect(page.locator(`${view} canvas[data-shown="${index}"]`)).toHaveCount(1);
    numbers.push(await numberOn(page, `${view} canvas`));
  }
  return [numbers[0]!, numbers[1]!];
}

async function faults(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).analyze();
  return violations
    .filter(({ impact }) => impact === "serious" || impact === "critical")
    .map(({ id, nodes }) => `${id}: ${nodes.map((node) => node.target.join(" ")).join(", ")}`);
}

async function openThese(page: Page): Promise<void> {
  await page.getByRole("button", { name: "Open these two" }).click();
  await until(page, (state) => state.source?.kind === "files" && state.busy === null);
  await expect(strip(page)).toHaveCount(0);
}

/** Which of the test's frames are open, read off the page's pictures of them. */
const openNumbers = (page: Page) =>
  page.evaluate(() => {
    const { frames } = (window as unknown as { relievo: State }).relievo;
    return frames!.map((frame) => {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [frame.width, frame.height];
      const context = canvas.getContext("2d")!;
      context.drawImage(frame, 0, 0);
      let number = 0;
      for (let bit = 0; bit < 6; bit++) {
        // The tenth part of a row each.
        const x = Math.floor((frame.width / 10) * (bit + 0.5));
        if (context.getImageData(x, frame.height / 20, 1, 1).data[0]! > 127) number |= 1 << bit;
      }
      return number;
    });
  });

test("a clip opens as a filmstrip with a second frame proposed, goes frame by frame, and on to the next pair", async ({
  opened: page,
}) => {
  const recorded = await clip(page, moments(16, 1));
  await any(page).setInputFiles(file("walk.webm", "video/webm", recorded));
  await expect(strip(page)).toContainText("walk.webm");
  const [first, second] = await marked(page);
  expect(first).toBe(0);
  // One pixel a frame is too little on 160: a few frames on it is enough.
  expect(second).toBeGreaterThan(1);
  await expect(status(page)).toContainText("enough to see depth");
  const [one, two] = await seen(page);
  expect(two - one).toBeGreaterThan(1);
  expect(await faults(page)).toEqual([]);

  // Single steps, by button and by key, show the very next frame.
  await page.getByRole("button", { name: "Second frame: one later" }).click();
  expect(await seen(page)).toEqual([one, two + 1]);
  await page.keyboard.press(",");
  expect(await seen(page)).toEqual([one, two]);
  await page.keyboard.press("1");
  await page.keyboard.press(".");
  expect(await seen(page)).toEqual([one + 1, two]);

  await openThese(page);
  expect(await openNumbers(page)).toEqual([one + 1, two]);
  await expect(page.locator("#lesson")).toContainText("From walk.webm");
  await expect(page.getByRole("button", { name: "Next pair" })).toBeHidden();
  await page.getByRole("button", { name: "Find curves" }).click();
  await until(page, (state) => state.shapes.length > 0 && state.busy === null);
  await solve(page);
  const before = await read(page, (state) => state.report!.iterations);
  const left = () =>
    read(page, (state) => {
      const [curve] = state.shapes;
      if (curve?.kind !== "polygon") throw new Error("no polygon");
      return Math.min(...curve.points.map(([x]) => x));
    });
  await page.getByRole("button", { name: "Next pair" }).click();
  await until(page, (state) => !state.running && state.busy === null && state.report !== null);
  expect(await openNumbers(page)).toEqual([two, two + (two - one - 1)]);
  // From where the last pair ended, not from the start: the pass count goes on.
  expect(await read(page, (state) => state.report!.iterations)).toBeGreaterThan(before);
  expect(await read(page, (state) => state.report!.status)).not.toBe("running");
  expect(await left()).toBeGreaterThan(38 + two);
  // Back at the start means: where the curve was carried to.
  await page.getByRole("button", { name: "Reset" }).click();
  await until(page, (state) => !state.started);
  const contour = await read(page, (state) =>
    Math.min(
      ...state.contours
        .filter((c) => c.label === 1)
        .flatMap((c) => c.points.filter((_, i) => i % 2 === 0)),
    ),
  );
  expect(Math.abs(contour - (await left()))).toBeLessThan(3);
});

test("a clip opens where the browser lends no decoder", async ({ opened: page }) => {
  const recorded = await clip(page, moments(8, 4));
  await page.evaluate(() => Reflect.deleteProperty(window, "VideoDecoder"));
  await any(page).setInputFiles(file("walk.webm", "video/webm", recorded));
  const [, second] = await marked(page);
  expect(second).toBe(1);
  const [one, two] = await seen(page);
  expect(two).toBe(one + 1);
  await openThese(page);
  expect(await openNumbers(page)).toEqual([one, two]);
});

test.describe("under the page's policy", () => {
  test.use({ bypassCSP: false });

  test("a clip opens, decoded or played", async ({ opened: page }) => {
    const recorded = file("walk.webm", "video/webm", await clip(page, moments(6, 4)));
    const shown = async () => {
      await any(page).setInputFiles(recorded);
      await marked(page);
      await expect(page.locator(".film-view canvas[data-shown]")).toHaveCount(2);
      await page.getByRole("button", { name: "Cancel" }).click();
    };
    await shown();
    await page.evaluate(() => Reflect.deleteProperty(window, "VideoDecoder"));
    await shown();
  });
});

test("an MP4 opens like any clip", async ({ opened: page }) => {
  const recorded = await mp4(await clip(page, moments(8, 4), "video/webm;codecs=vp9"));
  await any(page).setInputFiles(file("walk.mp4", "video/mp4", recorded));
  await marked(page);
  const [one, two] = await seen(page);
  expect(two).toBe(one + 1);
});

test("a codec that the browser does not play is named", async ({ opened: page }) => {
  const film = matroska("V_PRORES");
  await any(page).setInputFiles(file("old.mkv", "video/x-matroska", film));
  const message = page.locator("#message");
  const patient = { timeout: PATIENCE };
  await expect(message).toContainText(
    /old\.mkv is encoded as Apple ProRes, which.*convert it/,
    patient,
  );
  const box = Buffer.from("\0\0\0\x14ftypqt  \0\0\0\0qt  \0\0\0\x08mdat", "latin1");
  await any(page).setInputFiles(file("cut.mov", "video/quicktime", box));
  await expect(message).toContainText(/cut\.mov is of the kind MOV/, patient);
  const avi = Buffer.from("RIFF\0\0\0\0AVI LIST", "latin1");
  await any(page).setInputFiles(file("old.avi", "video/avi", avi));
  await expect(message).toContainText(/old\.avi is of the kind AVI/, patient);
  await ready(page);
  expect(await read(page, (state) => state.source?.kind)).toBe("scene");
});

for (const [name, make] of [
  ["GIF", async (_: Page) => gif(moments(5))],
  ["PNG", async (_: Page) => apng(moments(5))],
  ["WebP", (page: Page) => webp(page, moments(5))],
] as const) {
  test(`an animated ${name} opens as a filmstrip`, async ({ opened: page }) => {
    const type = `image/${name.toLowerCase()}`;
    await any(page).setInputFiles(file(`turn.${name.toLowerCase()}`, type, await make(page)));
    expect(await marked(page)).toEqual([0, 1]);
    await slider(page, "Second frame").fill("4");
    await expect(status(page)).toContainText(/fastest objects|Too much/);
    expect(await seen(page)).toEqual([0, 4]);
    await openThese(page);
    expect(await openNumbers(page)).toEqual([0, 4]);
  });
}

test("a still GIF is a picture, through the browser", async ({ opened: page }) => {
  const [one, two] = moments(2);
  await page.locator("#file-0").setInputFiles(file("a.gif", "image/gif", gif([one!])));
  await expect(page.locator("#slots-note")).toContainText("second frame is still missing");
  await page.locator("#file-1").setInputFiles(png("b.png", apng([two!])));
  await until(page, (state) => state.source?.kind === "files" && state.busy === null);
  expect(await openNumbers(page)).toEqual([0, 1]);
});

test("a format that nobody here opens is named", async ({ opened: page }) => {
  for (const [name, head, says] of [
    ["a.heic", "\0\0\0\x18ftypheic\0\0\0\0mif1heic", /a\.heic is a HEIC file.*save it as JPEG/],
    ["a.avif", "\0\0\0\x18ftypavif\0\0\0\0mif1avif", /a\.avif is an AVIF file/],
    ["a.jxl", "\xff\x0a\0\0", /JPEG XL/],
    ["a.cr3", "\0\0\0\x18ftypcrx \0\0\0\x01crx isom", /Canon raw/],
  ] as const) {
    await page.locator("#file-0").setInputFiles(file(name, "", Buffer.from(head, "latin1")));
    await expect(page.locator("#message")).toContainText(says);
  }
});

test("two views in one file are a pair, and said to be one; a gain map is no view", async ({
  opened: page,
}) => {
  const [one, two] = moments(2);
  const pair = await mpo(page, [one!, two!]);
  await any(page).setInputFiles(file("stereo.mpo", "", pair));
  await until(page, (state) => state.source?.kind === "files" && state.busy === null);
  expect(await openNumbers(page)).toEqual([0, 1]);
  await expect(page.locator("#lesson")).toContainText("The two views of stereo.mpo");
  const photo = await mpo(page, [one!, two!], "http://ns.adobe.com/xap/1.0/\0hdrgm:Version");
  await any(page).setInputFiles(file("phone.jpg", "image/jpeg", photo));
  await expect(page.locator("#slots-note")).toContainText("second frame is still missing");
});

test("an interlaced frame is said to be one, and its two fields open as a pair", async ({
  opened: page,
}) => {
  const woven = moments(3, 3).map((even, n, all) => {
    const odd = all[(n + 1) % 3]!;
    const row = (y: number) => (y % 2 === 0 ? even : odd).data.subarray(160 * y, 160 * (y + 1));
    const data = new Uint8Array(even.data.length);
    for (let y = 0; y < even.height; y++) data.set(row(y), 160 * y);
    return { ...even, data };
  });
  const [one, two] = await Promise.all(woven.map((frame) => still(page, frame)));
  await any(page).setInputFiles(png("tape.png", one!));
  const note = page.locator("#slots-note");
  await expect(note).toContainText("tape.png seems to be interlaced");
  await page.getByRole("button", { name: "Open its two fields" }).click();
  await until(page, (state) => state.source?.kind === "files" && state.busy === null);
  expect(await read(page, (state) => [state.width, state.height])).toEqual([80, 60]);
  expect(await openNumbers(page)).toEqual([0, 1]);
  await expect(page.locator("#lesson")).toContainText("The two fields of tape.png");

  // Of a pair, what is warned of can be mended in place, also after a reload.
  await any(page).setInputFiles([png("a.png", one!), png("b.png", two!)]);
  await until(page, (state) => state.width === 160 && state.busy === null);
  await solve(page);
  const result = await inResult(page);
  await expect(result.locator("#warnings")).toContainText("interlaced");
  await until(page, ({ memory }) => !!memory?.some(({ resultBytes }) => resultBytes > 0));
  await page.reload();
  await until(page, ({ frames, busy, started }) => frames !== null && busy === null && started);
  await (await inResult(page)).getByRole("button", { name: "Open its two fields" }).click();
  await until(page, (state) => state.width === 80 && state.busy === null);
  expect(await openNumbers(page)).toEqual([0, 1]);
});

test("a new pair opens on its frames, whatever was looked at before", async ({ opened: page }) => {
  await solve(page);
  await chooseView(page, "Anaglyph");
  const files = await Promise.all(moments(2).map((view) => still(page, view)));
  await any(page).setInputFiles(files.map((data, i) => png(`n${i}.png`, data)));
  await until(page, (state) => state.source?.kind === "files" && state.busy === null);
  await expect(page.getByRole("radio", { name: "Outlines", exact: true })).toBeChecked();
  // Swapped it is the same pair, looked at in the same way.
  await chooseView(page, "Depth");
  await (await inOpen(page)).getByRole("button", { name: "Swap the two frames" }).click();
  await until(page, ({ names, busy }) => names[0] === "n1.png" && busy === null);
  await expect(page.getByRole("radio", { name: "Depth", exact: true })).toBeChecked();
});

test("photos bring the focal length that they were taken with", async ({ opened: page }) => {
  const photos = await Promise.all(moments(2).map((view) => photo(page, view, 72)));
  await any(page).setInputFiles(photos.map((data, i) => file(`p${i}.jpg`, "image/jpeg", data)));
  await until(page, (state) => state.source?.kind === "files" && state.busy === null);
  // 35 mm film is 36 mm wide, the frame 160 pixels.
  expect(await read(page, (state) => state.camera.focal)).toBe(320);
  const settings = await inSettings(page);
  await expect(settings.locator("#camera")).toContainText("f is from EXIF: 72 mm on 35 mm film.");
  await expect(page.locator("#lesson")).toContainText("f is from EXIF: 72 mm on 35 mm film.");
});

test("faint frames are shown with their levels stretched", async ({ opened: page }) => {
  const faint = moments(2).map(({ data, ...size }) => ({
    ...size,
    data: data.map((grey) => 3 + grey / 16),
  }));
  const files = await Promise.all(faint.map((view) => still(page, view)));
  await any(page).setInputFiles(files.map((data, i) => file(`f${i}.png`, "image/png", data)));
  await until(page, (state) => state.source?.kind === "files" && state.busy === null);
  // Black and white squares along the top say the frame's number.
  expect(await openNumbers(page)).toEqual([0, 1]);
});

test("three pictures dropped at once are a filmstrip in the order of their names", async ({
  opened: page,
}) => {
  const files = moments(12, 2).map((frame, i) => ({
    name: `img${i}.png`,
    text: apng([frame]).toString("base64"),
  }));
  await page.evaluate((files) => {
    const data = new DataTransfer();
    for (const { name, text } of files.toReversed()) {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      data.items.add(new File([bytes], name, { type: "image/png" }));
    }
    document.body.dispatchEvent(
      new DragEvent("drop", { dataTransfer: data, bubbles: true, cancelable: true }),
    );
  }, files);
  await expect(strip(page)).toContainText("12 pictures");
  await marked(page);
  // By a click on its picture.
  await page.getByRole("radio", { name: /Second frame/ }).check();
  await strip(page)
    .getByRole("button", { name: /^Frame 6, img5\.png/ })
    .click();
  expect(await seen(page)).toEqual([0, 5]);
  await openThese(page);
  expect(await read(page, (state) => state.names)).toEqual(["img0.png", "img5.png"]);
  // The film stays at hand, at the frames that were chosen.
  await (await inOpen(page)).getByRole("button", { name: "Other frames…" }).click();
  expect(await marked(page)).toEqual([0, 5]);
  await page.keyboard.press("Escape");
  await expect(strip(page)).toHaveCount(0);
  // What opened it has closed: its own button opens that again.
  await expect(page.getByRole("button", { name: "Open", exact: true })).toBeFocused();
});

test("what is wrong with two frames is said in the filmstrip, which stays open", async ({
  opened: page,
}) => {
  const [one] = moments(1);
  const still = apng([one!]);
  await any(page).setInputFiles([1, 2, 3].map((i) => png(`same${i}.png`, still)));
  await expect(status(page)).toContainText("Nothing moves");
  await page.getByRole("button", { name: "Open these two" }).click();
  await expect(strip(page).getByRole("alert")).toContainText("identical");
  expect(await faults(page)).toEqual([]);
  await slider(page, "Second frame").fill("0");
  await expect(page.getByRole("button", { name: "Open these two" })).toBeDisabled();
  await expect(status(page)).toContainText("the same frame");
});

test("a clip among other files is refused whole, and nothing is taken in silence", async ({
  opened: page,
}) => {
  const [one] = moments(1);
  await any(page).setInputFiles([
    png("a.png", apng([one!])),
    file("turn.gif", "image/gif", gif(moments(3))),
  ]);
  await expect(page.locator("#message")).toContainText("turn.gif holds many frames");
  expect(await read(page, (state) => state.slots)).toEqual([null, null]);
});

test("a pair that is replaced one file at a time waits for the second", async ({
  opened: page,
}) => {
  const own = (picture: ReturnType<typeof moments>[number]) => apng([picture]);
  const [a, b] = moments(2);
  const [c, d] = moments(2, 4, 200, 120);
  await page.locator("#file-0").setInputFiles([png("a.png", own(a!)), png("b.png", own(b!))]);
  await until(page, (state) => state.source?.kind === "files" && state.busy === null);
  await page.locator("#file-0").setInputFiles(png("c.png", own(c!)));
  await expect(page.locator("#slots-note")).toContainText("second frame is still missing");
  await ready(page);
  await expect(page.locator("#message")).toBeHidden();
  expect(await read(page, (state) => state.names)).toEqual(["a.png", "b.png"]);
  await page.locator("#file-1").setInputFiles(png("d.png", own(d!)));
  await until(page, (state) => state.names[0] === "c.png" && state.busy === null);
  expect(await read(page, (state) => state.width)).toBe(200);
});

test.describe("on a phone", () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true });

  test("the filmstrip fits, with everything in reach", async ({ opened: page }) => {
    await any(page).setInputFiles(file("turn.gif", "image/gif", gif(moments(20))));
    await marked(page);
    expect(await page.evaluate(() => document.documentElement.scrollWidth <= innerWidth)).toBe(
      true,
    );
    await expect(page.getByRole("button", { name: "Open these two" })).toBeInViewport({ ratio: 1 });
    const small = await strip(page).evaluate((dialog) =>
      [...dialog.querySelectorAll("button:not(.film-strip *), input[type=range]")]
        .filter((element) => element.getBoundingClientRect().height < 43.5)
        .map((element) => element.textContent),
    );
    expect(small).toEqual([]);
    expect(await faults(page)).toEqual([]);
  });
});
