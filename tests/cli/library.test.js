// The WebAssembly as a library: what crosses the border, and what happens when something is wrong.

import assert from "node:assert/strict";
import { beforeEach, describe, test } from "node:test";
import { execFileSync } from "node:child_process";
import { fileURLToPath } from "node:url";

import {
  fileKind,
  Frame,
  hornSchunck,
  limits,
  optionCatalogue,
  presetCatalogue,
  Scene,
  Solver,
  Truth,
  viewCatalogue,
} from "../../cli/index.js";

const [WIDTH, HEIGHT] = [80, 60];
const scene = new Scene("squares", WIDTH, HEIGHT);

/** @param {Solver} solver */
function solved(solver) {
  while (solver.step() === "running");
  return solver;
}

/**
 * @param {Solver} solver
 * @returns {import("../../cli/index.js").Report}
 */
const reported = (solver) => JSON.parse(solver.report());

const solver = (options = "{}", shapes = scene.shapesJson, camera = scene.cameraJson) =>
  new Solver(scene.first(), scene.second(), camera, shapes, options);

describe("a solver", () => {
  /** @type {Solver} */
  let found;
  beforeEach(() => {
    found = solved(solver());
  });

  test("gives arrays with an entry for each pixel", () => {
    const arrays = [
      found.labels(),
      found.depth(),
      found.confidence(),
      found.flowU(),
      found.flowV(),
    ];
    for (const array of arrays) assert.equal(array.length, WIDTH * HEIGHT);
    const { regions } = reported(found);
    const labels = found.labels();
    assert.deepEqual(
      regions.map(({ pixels }) => pixels),
      regions.map(({ label }) => labels.filter((l) => l === label).length),
    );
  });

  test("shows what it found after a step, not before it", () => {
    const fresh = solver();
    const before = fresh.depth();
    assert.notDeepEqual(solved(fresh).depth(), before);
  });

  test("draws every view of the catalogue", () => {
    const { views, defaults } = JSON.parse(viewCatalogue());
    assert.ok(views.length >= 8);
    for (const { kind } of views) {
      for (const params of ["{}", JSON.stringify(defaults)]) {
        const picture = found.view(kind, params);
        const { width, height } = picture;
        assert.ok(width >= WIDTH && height >= HEIGHT, kind);
        assert.equal(picture.rgba().length, 4 * width * height, kind);
      }
      Truth.ofScene(scene).view(kind, "{}").free();
    }
    assert.ok(hornSchunck(scene.first(), scene.second()).view("flow", "{}").width >= WIDTH);
  });

  test("files that measure are as large as the frames, whatever size pictures are drawn at", () => {
    const large = new Scene("squares", 960, 720);
    const fast = JSON.stringify({ detail: "fast", max_passes: 1 });
    const [first, second] = [large.first(), large.second()];
    const solver = new Solver(first, second, large.cameraJson, large.shapesJson, fast);
    solver.step();
    const sizeOf = (/** @type {Uint8Array} */ png) => Frame.decode(png, "labels.png").width;
    assert.equal(sizeOf(solver.file("labels.png", { pixels: 200_000 })), 960);
    assert.equal(solver.view("depth", { pixels: 200_000, magnify: 1 }).width, 480);
  });

  test("gives a relief whose triangles stand on its vertices", () => {
    const mesh = found.mesh("{}");
    const vertices = mesh.positions.length / 3;
    assert.ok(mesh.indices.length > 0 && mesh.indices.length % 3 === 0);
    assert.ok(mesh.indices.every((index) => index < vertices));
    assert.deepEqual(
      [mesh.uvs.length, mesh.normals.length, mesh.colours.length, mesh.labels.length],
      [2 * vertices, 3 * vertices, 3 * vertices, vertices],
    );
    assert.ok([...mesh.positions].every(Number.isFinite));
  });

  test("gives its curves in pixels", () => {
    const contours = JSON.parse(found.contours());
    assert.deepEqual([...new Set(contours.map((/** @type {any} */ c) => c.label))], [1, 2]);
    for (const { points } of contours) {
      assert.ok(points.length >= 6 && points.length % 2 === 0);
      assert.ok(points.every((/** @type {number} */ p) => p >= -0.5 && p <= WIDTH));
    }
  });

  test("is scored against the truth beside the baseline", () => {
    const truth = Truth.ofScene(scene);
    const flow = hornSchunck(scene.first(), scene.second());
    const { found: scores, baseline } = JSON.parse(found.scores(truth, flow));
    assert.ok(scores.labels_wrong >= 0 && scores.labels_wrong <= 1);
    assert.ok(baseline.aee > 0 && baseline.aae > 0);
  });

  test("is compared with as much truth as files have", () => {
    const [first, second] = [scene.first(), scene.second()];
    const flow = scene.files().filter(({ name }) => name === "flow.flo");
    const renamed = flow.map(({ bytes }) => ({ name: "any name", bytes }));
    const truth = new Truth(first, second, renamed);
    assert.deepEqual(JSON.parse(truth.known()), {
      ...{ labels: false, depth: false, flow: true, occlusion: false },
    });
    const { found: scores } = JSON.parse(found.scores(truth, hornSchunck(first, second)));
    assert.ok(scores.aee > 0 && scores.labels_wrong === null);
    assert.equal(found.viewErrors("flow", {}, truth).width, WIDTH);
    assert.equal(JSON.parse(found.errorLegend("flow", {}, truth)).unit, "px");
    assert.throws(() => found.viewErrors("depth", {}, truth), { message: /nothing in common/ });
    const kinds = scene.files().map(({ name, bytes }) => fileKind(name, bytes, false) ?? null);
    assert.deepEqual(kinds, [
      ...[null, null, "labels.png", "depth.pfm", "depth.png", "flow.flo", "occlusion.png"],
      "motion.json",
    ]);
    // A whole result, with its depth twice.
    const whole = JSON.parse(new Truth(first, second, scene.files().slice(2)).known());
    assert.ok(Object.values(whole).every(Boolean));
    assert.throws(() => new Truth(first, second, scene.files().slice(0, 1)), {
      message: /is no ground truth/,
    });
    const large = new Scene("blocks", 2 * WIDTH, 2 * HEIGHT).files();
    assert.throws(() => new Truth(first, second, large.slice(2, 3)), {
      message: new RegExp(`${2 * WIDTH}×${2 * HEIGHT}.*${WIDTH}×${HEIGHT}`),
    });
  });

  test("says of each region which motion it is, and how good all of it is", () => {
    const { regions, expected, breaks, history } = reported(found);
    assert.ok(regions.every(({ model }) => /^(still|rotation|translation|full)$/.test(model)));
    assert.ok(expected && expected.flow > 0 && expected.flow < 1);
    assert.ok(breaks.length > 0 && breaks.every((after) => after <= history.length));
  });

  test("takes the following frame from where it is", () => {
    const mean = () => found.flowU().reduce((sum, u) => sum + u, 0) / (WIDTH * HEIGHT);
    const [before, cold] = [mean(), reported(found).iterations];
    const frame = scene.first();
    found.next(frame);
    assert.equal(frame.width, WIDTH, "the frame is still there");
    assert.equal(found.status, "running");
    assert.equal(reported(found).breaks.at(-1), cold);
    solved(found);
    // The film runs backwards from the second frame to the first.
    assert.ok(mean() * before < 0 && Math.abs(mean() + before) < 0.5 * Math.abs(before));
    assert.deepEqual([...new Set(found.labels())].sort(), [0, 1, 2]);
    assert.ok(reported(found).iterations - cold < cold, "it had a first guess");
  });

  test("starts again on reset", () => {
    found.reset();
    assert.equal(JSON.parse(found.report()).iterations, 0);
    assert.ok(found.depth().every((z) => z === 1));
  });

  test("stays as it is when it is given something wrong", () => {
    const before = [found.report(), found.labels()];
    const outside = '[{"kind": "circle", "x": 900, "y": 5, "r": 3}]';
    assert.throws(() => found.setOptions('{"mu": -1}'), {
      name: "SettingError",
      message: /mu is -1/,
    });
    assert.throws(() => found.setOptions("mu"), { message: /options cannot be read/ });
    assert.throws(() => found.setCurves(outside), { name: "InputError", message: /curve 1/ });
    assert.throws(() => found.setCurves('[{"kind": "blob"}]'), {
      message: /curves cannot be read/,
    });
    assert.throws(() => found.next(scene.second()), { name: "InputError", message: /identical/ });
    const small = new Scene("squares", 40, 30).first();
    assert.throws(() => found.next(small), { name: "InputError", message: /40×30/ });
    assert.throws(() => found.view("smell", "{}"), { message: /"smell" is no view/ });
    assert.throws(() => found.view("depth", '{"scales": [-1]}'), { message: /scales is -1/ });
    assert.deepEqual([found.report(), found.labels()], before);
  });

  test("takes JSON and what it stands for alike, and says what it cannot take", () => {
    const [camera, curves] = [scene.cameraJson, scene.shapesJson].map((text) => JSON.parse(text));
    const plain = new Solver(scene.first(), scene.second(), camera, curves, { preset: "paper" });
    const text = solver('{"preset": "paper"}');
    for (const it of [plain, text]) it.step();
    assert.deepEqual(plain.flowU(), text.flowU());
    assert.ok(plain.view("depth", { palette: "lagoon" }).width >= WIDTH);

    const bad = /** @type {any} */ (undefined);
    const message = (/** @type {RegExp} */ sentence) => ({ name: "InputError", message: sentence });
    assert.throws(
      () => new Solver(scene.first(), scene.second(), bad, [], {}),
      message(/camera cannot be read: it must be JSON or an object, and is undefined/),
    );
    assert.throws(() => found.setOptions(bad), message(/options.*is undefined/));
    assert.throws(() => found.view(bad, {}), message(/name of the view.*a string.*undefined/));
    assert.throws(() => Frame.decode(new Uint8Array(9), bad), message(/name of the file/));
  });

  test("refuses words it does not know", () => {
    const [first, second] = [scene.first(), scene.second()];
    assert.throws(() => new Solver(first, second, { focal: 64, Cx: 1 }, [], {}), { message: /Cx/ });
    const round = { kind: "circle", x: 9, y: 9, r: 5, z: 1 };
    assert.throws(() => found.setCurves([round]), { message: /`z`/ });
    assert.throws(() => found.view("depth", { pallete: "x" }), { message: /pallete/ });
  });

  test("measures its time", () => {
    const { seconds } = JSON.parse(found.report());
    assert.ok(seconds.total > 0);
  });
});

