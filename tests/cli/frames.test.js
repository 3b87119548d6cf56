// Frames as cameras and programs write them: one file for both, levels, EXIF data, any size; and scores of what there is.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { describe, test } from "node:test";

import {
  decodeAll,
  Frame,
  hornSchunck,
  SavedResult,
  Scene,
  Solver,
  Truth,
  workingSizes,
} from "../../cli/index.js";
import { chunk, file, folder, pgm, png, relievo, waves } from "./relievo.js";

const [WIDTH, HEIGHT] = [64, 48];
const ONCE = ["--iterations", "1"];
const moved = [0, 0.5, 1].map(waves);
const [first, second] = [0, 1].map((i) => file(`plain${i}.pgm`, pgm(WIDTH, HEIGHT, at(i))));

/** @param {number} i */
function at(i) {
  return moved[i] ?? waves(0);
}

/** @param {string} name */
const labels = (name) => readFileSync(join(folder, name, "labels.png"));

describe("one file for both frames", () => {
  const film = file("film.png", png(WIDTH, HEIGHT, moved));

  test("is an animation, whose first two frames are taken unless others are named", () => {
    const ran = relievo(film, "--focal", "64", ...ONCE, "--out", "film");
    assert.equal(ran.status, 0, ran.stderr);
    assert.match(ran.stdout, /^frames 1 and 2 of 3 in .*film\.png \(an animation\)$/m);
    const named = relievo(film, "--frames", "2,3", "--focal", "64", ...ONCE, "--out", "named");
    assert.match(named.stdout, /^frames 2 and 3 of 3/m);
    const wrong = relievo(film, "--frames", "1,4", "--focal", "64");
    assert.equal(wrong.status, 2);
    assert.match(wrong.stderr, /--frames 1,4: .* holds frames 1 to 3/);
  });

  test("is a list of frames in the package", () => {
    const all = decodeAll(readFileSync(film), "film.png");
    assert.deepEqual([all.count, all.kind, all.cut], [3, "animation", false]);
    assert.ok(Math.abs(all.seconds(1) - 0.04) < 1e-9);
    assert.deepEqual(all.frame(0).rgba(), Frame.decode(readFileSync(String(first)), "x").rgba());
    assert.equal(decodeAll(readFileSync(String(first)), "x").kind, "still");
  });

  test("may be interlaced: two fields of half its size", () => {
    const woven = (/** @type {number} */ x, /** @type {number} */ y) =>
      waves(3 * (y % 2))(x, y / 2);
    const path = file("woven.png", png(96, 80, [woven]));
    const hinted = relievo(path, "--focal", "96");
    assert.equal(hinted.status, 2);
    assert.match(hinted.stderr, /interlaced: take its two fields with --fields/);
    const ran = relievo(path, "--fields", "--focal", "48", ...ONCE, "--out", "fields");
    assert.equal(ran.status, 0, ran.stderr);
    assert.match(ran.stdout, /two fields of .*48×40 pixels/);
    assert.equal(Frame.decode(labels("fields"), "labels.png").width, 48);
  });
});

describe("levels of brightness", () => {
  const twelve = [0, 1].map((i) =>
    file(
      `twelve${i}.png`,
      png(WIDTH, HEIGHT, [(x, y) => 16 * Math.round(at(i)(x, y))], { bits: 16 }),
    ),
  );

  test("of 12 bits in 16 are stretched, said to be, and solved as the same picture of 8", () => {
    const words = ["--focal", "64", "--circle", "30,24,12"];
    const dark = relievo(...twelve, ...words, "--out", "dark");
    assert.equal(dark.status, 0, dark.stderr);
    assert.match(dark.stdout, /^note: .*use only \d\.\d % of the brightness range/m);
    const plain = relievo(String(first), String(second), ...words, "--out", "plain");
    assert.equal(plain.status, 0, plain.stderr);
    assert.doesNotMatch(plain.stdout, /range/);
    const { labels_wrong } = JSON.parse(relievo("score", "dark", "plain", "--json").stdout);
    assert.ok(labels_wrong < 0.003, String(labels_wrong));
  });

  test("are shown stretched", () => {
    const frame = Frame.decode(readFileSync(String(twelve[0])), "twelve.png");
    const brightest = (/** @type {Frame} */ one) =>
      one
        .rgba()
        .filter((_, i) => i % 4 < 3)
        .reduce((a, b) => Math.max(a, b), 0);
    assert.ok(brightest(frame) < 20);
    assert.ok(brightest(frame.stretched()) > 200);
    const other = Frame.decode(readFileSync(String(twelve[1])), "twelve.png");
    const solver = new Solver(frame, other, { focal: 64 }, [], {});
    assert.ok(brightest(solver.first()) > 200 && brightest(solver.second()) > 200);
    const { notes, warnings } = JSON.parse(solver.report());
    assert.deepEqual([notes.length, notes[0].kind, warnings.length], [1, "stretched", 1]);
  });
});

