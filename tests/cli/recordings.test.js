// Recordings are what the solver gives: every pass's energy, and the last pass's pictures to what an eye sees.

import assert from "node:assert/strict";
import { readdirSync, readFileSync } from "node:fs";
import { test } from "node:test";
import { inflateRawSync } from "node:zlib";

import * as core from "../../pkg/relievo.js";

core.initSync({ module: readFileSync(new URL("../../pkg/relievo_bg.wasm", import.meta.url)) });

const FOLDER = new URL("../../recordings/", import.meta.url);
const MOST_BYTES = 240_000;

/** @type {{ name: string }[]} */
const scenes = JSON.parse(core.sceneCatalogue());

/** @param {string} name */
function recordingOf(name) {
  const file = readFileSync(new URL(`${name}.bin`, FOLDER));
  const end = 4 + file.readUInt32LE(0);
  const first = inflateRawSync(file.subarray(4, end));
  const head = JSON.parse(first.subarray(4, 4 + first.readUInt32LE(0)).toString());
  return { size: file.length, head, found: inflateRawSync(file.subarray(end)) };
}

test("every sequence has a recording that is not too large", () => {
  const names = readdirSync(FOLDER).filter((name) => name.endsWith(".bin"));
  assert.deepEqual(names.sort(), scenes.map(({ name }) => `${name}.bin`).sort());
  for (const { name } of scenes) assert.ok(recordingOf(name).size <= MOST_BYTES, name);
});

// One region whose depth leaps, and several that move.
for (const name of ["columns", "squares"]) {
  test(`the recording of ${name} is what the solver gives`, () => {
    const { head, found } = recordingOf(name);
    const scene = new core.Scene(name, head.width, head.height);
    const [first, second] = [scene.first(), scene.second()];
    const solver = new core.Solver(first, second, head.camera, head.shapes, {});
    for (const [i, pass] of head.passes.entries()) {
      solver.step();
      const { history, status, regions } = JSON.parse(solver.report());
      assert.deepEqual(pass.report.history, history, `pass ${i + 1}`);
      assert.equal(pass.report.status, status);
      assert.deepEqual(pass.report.regions, regions);
    }
    assert.notEqual(solver.status, "running");
    const { report, contours } = head.passes.at(-1);
    const kept = new core.Kept(first, second, found, contours, report);
    for (const kind of ["depth", "flow", "labels", "occlusion"]) {
      const shown = kept.view(kind, {}).rgba();
      const live = solver.view(kind, {}).rgba();
      let off = 0;
      for (const [i, value] of live.entries()) off += Math.abs(value - (shown[i] ?? 0));
      // Less than a grey level in the mean.
      assert.ok(off / live.length < 0.5, `${kind}: ${off / live.length} levels off`);
    }
    assert.deepEqual(
      kept.files({}).map(({ name }) => name),
      solver.files({}).map(({ name }) => name),
    );
  });
}

test("what was kept exactly is shown exactly, and damage is refused in a sentence", () => {
  const scene = new core.Scene("blocks", 80, 60);
  const [first, second] = [scene.first(), scene.second()];
  const solver = new core.Solver(first, second, scene.cameraJson, scene.shapesJson, {});
  for (let i = 0; i < 3; i++) solver.step();
  const bytes = solver.keep(false);
  const kept = new core.Kept(first, second, bytes, solver.contours(), solver.report());
  for (const { name, bytes } of solver.files({})) {
    const same = kept.files({}).find((file) => file.name === name);
    assert.deepEqual(same?.bytes, bytes, name);
  }
  const truth = core.Truth.ofScene(scene);
  const flow = core.hornSchunck(first, second);
  assert.equal(kept.scores(truth, flow), solver.scores(truth, flow));
  assert.throws(
    () => new core.Kept(first, second, bytes.slice(0, 1000), solver.contours(), solver.report()),
    /not a readable kept result/,
  );
  const other = new core.Scene("blocks", 64, 48);
  assert.throws(
    () => new core.Kept(other.first(), other.second(), bytes, solver.contours(), solver.report()),
    /80×60/,
  );
});
