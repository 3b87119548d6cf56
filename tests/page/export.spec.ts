/** Everything that can be taken away: that it is what it says, at the frame's size, and opens again. */

import { readFile } from "node:fs/promises";

import AxeBuilder from "@axe-core/playwright";
import type { Page } from "@playwright/test";
import { strFromU8, unzipSync } from "fflate";
import { ALL_FORMATS, BufferSource, EncodedPacketSink, Input } from "mediabunny";

import { chooseView, expect, inExport, open, read, solve, test, until } from "./helpers";

/** Presses a button of the dialog and reads what is saved. */
async function taken(page: Page, name: string): Promise<{ name: string; bytes: Buffer }> {
  const press = page.getByRole("button", { name, exact: true });
  const [download] = await Promise.all([page.waitForEvent("download"), press.click()]);
  return { name: download.suggestedFilename(), bytes: await readFile(await download.path()) };
}

/** Bits a pixel, width and height of a PNG. */
const png = (bytes: Uint8Array) => {
  const view = new DataView(bytes.buffer, bytes.byteOffset);
  return { width: view.getUint32(16), height: view.getUint32(20), bits: bytes[24] };
};

/** The JSON of a GLB and its numbers. */
function glb(bytes: Uint8Array) {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.length);
  expect(strFromU8(bytes.subarray(0, 4))).toBe("glTF");
  expect(view.getUint32(8, true)).toBe(bytes.length);
  const length = view.getUint32(12, true);
  const binary = bytes.subarray(20 + length + 8);
  expect(view.getUint32(20 + length, true)).toBe(binary.length);
  return { json: JSON.parse(strFromU8(bytes.subarray(20, 20 + length))), binary };
}

async function faults(page: Page): Promise<string[]> {
  const { violations } = await new AxeBuilder({ page }).include("#export-sheet").analyze();
  return violations.map(({ id, nodes }) => `${id}: ${nodes.map(({ target }) => target).join()}`);
}

test("all that a solve has found can be taken away, one by one and as one zip", async ({
  opened: page,
}) => {
  // Without a result there is nothing but the frames and the curves.
  await inExport(page);
  const all = page.getByRole("button", { name: "Everything as one zip" });
  await expect(all).toBeDisabled();
  await expect(page.getByRole("note")).toHaveText(/^Run the solver first/);
  await page.keyboard.press("Escape");
  await expect(page.getByRole("button", { name: "Export", exact: true })).toBeFocused();

  await solve(page);
  await chooseView(page, "Depth");
  const { width, height, passes, regions } = await read(page, (state) => ({
    width: state.width,
    height: state.height,
    passes: state.timeline!.lines[0]!.passes.length,
    regions: state.shapes.length + 1,
  }));
  await inExport(page);
  await expect(page.getByRole("note")).toBeHidden();
  expect(await faults(page)).toEqual([]);

  // The picture offered first is of the view that was left.
  const depth = await taken(page, "Any view: PNG");
  expect(depth.name).toBe("relievo-blocks-depth.png");
  expect(png(depth.bytes)).toMatchObject({ width, height });

  const zip = await taken(page, "Everything as one zip");
  expect(zip.name).toBe("relievo-blocks.zip");
  const files = unzipSync(zip.bytes);
  const file = (name: string): Uint8Array => {
    expect(Object.keys(files)).toContain(name);
    return files[name]!;
  };

  // Every view has the frame's size, a stereo pair its double.
  const pictures = Object.keys(files).filter((name) => name.startsWith("pictures/"));
  expect(pictures.length).toBeGreaterThanOrEqual(12);
  for (const name of pictures) {
    const wide = name.endsWith("stereo.png") ? 2 * width : width;
    expect({ name, ...png(file(name)) }).toMatchObject({ name, width: wide, height });
  }
  expect(png(file("labels.png"))).toEqual({ width, height, bits: 8 });
  expect(png(file("occlusion.png"))).toEqual({ width, height, bits: 8 });
  expect(png(file("depth16.png"))).toEqual({ width, height, bits: 16 });
  expect(strFromU8(file("depth.pfm").subarray(0, 30))).toContain(`Pf\n${width} ${height}\n`);
  const flow = file("flow.flo");
  expect(flow.length).toBe(12 + 8 * width * height);
  const motion = JSON.parse(strFromU8(file("motion.json")));
  expect(motion.regions).toHaveLength(regions);
  expect(motion.depth_scale).toBeGreaterThan(0);
  expect(strFromU8(file("README.txt"))).toContain("depth_scale");
  expect(strFromU8(file("cite.bib"))).toMatch(/Sekkati.*@software\{relievo/s);

  // The relief opens again: triangles on their vertices, in their box, under the frame.
  const { json, binary } = glb(file("relief.glb"));
  const [mesh] = json.meshes;
  for (const { attributes, indices } of mesh.primitives) {
    const places = json.accessors[attributes.POSITION];
    const list = json.accessors[indices];
    expect(Math.min(...places.min)).toBeGreaterThan(-4);
    expect(Math.max(...places.max)).toBeLessThan(4);
    const { byteOffset, byteLength } = json.bufferViews[list.bufferView];
    const numbers = new Uint32Array(binary.slice(byteOffset, byteOffset + byteLength).buffer);
    expect(numbers.length).toBe(list.count);
    expect(numbers.reduce((a, b) => Math.max(a, b), 0)).toBeLessThan(places.count);
  }
  const image = json.bufferViews[json.images[0].bufferView];
  expect(png(binary.subarray(image.byteOffset))).toMatchObject({ width, height });
  expect(strFromU8(file("relief.ply").subarray(0, 4))).toBe("ply\n");

  // The film shows the start and each pass once, and the last again.
  const input = new Input({
    source: new BufferSource(file("solve.webm")),
    formats: ALL_FORMATS,
  });
  const track = (await input.getPrimaryVideoTrack())!;
  let shown = 0;
  for await (const _ of new EncodedPacketSink(track).packets()) shown += 1;
  expect(shown).toBe(passes + 2);
  expect(await input.computeDuration()).toBeGreaterThan(3);
  await expect(page.locator("#export-sheet .sheet-status")).toHaveText(
    /^relievo-blocks\.zip saved/,
  );
});

test.describe("on a phone", () => {
  test.use({ viewport: { width: 390, height: 844 }, hasTouch: true });

  test("the dialog fits, is reached by keyboard, and its citation can be copied", async ({
    page,
    context,
  }) => {
    await context.grantPermissions(["clipboard-read", "clipboard-write"]);
    await page.emulateMedia({ colorScheme: "dark", forcedColors: "active" });
    await open(page);
    await until(page, ({ catalogues }) => catalogues !== null);
    await page.getByRole("button", { name: "Export", exact: true }).focus();
    await page.keyboard.press("Enter");
    const sheet = page.getByRole("dialog", { name: "Export" });
    await expect(sheet).toBeVisible();
    expect(await faults(page)).toEqual([]);
    const wide = await sheet.evaluate((it) =>
      [it, ...it.querySelectorAll<HTMLElement>(".sheet-body, .export-row")]
        .filter((part) => part.scrollWidth > part.clientWidth + 1)
        .map((part) => part.className),
    );
    expect(wide, "parts that stick out").toEqual([]);
    await expect(sheet.getByRole("button", { name: "Everything as one zip" })).toBeInViewport();
    await page.getByRole("button", { name: "The method: Copy BibTeX" }).click();
    await expect(sheet.getByRole("status")).toHaveText("BibTeX copied.");
    expect(await page.evaluate(() => navigator.clipboard.readText())).toMatch(/^@article\{sekkati/);
  });
});