describe("EXIF data", () => {
  // One folder that points to another with the equivalent on 35 mm film.
  const exif = Buffer.from(
    "49492a0008000000010069870400010000001a00000000000000" +
      "010005a403000100000012000000" +
      "00000000",
    "hex",
  );
  const photos = [0, 1].map((i) =>
    file(`photo${i}.png`, png(WIDTH, HEIGHT, [at(i)], { chunks: [chunk("eXIf", exif)] })),
  );

  test("tell f, which is said, and used without being asked for", () => {
    for (const words of [[], ["--focal", "exif"]]) {
      const ran = relievo(...photos, ...words, ...ONCE, "--out", "photo");
      assert.equal(ran.status, 0, ran.stderr);
      assert.match(
        ran.stdout,
        /^focal length 32 pixels \(EXIF: 18 mm on 35 mm film\): --focal 32$/m,
      );
    }
    const lens = JSON.parse(Frame.decode(readFileSync(String(photos[0])), "photo.png").lens());
    assert.deepEqual([lens.focal, lens.source, lens.millimetres], [32, "film", 18]);
  });

  test("that tell none are said to", () => {
    const ran = relievo(String(first), String(second), "--focal", "exif");
    assert.equal(ran.status, 1);
    assert.match(ran.stderr, /EXIF data tell no focal length; give it in pixels/);
    assert.equal(Frame.decode(readFileSync(String(first)), "x").lens(), "null");
  });
});

test("results are of the frames' size and in their pixels at any detail", () => {
  const scene = new Scene("squares", 800, 600);
  const [camera, shapes] = [scene.cameraJson, scene.shapesJson];
  const solver = new Solver(scene.first(), scene.second(), camera, shapes, { detail: "fast" });
  const sizes = JSON.parse(workingSizes(4000, 3000, 1));
  assert.deepEqual(
    sizes.map((/** @type {any} */ size) => size.detail),
    ["fast", "normal", "fine", "full"],
  );
  for (const [i, size] of sizes.entries()) {
    const { width, height, seconds, bytes } = size;
    assert.ok(Math.abs(width / height - 4 / 3) < 0.01);
    if (i > 0) assert.ok(seconds > sizes[i - 1].seconds && bytes > sizes[i - 1].bytes);
  }
  while (solver.step() === "running");
  assert.equal(solver.labels().length, 800 * 600);
  const small = solver.view("depth", { pixels: 300_000 });
  assert.deepEqual([small.width, small.height], [400, 300]);
  const { found } = JSON.parse(
    solver.scores(Truth.ofScene(scene), hornSchunck(scene.first(), scene.second())),
  );
  assert.ok(found.labels_wrong < 0.01 && found.aee < 0.05);
});

describe("score", () => {
  /** KITTI's flow, which a file of one pixel more in u is compared with. */
  const kitti = (/** @type {number} */ shift) => {
    const [w, h] = [20, 16];
    const rows = Array.from({ length: h }, () => {
      const row = Buffer.alloc(6 * w);
      for (let x = 0; x < w; x += 1) {
        row.writeUInt16BE(32768 + 64 * shift, 6 * x);
        row.writeUInt16BE(32768, 6 * x + 2);
        row.writeUInt16BE(x > 3 ? 1 : 0, 6 * x + 4);
      }
      return row;
    });
    return { w, h, rows };
  };

  test("takes two files of flow, whatever their kind, and no labels", () => {
    const { w, h, rows } = kitti(2);
    const truth = file("truth.png", rgb16(w, h, rows));
    const flo = Buffer.alloc(12 + 8 * w * h);
    flo.write("PIEH", 0, "latin1");
    flo.writeInt32LE(w, 4);
    flo.writeInt32LE(h, 8);
    for (let i = 0; i < w * h; i += 1) flo.writeFloatLE(3, 12 + 8 * i);
    const found = file("found.flo", flo);
    const ran = relievo("score", found, truth, "--json");
    assert.equal(ran.status, 0, ran.stderr);
    const { aee, labels_wrong } = JSON.parse(ran.stdout);
    assert.deepEqual([aee, labels_wrong], [1, null]);
    assert.doesNotMatch(relievo("score", found, truth).stdout, /labels/);
    const none = relievo("score", found, String(first));
    assert.equal(none.status, 1);
    assert.throws(() => new SavedResult([]), { message: /nothing to score/ });
  });
});

/**
 * @param {number} width
 * @param {number} height
 * @param {Buffer[]} rows
 */
function rgb16(width, height, rows) {
  const grey = png(width * 3, height, [(x, y) => rows[y]?.readUInt16BE(2 * x) ?? 0], { bits: 16 });
  // The same rows, said to be colours.
  const header = Buffer.from(grey.subarray(16, 29));
  header.writeUInt32BE(width, 0);
  header[9] = 2;
  return Buffer.concat([grey.subarray(0, 8), chunk("IHDR", header), grey.subarray(33)]);
}
