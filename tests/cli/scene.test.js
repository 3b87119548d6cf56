// relievo scene, scenes and score.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { before, describe, test } from "node:test";

import { Frame, sceneCatalogue } from "../../cli/index.js";
import { folder, relievo } from "./relievo.js";

const names = JSON.parse(sceneCatalogue()).map((/** @type {{ name: string }} */ s) => s.name);

test("scenes lists every sequence with what it teaches", () => {
  const { status, stdout } = relievo("scenes");
  assert.equal(status, 0);
  const listed = stdout.trim().split("\n");
  assert.deepEqual(
    listed.map((line) => line.split(" ")[0]),
    names,
  );
  assert.ok(listed.every((line) => line.length > 40));
});

describe("a scene", () => {
  const out = join(folder, "squares");
  const bytes = (/** @type {string} */ name) => readFileSync(join(out, name));
  /** @type {ReturnType<typeof relievo>} */
  let ran;
  before(() => {
    ran = relievo("scene", "squares", "--size", "80x60", "--out", out);
  });

  test("is written with its truth at the size asked for", () => {
    assert.equal(ran.status, 0, ran.stderr);
    for (const name of ["frame0.png", "frame1.png", "labels.png", "occlusion.png"]) {
      const { width, height } = Frame.decode(bytes(name), name);
      assert.deepEqual([width, height], [80, 60], name);
    }
    assert.equal(bytes("flow.flo").length, 12 + 8 * 80 * 60);
    assert.ok(bytes("depth.pfm").length > 4 * 80 * 60);
    assert.equal(JSON.parse(String(bytes("motion.json"))).regions.length, 3);
  });

  test("says its camera, its curves and how to solve it, and that works", () => {
    const { camera, curves, command } = JSON.parse(String(bytes("scene.json")));
    assert.ok(camera.focal > 0);
    assert.equal(curves.length, 2);
    assert.ok(ran.stdout.includes(command));
    const words = command.split(" ").slice(2);
    const solved = relievo(...words, "--iterations", "1");
    assert.equal(solved.status, 0, solved.stderr);
    const motion = readFileSync(join(out, "found", "motion.json"));
    assert.equal(JSON.parse(String(motion)).regions.length, 3);
  });

  test("scores perfectly against itself, and a solution worse", () => {
    const self = JSON.parse(relievo("score", out, out, "--json").stdout);
    assert.equal(self.labels_wrong, 0);
    assert.equal(self.aee, 0);
    const found = JSON.parse(relievo("score", join(out, "found"), out, "--json").stdout);
    assert.ok(found.labels_wrong > 0 && found.aee > 0);
    assert.match(relievo("score", out, out).stdout, /labels wrong +0\.0 %/);
  });

  test("has no score for depth of what stands still", () => {
    const still = join(folder, "blocks");
    relievo("scene", "blocks", "--size", "80x60", "--out", still);
    const { depth_error } = JSON.parse(relievo("score", still, still, "--json").stdout);
    assert.deepEqual(depth_error, [null, 0, 0]);
  });
});

describe("a wrong command line ends with 2 and a sentence", () => {
  /** @type {[string, string[], RegExp][]} */
  const cases = [
    ["no name", ["scene"], /one sequence must be named/],
    ["an unknown name", ["scene", "circus"], /"circus" is no built-in sequence.*squares/],
    ["no size", ["scene", "squares", "--size", "big"], /--size big is not of the form WxH/],
    ["too small a size", ["scene", "squares", "--size", "8x8"], /8×8.*between 16 and 30000/],
    ["too large a size", ["scene", "squares", "--size", "99999x20"], /99999×20/],
    ["one folder to score", ["score", folder], /two folders or files are needed/],
  ];
  for (const [name, words, sentence] of cases) {
    test(name, () => {
      const { status, stderr } = relievo(...words);
      assert.match(stderr, sentence);
      assert.equal(stderr.trim().split("\n").length, 1);
      assert.equal(status, 2);
    });
  }
});

test("a folder without results cannot be scored", () => {
  const { status, stderr } = relievo("score", folder, folder);
  assert.match(stderr, /there is nothing to score/);
  assert.equal(status, 1);
});

describe("asking what there is", () => {
  test("--help names every command and option on stdout", () => {
    for (const words of [["--help"], ["scene", "--help"], ["-h"]]) {
      const { status, stdout, stderr } = relievo(...words);
      assert.equal(status, 0);
      assert.equal(stderr, "");
      const wanted = ["--focal", "--circle", "--polygon", "--centre", "--preset", "--max-passes"];
      for (const word of [...wanted, ...names]) assert.ok(stdout.includes(word), word);
      assert.match(stdout, /best \([^|]*the default\) \|\s+paper/);
      const both = stdout.indexOf("With --preset best or paper:");
      const best = stdout.indexOf("With --preset best:");
      const paper = stdout.indexOf("With --preset paper:");
      const [mu, occlusion, steps] = ["--mu", "--occlusion", "--depth-steps"].map((word) =>
        stdout.indexOf(`  ${word} `),
      );
      const order = [both, mu, best, occlusion, paper, steps];
      assert.ok(both > 0);
      assert.deepEqual(
        order.toSorted((a, b) => Number(a) - Number(b)),
        order,
      );
    }
  });

  test("--version is the package's", () => {
    const text = readFileSync(new URL("../../package.json", import.meta.url), "utf8");
    assert.equal(relievo("--version").stdout.trim(), JSON.parse(text).version);
  });
});
