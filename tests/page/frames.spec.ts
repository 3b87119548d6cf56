/** Frames of one's own: by picker, drop and paste; and what is said when they are no good. */

import type { Page } from "@playwright/test";

import type { State } from "../../www/store";
import { Scene } from "../../cli/index.js";
import { walls } from "../walls.js";
import {
  chooseView,
  expect,
  framesOf,
  goesOn,
  look,
  PATIENCE,
  plainPng,
  png,
  read,
  ready,
  runPasses,
  solve,
  test,
  until,
  inOpen,
  inResult,
  inSettings,
  inTransport,
} from "./helpers";

const first = (page: Page) => page.locator("#file-0");
const second = (page: Page) => page.locator("#file-1");
const message = (page: Page) => page.locator("#message");

/** What must survive whatever was wrong with the input. */
const kept = (page: Page) =>
  read(page, ({ source, shapes, width, height, frames }) => ({
    name: source?.kind === "scene" ? source.name : "own",
    shapes,
    width,
    height,
    drawn: frames !== null && frames[0].width > 0,
  }));

const ownAreOpen = (page: Page) =>
  until(page, (state) => state.source?.kind === "files" && state.busy === null);

test("two frames are picked, first and second, and run", async ({ opened: page }) => {
  const [one, two] = await framesOf(page, "squares");
  await first(page).setInputFiles(png("left.png", one));
  await expect(page.locator("#slots-note")).toContainText("second frame is still missing");
  expect((await kept(page)).name).toBe("squares");
  await second(page).setInputFiles(png("right.png", two));
  await ownAreOpen(page);
  expect(await read(page, (state) => state.shapes)).toEqual([]);
  expect(await read(page, (state) => state.camera.focal)).toBe((await kept(page)).width);
  await expect((await inResult(page)).locator("#scores-panel")).toBeHidden();
  // A demonstration is for watching; one's own frames are for the result.
  await expect((await inTransport(page)).getByLabel("Pace")).toHaveValue("0");
  await (await inResult(page)).getByRole("button", { name: "Add a circle" }).click();
  await runPasses(page, 2);
  expect(await read(page, (state) => state.report!.regions.length)).toBe(2);
});

test("truth that comes with the frames is scored and mapped; of another size it is refused", async ({
  opened: page,
}) => {
  const file = (of: Scene) => (name: string) => ({
    name,
    mimeType: "application/octet-stream",
    buffer: Buffer.from(of.files().find((one) => one.name === name)!.bytes),
  });
  const [own, wide] = [file(new Scene("blocks", 96, 72)), file(new Scene("blocks", 112, 72))];
  await first(page).setInputFiles(["frame0.png", "frame1.png", "flow.flo"].map(own));
  await ownAreOpen(page);
  await until(page, (state) => state.truth !== null);
  expect(await read(page, (state) => state.truth)).toMatchObject({ flow: true, depth: false });
  await solve(page);
  const scores = (await inResult(page)).locator("#scores-panel");
  await expect(scores).toContainText(/AEE\d\.\d+ px/);
  await expect(scores).not.toContainText("IoU");
  // Labels after the frames, by the same way.
  await (await inOpen(page)).locator("#truth-file").setInputFiles([own("labels.png")]);
  await until(page, (state) => state.truth?.labels === true && state.truth.flow);
  await expect(page.locator("#slots-note")).toContainText("flow.flo, labels.png");
  await expect(scores).toContainText("IoU");
  await page.keyboard.press("Escape");
  await chooseView(page, "Error");
  await expect(page.locator("#legend")).toContainText(/Motion error.*px/);
  await page.locator("#setting-error").selectOption("Labels");
  await until(page, ({ pictured, pictures }) => pictured === "error error-labels" && !!pictures[0]);
  await expect(page.locator("#legend li")).toHaveText(["right", "wrong"]);
  // No curve was drawn: the blocks are wrong, the floor is right.
  expect((await look(page)).colours).toBeGreaterThanOrEqual(2);

  await (await inOpen(page)).locator("#truth-file").setInputFiles([wide("depth.pfm")]);
  await expect(message(page)).toContainText("truth is 112×72 pixels");
  await expect(message(page)).toContainText("the frames are 96×72");
  expect(await read(page, (state) => state.truth)).toMatchObject({ labels: true, depth: false });
});

