/** How large pictures are drawn: there at once, then as sharp as the screen. */

import { sizeOf } from "../../www/worker/size";
import { expect, test } from "./helpers";

const photo = { width: 4000, height: 3000 };
const all = photo.width * photo.height;

/** Times that the core shrinks the photo for a size. */
const shrunk = (pixels: number) => {
  let n = 1;
  while (Math.floor(all / n ** 2) > pixels) n += 1;
  return n;
};

test("a small frame is drawn whole at once", () => {
  for (const kind of ["depth", "anaglyph", "labels", "error-flow"]) {
    const { pixels, blunt } = sizeOf({ width: 640, height: 480 }, kind, 512, true);
    expect(pixels).toBeGreaterThanOrEqual(640 * 480);
    expect(blunt).toBe(false);
  }
});

test("a photo is drawn small at first, then as large as the screen, however far it is zoomed", () => {
  for (const kind of ["depth", "anaglyph", "stereo", "residual"]) {
    const first = sizeOf(photo, kind, 2048, true);
    expect(first.blunt).toBe(true);
    expect(first.pixels).toBeLessThan(1e6);
    const then = sizeOf(photo, kind, 2048, false);
    expect(then.blunt).toBe(false);
    expect(photo.width / shrunk(then.pixels)).toBeGreaterThan((7 / 8) * 2048);
    const near = sizeOf(photo, kind, 16384, false);
    expect(shrunk(near.pixels)).toBe(2);
  }
});

test("nothing is drawn twice that is as sharp as the screen already", () => {
  const { pixels, blunt } = sizeOf(photo, "depth", 768, true);
  expect(blunt).toBe(false);
  expect(photo.width / shrunk(pixels)).toBeGreaterThan(672);
});
