// What the speed tables are made with.

import assert from "node:assert/strict";
import { test } from "node:test";

import { Trouble } from "../../scripts/shell.js";
import { cases } from "../../bench/speed/cases.js";
import { described } from "../../bench/speed/kernels.js";
import { measure } from "../../bench/speed/measure.js";
import { over, rows } from "../../bench/speed/rows.js";
import { firstUsable, score } from "../../bench/speed/scores.js";
import {
  geometricMean,
  median,
  medianRatio,
  quantile,
  spread,
} from "../../bench/speed/statistics.js";
import { number, table } from "../../bench/speed/table.js";

test("many numbers come to one", () => {
  assert.equal(median([]), null);
  assert.equal(median([3, 1, 2]), 2);
  assert.equal(median([10, 9, 1, 2]), 5.5);
  assert.equal(quantile([0, 10, 20], 0.25), 5);
  assert.equal(spread([8, 9, 10, 11, 12]), 0.1);
  assert.ok(Math.abs((geometricMean([1, 4]) ?? 0) - 2) < 1e-12);
  assert.equal(geometricMean([]), null);
});

test("ratios are taken round by round", () => {
  // The machine was ten times as slow in the second round.
  assert.equal(medianRatio([1, 10, 1], [2, 20, 2]), 0.5);
  assert.equal(medianRatio([1, null, 3], [2, 2, 2]), 1);
  assert.equal(medianRatio([null], [1]), null);
});

test("a table is aligned", () => {
  const lines = table(["what", "s"], [["σ", "10.0"]]).split("\n");
  assert.deepEqual(lines, ["| what |    s |", "| ---- | ---: |", "| σ    | 10.0 |"]);
});

test("numbers keep three figures", () => {
  const written = [123.4, 1.2345, 0.012345, 0, null, NaN].map((value) => number(value));
  assert.deepEqual(written, ["123", "1.23", "0.0123", "0", "–", "–"]);
});

test("a picture is usable once its labels and its flow are near", () => {
  const far = { aee: 0.1, wrong: 0.04 };
  assert.equal(
    firstUsable([
      far,
      { aee: 0.2, wrong: 0.01 },
      { aee: 0.15, wrong: 0.03 },
      { aee: 0.1, wrong: 0 },
    ]),
    3,
  );
  assert.equal(firstUsable([far]), null);
  assert.equal(firstUsable([]), null);
});

test("a picture's score counts wrong labels and lengths", () => {
  const found = {
    labels: Uint8Array.of(0, 1),
    u: Float32Array.of(3, 0),
    v: Float32Array.of(4, NaN),
  };
  const truth = { labels: Uint8Array.of(0, 2), flow: Float32Array.of(0, 0, 0, 1) };
  assert.deepEqual(score(found, truth), { aee: 3, wrong: 0.5 });
});

test("a kernel's bound is the tighter of two", () => {
  const pixels = 100;
  const list = [
    { name: "copy", pixels, bytes: 8, flops: 0 },
    { name: "multiply-add", pixels, bytes: 0, flops: 64 },
    { name: "moves", pixels, bytes: 16, flops: 8 },
    { name: "computes", pixels, bytes: 8, flops: 64 },
  ];
  const bounds = described(list, [1, 2, 4, 3]).map((row) => row.slice(5));
  assert.deepEqual(bounds.slice(2), [
    ["2.00", "bytes", "2.00"],
    ["2.00", "flops", "1.50"],
  ]);
  assert.deepEqual(
    bounds.slice(0, 2).map((row) => row[2]),
    ["1.00", "1.00"],
  );
});

test("large frames are not solved as printed, and unknown scenes not at all", () => {
  const asked = { names: ["head"], sizes: ["640x480", "1280x720"], presets: ["best", "paper"] };
  assert.deepEqual(
    cases(asked).map(({ width, presets }) => [width, presets]),
    [
      [640, ["best", "paper"]],
      [1280, ["best"]],
    ],
  );
  assert.throws(() => cases({ ...asked, names: ["circus"] }), /none of flight/);
  assert.throws(() => cases({ ...asked, sizes: ["big"] }), /no size/);
});

test("all take turns, and who fails is left out", async () => {
  /** @type {string[]} */
  const asked = [];
  /** @param {string} by @param {number} total */
  const engine = (by, total) => {
    const server = /** @type {any} */ ({
      end() {},
      once: (/** @type {{ work: string }} */ request) => server.ask(request),
      /** @param {{ work: string }} request */
      async ask({ work }) {
        if (work === "trial" && total === 0) throw new Trouble("it has failed");
        if (work === "solve" || work === "tvl1") asked.push(by);
        if (work === "trial")
          return { status: "converged", scores: [{ aee: 1, wrong: 0 }], next: null };
        return work === "memory" ? { bytes: 4800 } : { total, aee: 2, usable: total / 2 };
      },
    });
    return { by, server, work: "tvl1", fresh: () => server };
  };
  const one = { scene: "head", regions: 2, width: 40, height: 30, presets: ["best"] };
  const engines = [engine("native", 1), engine("wasm", 0)];
  const entries = await measure(one, "", engines, [engine("TV-L1", 4)], 3);
  // The peer is tried once before.
  assert.deepEqual(asked, ["TV-L1", "native", "TV-L1", "native", "TV-L1", "native", "TV-L1"]);
  const [native, peer] = entries;
  assert.ok(native && peer && entries.length === 2);
  assert.equal(over(native, "total", entries, "TV-L1"), 0.25);
  assert.equal(over(native, "usable", entries, "TV-L1"), 0.125);
  assert.equal(over(peer, "total", entries, "TV-L1"), null);
  assert.deepEqual(rows({ one, entries })[0]?.slice(0, 6), [
    "head",
    "40×30",
    "2",
    "native",
    "best",
    "1.00",
  ]);
});