test("two at once are ordered by name, and swapped on demand", async ({ opened: page }) => {
  const [one, two] = await framesOf(page, "squares");
  const before = await look(page);
  await first(page).setInputFiles([png("frame10.png", two), png("frame9.png", one)]);
  await ownAreOpen(page);
  expect(await read(page, (state) => state.names)).toEqual(["frame9.png", "frame10.png"]);
  // Without the curves that were drawn: compare the pictures alone.
  const opened = await look(page);
  expect(opened.print).toBe(before.print);
  await (await inResult(page)).getByRole("button", { name: "Add a circle" }).click();
  await (await inSettings(page)).getByLabel("Focal length f, px").fill("250");
  await (await inSettings(page)).getByLabel("Focal length f, px").press("Enter");
  await (await inOpen(page)).getByRole("button", { name: "Swap the two frames" }).click();
  await until(page, (state) => state.names[0] === "frame10.png" && state.busy === null);
  expect(await read(page, (state) => state.camera.focal)).toBe(250);
  // Focal length and circle are taken back one after the other.
  await page.getByRole("button", { name: "Undo" }).click();
  await until(page, (state) => state.camera.focal !== 250);
  await page.getByRole("button", { name: "Undo" }).click();
  await until(page, (state) => state.shapes.length === 0);
  expect((await look(page)).print).not.toBe(opened.print);
});

test("a sequence chosen while own frames are read is the one that opens; they can be used later", async ({
  opened: page,
}) => {
  const files = (await framesOf(page, "squares")).map((buffer) => buffer.toString("base64"));
  await page.evaluate((files) => {
    const data = new DataTransfer();
    for (const [i, text] of files.entries()) {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      data.items.add(new File([bytes], `f${i}.png`, { type: "image/png" }));
    }
    document.dispatchEvent(new ClipboardEvent("paste", { clipboardData: data }));
    const scene = document.getElementById("scene") as HTMLSelectElement;
    scene.value = "figure";
    scene.dispatchEvent(new Event("change"));
  }, files);
  await until(page, (state) => state.slots[1] !== null && state.busy === null);
  expect((await kept(page)).name).toBe("figure");
  await (await inOpen(page)).getByRole("button", { name: "Use them" }).click();
  await ownAreOpen(page);
});

test("while a sequence is being opened nothing runs, though a look for curves ends", async ({
  opened: page,
}) => {
  await page.evaluate(() => {
    const run = document.getElementById("run") as HTMLButtonElement;
    const scene = document.getElementById("scene") as HTMLSelectElement;
    const ready: string[] = [];
    Object.assign(window, { ready });
    new MutationObserver(
      () => run.disabled || ready.push((window as unknown as { relievo: State }).relievo.title),
    ).observe(run, {
      attributeFilter: ["disabled"],
    });
    document.getElementById("find")!.click();
    scene.value = "flight";
    scene.dispatchEvent(new Event("change"));
  });
  await until(page, ({ title, busy }) => title === "Flight over hills" && busy === null);
  const ready = await page.evaluate(() => (window as unknown as { ready: string[] }).ready);
  expect(ready).toEqual(["Flight over hills"]);
  expect(await read(page, (state) => state.shapes)).toEqual([]);
});

test("the list of sequences stays at the one chosen last", async ({ opened: page }) => {
  await page.evaluate(async () => {
    const scene = document.getElementById("scene") as HTMLSelectElement;
    const choose = (name: string) => {
      scene.value = name;
      scene.dispatchEvent(new Event("change"));
    };
    choose("squares");
    // The first is on its way to the worker by then.
    await new Promise((next) => setTimeout(next));
    choose("figure");
    const shown = new Set<string>();
    Object.assign(window, { shown });
    new MutationObserver(() => shown.add(scene.value)).observe(document.body, {
      childList: true,
      subtree: true,
    });
  });
  await until(page, ({ title, busy }) => title === "Toy bear" && busy === null);
  const shown = await page.evaluate(() => [...(window as unknown as { shown: string[] }).shown]);
  expect(shown).toEqual(["figure"]);
});

test("frames are dropped on the page", async ({ opened: page }) => {
  const [one, two] = await framesOf(page, "squares");
  const files = [one, two].map((buffer, i) => ({
    name: `f${i}.png`,
    text: buffer.toString("base64"),
  }));
  await page.evaluate((files) => {
    const data = new DataTransfer();
    for (const { name, text } of files) {
      const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
      data.items.add(new File([bytes], name, { type: "image/png" }));
    }
    const event = (type: string) =>
      document.body.dispatchEvent(
        new DragEvent(type, { dataTransfer: data, bubbles: true, cancelable: true, clientX: 300 }),
      );
    event("dragover");
    event("drop");
  }, files);
  await ownAreOpen(page);
  expect(await read(page, (state) => state.names)).toEqual(["f0.png", "f1.png"]);
  await expect(page.locator("#dropzone")).toBeHidden();
});