test("without a principal point a camera looks at the centre", () => {
  const { focal, cx, cy } = JSON.parse(scene.cameraJson);
  assert.deepEqual([cx, cy], [(WIDTH - 1) / 2, (HEIGHT - 1) / 2]);
  const [bare, full] = [{ focal }, { focal, cx, cy }].map((camera) => {
    const found = solver("{}", scene.shapesJson, JSON.stringify(camera));
    found.step();
    return found.flowU();
  });
  assert.deepEqual(bare, full);
});

test("a frame from pixels is the same as from a file", () => {
  const bytes = scene.files().find(({ name }) => name === "frame0.png")?.bytes;
  const decoded = Frame.decode(bytes ?? new Uint8Array(), "frame0.png");
  const copied = Frame.fromRgba(WIDTH, HEIGHT, new Uint8Array(decoded.rgba()));
  assert.deepEqual(copied.rgba(), scene.first().rgba());
  assert.throws(() => Frame.fromRgba(WIDTH, HEIGHT, new Uint8Array(7)), {
    message: /19200 values/,
  });
});

test("catalogues say enough to build a form from", () => {
  const presets = JSON.parse(presetCatalogue()).map((/** @type {any} */ preset) => preset.value);
  /** @type {import("../../cli/index.js").OptionEntry[]} */
  const options = JSON.parse(optionCatalogue());
  for (const option of options) {
    const { key, label, meaning, defaults } = option;
    assert.ok(label && meaning, key);
    assert.ok(option.presets.length > 0 && option.presets.every((one) => presets.includes(one)));
    assert.deepEqual(Object.keys(defaults).sort(), [...presets].sort(), key);
    if (option.kind === "choice") assert.ok(option.choices.length > 0, key);
    else if (option.kind !== "toggle") assert.ok(option.min < option.max, key);
    for (const preset of option.presets)
      solver(JSON.stringify({ preset, [key]: defaults[preset] })).free();
  }
  assert.deepEqual(JSON.parse(limits()), {
    minSide: 16,
    maxSide: 30000,
    maxPixels: 100_000_000,
    maxCurves: 7,
  });
});

test("a panic leaves its reason behind", () => {
  // In a process of its own: the module is of no use afterwards.
  const library = new URL("../../cli/index.js", import.meta.url).href;
  const script = `
    import { panicForTest, panicMessage } from ${JSON.stringify(library)};
    console.error = () => {};
    console.log(JSON.stringify(panicMessage()));
    try { panicForTest("the sky fell"); } catch (error) { console.log(error.name); }
    console.log(panicMessage());
  `;
  const printed = execFileSync(process.execPath, ["--input-type=module", "--eval", script], {
    cwd: fileURLToPath(new URL("../..", import.meta.url)),
    encoding: "utf8",
  });
  const [before, name, after] = printed.trim().split("\n");
  assert.deepEqual([before, name], ['""', "RuntimeError"]);
  assert.match(after ?? "", /internal error at src\/wasm\/panic\.rs:\d+: the sky fell/);
});
