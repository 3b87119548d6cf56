// relievo FRAME1 FRAME2: what it writes, and that every bad input gets a sentence.

import assert from "node:assert/strict";
import { existsSync, mkdirSync, readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { before, describe, test } from "node:test";

import { Frame } from "../../cli/index.js";
import { walls } from "../walls.js";
import { file, folder, pgm, relievo, waves } from "./relievo.js";

const [WIDTH, HEIGHT] = [64, 48];
const first = file("first.pgm", pgm(WIDTH, HEIGHT, waves(0)));
const second = file("second.pgm", pgm(WIDTH, HEIGHT, waves(0.5)));
const FOCAL = ["--focal", "64"];

describe("a solve", () => {
  const out = join(folder, "solved");
  const bytes = (/** @type {string} */ name) => readFileSync(join(out, name));
  /** @type {ReturnType<typeof relievo>} */
  let ran;

  before(() => {
    const curves = ["--circle", "20,24,8", "--polygon", "40,14,56,14,56,34,40,34"];
    ran = relievo(
      first,
      second,
      ...FOCAL,
      ...curves,
      "--iterations",
      "6",
      "--relief",
      "--out",
      out,
    );
  });

  test("succeeds, with a summary on stdout and nothing on stderr", () => {
    assert.equal(ran.stderr, "");
    assert.equal(ran.status, 0);
    assert.match(ran.stdout, /after [1-6] passes/);
    assert.match(ran.stdout, /background/);
    assert.match(ran.stdout, /^curve 2 .* (still|rotation|translation|full) +T /m);
  });

  test("writes data and pictures", () => {
    const names = readdirSync(out);
    const data = ["labels.png", "depth.pfm", "depth16.png", "flow.flo", "motion.json"];
    data.push("occlusion.png", "relief.glb", "relief.ply");
    const pictures = ["segmentation", "depth", "relief", "flow", "anaglyph", "confidence"];
    for (const name of [...data, ...pictures.map((picture) => `${picture}.png`)]) {
      assert.ok(names.includes(name), `${name} is missing`);
    }
    for (const name of names.filter((name) => name.endsWith(".png"))) {
      const frame = Frame.decode(bytes(name), name);
      assert.ok(frame.width >= WIDTH && frame.height >= HEIGHT, `${name} is a picture`);
    }
  });

  test("writes labels of one grey byte a pixel, one label for each curve", () => {
    const labels = bytes("labels.png");
    // Bit depth and colour type in PNG's header.
    assert.deepEqual([...labels.subarray(24, 26)], [8, 0]);
    const seen = new Set(labelsOf(labels));
    assert.ok([...seen].every((label) => label <= 2));
    assert.ok(seen.has(0));
  });

  test("writes depth above 0 whose inverse has mean 1 in each region, as T's unit says", () => {
    const depth = bytes("depth.pfm");
    const header = `Pf\n${WIDTH} ${HEIGHT}\n-1.0\n`;
    assert.equal(depth.subarray(0, header.length).toString("latin1"), header);
    assert.equal(depth.length, header.length + 4 * WIDTH * HEIGHT);
    const labels = labelsOf(bytes("labels.png"));
    /** @type {number[][]} */
    const inverse = [[], [], []];
    for (let i = 0; i < WIDTH * HEIGHT; i += 1) {
      const [x, y] = [i % WIDTH, Math.floor(i / WIDTH)];
      // PFM begins with the bottom row.
      const z = depth.readFloatLE(header.length + 4 * ((HEIGHT - 1 - y) * WIDTH + x));
      assert.ok(z > 0 && Number.isFinite(z), `depth ${z}`);
      inverse[labels[i] ?? 0]?.push(1 / z);
    }
    for (const rho of inverse.filter((rho) => rho.length > 0)) {
      const mean = rho.reduce((sum, r) => sum + r, 0) / rho.length;
      assert.ok(Math.abs(mean - 1) < 0.1, `mean 1/Z is ${mean}`);
    }
  });

  test("writes depth in 16 bits, its scale, and the relief", () => {
    assert.deepEqual([...bytes("depth16.png").subarray(24, 26)], [16, 0]);
    assert.ok(JSON.parse(String(bytes("motion.json"))).depth_scale > 0);
    const glb = bytes("relief.glb");
    assert.equal(glb.subarray(0, 4).toString("latin1"), "glTF");
    assert.equal(glb.readUInt32LE(8), glb.length);
    assert.match(bytes("relief.ply").subarray(0, 40).toString("latin1"), /^ply\nformat binary/);
  });

  test("writes flow in Middlebury's format", () => {
    const flow = bytes("flow.flo");
    assert.equal(flow.subarray(0, 4).toString("latin1"), "PIEH");
    assert.deepEqual([flow.readInt32LE(4), flow.readInt32LE(8)], [WIDTH, HEIGHT]);
    assert.equal(flow.length, 12 + 8 * WIDTH * HEIGHT);
  });

  test("writes the motion of every region", () => {
    const { regions, status, iterations, energy, seconds } = JSON.parse(
      String(bytes("motion.json")),
    );
    assert.deepEqual(
      regions.map((/** @type {any} */ region) => region.label),
      [0, 1, 2],
    );
    for (const { translation, rotation } of regions) {
      assert.ok([...translation, ...rotation].every(Number.isFinite));
      assert.deepEqual([translation.length, rotation.length], [3, 3]);
    }
    assert.match(status, /^(converged|exhausted)$/);
    assert.ok(iterations >= 1 && iterations <= 6);
    assert.equal(energy.length, iterations);
    assert.ok(seconds.total > 0);
    for (const step of ["motion", "depth", "curves"]) assert.ok(seconds[step] >= 0);
  });
});

test("without a curve there is one region", () => {
  const out = join(folder, "alone");
  const { status } = relievo(first, second, ...FOCAL, "--iterations", "1", "--out", out);
  assert.equal(status, 0);
  assert.equal(JSON.parse(String(readFileSync(join(out, "motion.json")))).regions.length, 1);
});

test("curves are labelled in the order given, whatever their kind, with = or without, negative or not", () => {
  const out = join(folder, "ordered");
  const curves = ["--polygon=40,14,56,14,56,34,40,34", "--circle", "-2,24,8"];
  const frozen = ["--preset", "paper", "--iterations", "1", "--curve-steps", "1"];
  const ran = relievo(first, second, ...FOCAL, ...curves, ...frozen, "--out", out);
  assert.equal(ran.status, 0, ran.stderr);
  const labels = labelsOf(readFileSync(join(out, "labels.png")));
  const at = (/** @type {number} */ x, /** @type {number} */ y) => labels[y * WIDTH + x];
  assert.deepEqual([at(48, 24), at(1, 24), at(30, 5)], [1, 2, 0]);
});

test("without --preset it is best, and paper is one option away", () => {
  const depth = (/** @type {string[]} */ ...words) => {
    const out = join(folder, "preset");
    const ran = relievo(first, second, ...FOCAL, "--iterations", "6", "--out", out, ...words);
    assert.equal(ran.status, 0, ran.stderr);
    return readFileSync(join(out, "depth.pfm"));
  };
  assert.deepEqual(depth(), depth("--preset", "best"));
  assert.notDeepEqual(depth(), depth("--preset", "paper"));
});

test("an existing folder is written into, and a path that cannot be a folder is an error", () => {
  const ran = relievo(first, second, ...FOCAL, "--iterations", "1", "--out", first);
  assert.equal(ran.status, 1);
  assert.match(ran.stderr, /cannot be made/);
});

test("one file that cannot be written does not cost the others", () => {
  const out = join(folder, "blocked");
  mkdirSync(join(out, "depth.png"), { recursive: true });
  const ran = relievo(first, second, ...FOCAL, "--iterations", "1", "--out", out);
  assert.equal(ran.status, 1);
  assert.match(ran.stderr, /depth\.png cannot be written: it is a folder/);
  assert.match(ran.stdout, /after 1 passes/);
  for (const name of ["labels.png", "confidence.png"]) assert.ok(existsSync(join(out, name)), name);
});

test("results do not replace a truth", () => {
  const out = join(folder, "kept");
  assert.equal(relievo("scene", "squares", "--size", "80x60", "--out", out).status, 0);
  const before = readFileSync(join(out, "labels.png"));
  const ran = relievo(first, second, ...FOCAL, "--iterations", "1", "--out", out);
  assert.equal(ran.status, 1);
  assert.match(ran.stderr, /holds a sequence with its truth.*--out/);
  assert.deepEqual(readFileSync(join(out, "labels.png")), before);
});

describe("what cannot be worked on ends with 1 and a sentence", () => {
  const small = file("small.pgm", pgm(32, 32, waves(0)));
  const grey = file(
    "grey.pgm",
    pgm(WIDTH, HEIGHT, () => 90),
  );
  const text = file("text.png", "no image at all");
  const png = readFileSync(first).subarray(0, 500);
  const truncated = file("truncated.pgm", png);
  const none = file("none.pgm", "P5\n0 0\n255\n");
  const tiny = file("tiny.pgm", pgm(15, 40, waves(0)));
  const huge = file("huge.pgm", "P5\n30001 20\n255\n");
  const empty = file("empty.png", "");

  /** @type {[string, string[], RegExp][]} */
  const cases = [
    ["frames of different sizes", [first, small], /64×48.*32×32/],
    ["no such file", [first, "missing.png"], /missing\.png cannot be read: there is no such file/],
    ["a folder", [first, folder], /it is a folder/],
    ["no image", [first, text], /text\.png cannot be read as an image/],
    ["an empty file", [first, empty], /the file is empty/],
    ["a truncated image", [first, truncated], /truncated\.pgm cannot be read as an image/],
    ["an image without pixels", [none, none], /none\.pgm/],
    ["frames too small", [tiny, tiny], /15×40.*between 16 and 30000/],
    ["frames too large", [huge, huge], /30001×20.*between 16 and 30000/],
    ["identical frames", [first, first], /identical/],
    ["constant frames", [grey, first], /same grey everywhere/],
    ["a curve outside", [first, second, "--circle", "500,24,8"], /curve 1 lies outside the 64×48/],
    ["a curve without area", [first, second, "--circle", "20,24,0"], /curve 1 encloses no pixel/],
    ["a flat polygon", [first, second, "--polygon", "5,5,20,5,30,5"], /curve 1 encloses no pixel/],
  ];
  for (const [name, words, sentence] of cases) {
    test(name, () => refused([...words, ...FOCAL], 1, sentence));
  }
});

describe("a wrong command line ends with 2 and a sentence", () => {
  const pair = [first, second];
  const eight = Array.from({ length: 8 }, () => ["--circle", "20,24,5"]).flat();
  /** @type {[string, string[], RegExp][]} */
  const cases = [
    ["nothing", [], /--help/],
    [
      "one frame",
      [first, ...FOCAL],
      /two frames are needed, one was given, and .*first\.pgm holds no/,
    ],
    ["a choice of two files' frames", [...pair, ...FOCAL, "--frames", "1,2"], /--frames chooses/],
    ["three frames", [...pair, first, ...FOCAL], /two frames are needed, 3 were given/],
    ["a focal length of 0", [...pair, "--focal", "0"], /focal length is 0/],
    ["a negative focal length", [...pair, "--focal", "-5"], /focal length is -5/],
    [
      "a focal length that is no number",
      [...pair, "--focal", "wide"],
      /--focal wide.*F, exif or auto/,
    ],
    ["an infinite focal length", [...pair, "--focal", "Infinity"], /--focal Infinity is not/],
    ["half a centre", [...pair, ...FOCAL, "--centre", "5"], /--centre 5 is not of the form X,Y/],
    ["half a circle", [...pair, ...FOCAL, "--circle", "5,5"], /is not of the form X,Y,R/],
    ["a circle of NaN", [...pair, ...FOCAL, "--circle", "5,NaN,5"], /is not of the form X,Y,R/],
    ["half a corner", [...pair, ...FOCAL, "--polygon", "1,2,3,4,5,6,7"], /is not of the form/],
    [
      "--auto with a curve",
      [...pair, ...FOCAL, "--auto", "--circle", "9,9,5"],
      /leave out --circle/,
    ],
    ["too many curves", [...pair, ...FOCAL, ...eight], /8 curves.*at most 7/],
    ["an unknown option", [...pair, ...FOCAL, "--colour", "red"], /'--colour'/],
    ["an option without its value", [...pair, "--focal"], /--focal/],
    ["an unknown preset", [...pair, ...FOCAL, "--preset", "magic"], /"magic" is no preset/],
    ["a weight that is no number", [...pair, ...FOCAL, "--mu", "NaN"], /mu is .*NaN.*from 0/],
    ["a weight below 0", [...pair, ...FOCAL, "--lambda", "-1"], /lambda is -1.*from 0/],
    ["no passes", [...pair, ...FOCAL, "--iterations", "0"], /max_passes is 0/],
    ["half a pass", [...pair, ...FOCAL, "--max-passes", "1.5"], /max_passes is 1\.5/],
    [
      "a switch half on",
      [...pair, ...FOCAL, "--occlusion", "maybe"],
      /--occlusion maybe is neither on/,
    ],
    [
      "a focal length beyond all",
      [...pair, "--focal", "1e300"],
      /focal length is .*from 1 to 10+,/,
    ],
    [
      "an unknown choice",
      [...pair, ...FOCAL, "--diffusion", "linear"],
      /"linear" is no value of diffusion/,
    ],
  ];
  for (const [name, words, sentence] of cases) test(name, () => refused(words, 2, sentence));
});

describe("--auto", () => {
  const scene = join(folder, "auto-scene");
  const frames = ["frame0.png", "frame1.png"].map((name) => join(scene, name));

  before(() => {
    relievo("scene", "squares", "--size", "160x120", "--out", scene);
  });

  test("finds what moves, says where, and starts from there", () => {
    const out = join(folder, "auto-found");
    const words = ["--focal", "160", "--iterations", "1", "--out", out];
    const found = relievo(...frames, ...words, "--auto");
    assert.equal(found.status, 0);
    assert.match(found.stdout, /^2 curves found/m);
    assert.match(found.stdout, /^curve 2 /m);
    const named = [...found.stdout.matchAll(/--polygon (\S+)/g)].map((match) => String(match[1]));
    assert.equal(named.length, 2);
    const labels = readFileSync(join(out, "labels.png"));
    const again = relievo(...frames, ...words, ...named.flatMap((points) => ["--polygon", points]));
    assert.equal(again.status, 0);
    assert.deepEqual(readFileSync(join(out, "labels.png")), labels);
  });
});

describe("--focal auto", () => {
  const out = ["--iterations", "1", "--out", join(folder, "focal")];

  test("finds the focal length where scenery before a turning camera tells it", () => {
    const [width, truth] = [240, 3];
    const frames = /** @type {const} */ ([0, 1]).map((t) =>
      file(`walls${t}.pgm`, pgm(width, 180, walls(width, truth, t))),
    );
    const found = relievo(...frames, "--focal", "auto", ...out);
    assert.equal(found.status, 0, found.stderr);
    const line = /^focal length found, between (\d+) and (\d+) pixels: --focal (\d+)$/m;
    const [, least = 0, greatest = 0, focal = 0] = (line.exec(found.stdout) ?? []).map(Number);
    assert.ok(least < truth * width && truth * width < greatest, found.stdout);
    assert.ok(least < focal && focal < greatest);
  });

  test("takes the longer side where nothing tells it, and says so; so does no --focal at all", () => {
    for (const focal of [["--focal", "auto"], []]) {
      const kept = relievo(first, second, ...focal, ...out);
      assert.equal(kept.status, 0, kept.stderr);
      assert.match(kept.stdout, /^the frames do not tell the focal length; a guess.*--focal 64$/m);
    }
  });
});

/**
 * @param {string[]} words
 * @param {number} code
 * @param {RegExp} sentence
 */
function refused(words, code, sentence) {
  const { status, stdout, stderr } = relievo(...words);
  assert.match(stderr, sentence);
  assert.equal(stderr.trim().split("\n").length, 1, "one sentence, no stack trace");
  assert.equal(stdout, "");
  assert.equal(status, code);
  assert.ok(!existsSync(join(folder, "out")), "nothing is written");
}

/** @param {Uint8Array} png */
function labelsOf(png) {
  const rgba = Frame.decode(png, "labels.png").rgba();
  return Array.from({ length: rgba.length / 4 }, (_, i) => Number(rgba[4 * i]));
}