test("frames are pasted, one soon after the other", async ({ opened: page }) => {
  const [one, two] = await framesOf(page, "squares");
  const paste = (buffer: Buffer, name: string) =>
    page.evaluate(
      ({ text, name }) => {
        const data = new DataTransfer();
        const bytes = Uint8Array.from(atob(text), (letter) => letter.charCodeAt(0));
        data.items.add(new File([bytes], name, { type: "image/png" }));
        document.body.dispatchEvent(
          new ClipboardEvent("paste", { clipboardData: data, bubbles: true, cancelable: true }),
        );
      },
      { text: buffer.toString("base64"), name },
    );
  await paste(one, "a.png");
  await paste(two, "b.png");
  await ownAreOpen(page);
  expect(await read(page, (state) => state.names)).toEqual(["a.png", "b.png"]);
});

test("a file that has gone since it was chosen is said", async ({ opened: page }) => {
  await page.evaluate(() => {
    File.prototype.arrayBuffer = () => Promise.reject(new DOMException("gone", "NotFoundError"));
  });
  await first(page).setInputFiles([png("a.png", await plainPng(page, 64, 48, true))]);
  await expect(message(page)).toContainText("a.png cannot be read");
  expect(await read(page, (state) => state.slots)).toEqual([null, null]);
});

test("a pair that is refused leaves the run alone", async ({ opened: page }) => {
  const files = [await plainPng(page, 64, 48, true), await plainPng(page, 80, 48, true)];
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, (state) => (state.report?.iterations ?? 0) >= 1);
  await first(page).setInputFiles(files.map((buffer, i) => png(`f${i}.png`, buffer)));
  await expect(message(page)).toContainText("differ in size");
  await goesOn(page);
  expect(await read(page, (state) => state.running)).toBe(true);
});

test("bad input gets a sentence and changes nothing", async ({ opened: page }) => {
  await runPasses(page, 1);
  const before = await kept(page);
  const energy = await read(page, (state) => state.report!.energy.total);
  const cases: {
    name: string;
    says: RegExp;
    files: (page: Page) => Promise<[Buffer, Buffer]>;
  }[] = [
    {
      name: "frames of different sizes",
      says: /differ in size.*64×48.*80×48/,
      files: async (page) => [
        await plainPng(page, 64, 48, true),
        await plainPng(page, 80, 48, true),
      ],
    },
    {
      name: "the same frame twice",
      says: /identical/,
      files: async (page) => [
        await plainPng(page, 64, 48, true),
        await plainPng(page, 64, 48, true),
      ],
    },
    {
      name: "a frame without contrast",
      says: /same grey everywhere/,
      files: async (page) => [await plainPng(page, 64, 48), await plainPng(page, 64, 48, true)],
    },
    {
      name: "a frame too small",
      says: /8×8 pixels/,
      files: async (page) => [await plainPng(page, 8, 8, true), await plainPng(page, 8, 8)],
    },
    {
      name: "no image",
      says: /cannot be read as an image/,
      files: async (page) => [Buffer.from("Once upon a time"), await plainPng(page, 64, 48)],
    },
    {
      name: "a truncated file",
      says: /cannot be read as an image/,
      files: async (page) => {
        const whole = await plainPng(page, 64, 48, true);
        return [whole.subarray(0, whole.length / 2), whole];
      },
    },
    {
      name: "an empty file",
      says: /cannot be read as an image/,
      files: async (page) => [Buffer.alloc(0), await plainPng(page, 64, 48)],
    },
  ];
  for (const { name, says, files } of cases) {
    await test.step(name, async () => {
      const [one, two] = await files(page);
      await first(page).setInputFiles([png("a.png", one), png("b.png", two)]);
      await expect(message(page)).toContainText(says, { timeout: 60_000 });
      await until(page, (state) => state.busy === null);
      expect(await kept(page)).toEqual(before);
      expect(await read(page, (state) => state.report!.energy.total)).toBe(energy);
      await page.getByRole("button", { name: "Dismiss this message" }).click();
      await expect(message(page)).toBeHidden();
    });
  }
  await page.getByRole("button", { name: "Step" }).click();
  await until(page, (state) => state.report!.iterations >= 2);
});

test("of two files at once neither is taken when one is no image", async ({ opened: page }) => {
  const [one, two] = await framesOf(page, "squares");
  await first(page).setInputFiles([png("a1.png", one), png("a2.png", two)]);
  await ownAreOpen(page);
  const broken = Buffer.from("Once upon a time");
  for (const [b1, b2, culprit] of [
    [two, broken, "b2.png"],
    [broken, one, "b1.png"],
  ] as const) {
    await first(page).setInputFiles([png("b1.png", b1), png("b2.png", b2)]);
    await expect(message(page)).toContainText(culprit, { timeout: PATIENCE });
    await expect(page.locator("#slots-note")).toContainText("These are your frames");
    expect(await read(page, (state) => state.names)).toEqual(["a1.png", "a2.png"]);
  }
});

test("one frame only is said, kept waiting, and can be discarded", async ({ opened: page }) => {
  const [one] = await framesOf(page, "squares");
  await second(page).setInputFiles(png("late.png", one));
  await expect(page.locator("#slots-note")).toContainText("first frame is still missing");
  await runPasses(page, 1);
  await (await inOpen(page)).getByRole("button", { name: "Discard" }).click();
  expect(await read(page, (state) => state.slots)).toEqual([null, null]);
});

test("a focal length no camera has is refused and can be corrected", async ({ opened: page }) => {
  const field = (await inSettings(page)).getByLabel("Focal length f, px");
  const good = await field.inputValue();
  await field.fill("-5");
  await field.press("Enter");
  await expect(message(page)).toContainText("focal length is -5");
  await page.getByRole("button", { name: "Run" }).click();
  await until(page, (state) => !state.running);
  await expect(page.locator("#status")).toHaveText("Ready");
  expect(await read(page, (state) => state.shapes.length)).toBe(2);
  await field.fill(good);
  await field.press("Enter");
  await runPasses(page, 1);
  await expect(message(page)).toBeHidden();
});

test("focal length and field of view go together", async ({ opened: page }) => {
  const width = await read(page, (state) => state.width);
  await (await inSettings(page)).getByLabel("Field of view, °").fill("90");
  await (await inSettings(page)).getByLabel("Field of view, °").press("Enter");
  await until(page, (state) => Math.abs(state.camera.focal - state.width / 2) < 0.01);
  await (await inSettings(page)).getByLabel("Focal length f, px").fill(String(width));
  await (await inSettings(page)).getByLabel("Focal length f, px").press("Enter");
  await expect((await inSettings(page)).getByLabel("Field of view, °")).toHaveValue("53.1");
  for (const wrong of ["", "0", "200"]) {
    await (await inSettings(page)).getByLabel("Field of view, °").fill(wrong);
    await (await inSettings(page)).getByLabel("Field of view, °").press("Enter");
    await expect(message(page)).toContainText("between 0 and 180");
    expect(await read(page, (state) => state.camera.focal)).toBe(width);
    await page.locator("#message-close").click();
  }
});

test("what is wrong with a value stays said when the worker accepts the one before", async ({
  opened: page,
}) => {
  await page.evaluate(() => {
    const type = (id: string, value: string) => {
      const field = document.getElementById(id) as HTMLInputElement;
      field.value = value;
      field.dispatchEvent(new Event("change"));
    };
    type("focal", "300");
    type("fov", "200");
  });
  // The worker answers in turn, so that it has taken the focal length by now.
  await (await inSettings(page)).getByRole("button", { name: "Find f" }).click();
  await expect((await inSettings(page)).locator("#camera")).toContainText("do not determine f");
  await expect(message(page)).toContainText("between 0 and 180");
});

test("a focal length typed while one is looked for is kept", async ({ opened: page }) => {
  await page.evaluate(() => {
    document.getElementById("find-focal")!.click();
    const field = document.getElementById("focal") as HTMLInputElement;
    field.value = "555";
    field.dispatchEvent(new Event("change"));
  });
  await ready(page);
  await expect((await inSettings(page)).getByLabel("Focal length f, px")).toHaveValue("555");
  expect(await read(page, (state) => state.camera.focal)).toBe(555);
});

test("the focal length is found where the frames tell it, and kept where they do not", async ({
  opened: page,
}) => {
  test.slow();
  const find = (await inSettings(page)).getByRole("button", { name: "Find f" });
  const field = (await inSettings(page)).getByLabel("Focal length f, px");
  const usual = await field.inputValue();
  await find.click();
  await expect((await inSettings(page)).locator("#camera")).toContainText("do not determine f");
  expect(await field.inputValue()).toBe(usual);

  const [width, height, truth] = [240, 180, 3];
  const frames = ([0, 1] as const).map((t) => {
    const grey = walls(width, truth, t);
    const pixels = Array.from({ length: width * height }, (_, i) =>
      Math.round(grey(i % width, Math.floor(i / width))),
    );
    return Buffer.concat([Buffer.from(`P5\n${width} ${height}\n255\n`), Buffer.from(pixels)]);
  });
  await first(page).setInputFiles(
    frames.map((buffer, t) => ({
      name: `walls${t}.pgm`,
      mimeType: "image/x-portable-graymap",
      buffer,
    })),
  );
  await ownAreOpen(page);
  await expect((await inSettings(page)).locator("#camera")).not.toContainText("do not determine f");
  expect(await field.inputValue()).toBe(String(width));
  await find.click();
  await expect((await inSettings(page)).locator("#camera")).toContainText(
    "estimated from these frames",
    {
      timeout: PATIENCE,
    },
  );
  expect(Math.abs(Math.log(Number(await field.inputValue()) / (truth * width)))).toBeLessThan(0.4);
  await expect(message(page)).toBeHidden();
});
