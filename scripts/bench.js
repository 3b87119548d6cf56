// npm run bench: how long the solver takes, natively and as WebAssembly in Node, beside TV-L1 and DIS.
// `npm run bench -- --help` says what can be asked.

import { mkdirSync, writeFileSync } from "node:fs";
import { join, relative } from "node:path";
import { parseArgs } from "node:util";

import { cases, SCENES, SIZES, USUAL } from "../bench/speed/cases.js";
import * as figures from "../bench/speed/figures.js";
import * as kernels from "../bench/speed/kernels.js";
import { machine } from "../bench/speed/machine.js";
import { measure } from "../bench/speed/measure.js";
import { PEERS, peers } from "../bench/speed/peers.js";
import * as rows from "../bench/speed/rows.js";
import { Server } from "../bench/speed/server.js";
import { table } from "../bench/speed/table.js";
import { duration, ifMain, root, run, Trouble } from "./shell.js";
import { setup } from "./setup.js";
import { unlessFresh } from "./stamp.js";
import { benchWasm, wasm } from "./wasm.js";

const HELP = `npm run bench -- [SCENE …] [options]

Scenes: ${SCENES.map(({ scene, regions }) => `${scene} (${regions})`).join(", ")}; in brackets how many regions.

  --quick          ${USUAL} only
  --size WxH       only this size; may be given again (${SIZES.join(", ")}, or any other)
  --best-only      only the preset best
  --paper-only     only the preset paper
  --kernels-only   no solves
  --rounds N       runs whose median is taken, 7 at least
  --markdown FILE  writes the tables there as well`;

const OPTIONS = /** @type {const} */ ({
  quick: { type: "boolean" },
  size: { type: "string", multiple: true },
  "best-only": { type: "boolean" },
  "paper-only": { type: "boolean" },
  "kernels-only": { type: "boolean" },
  rounds: { type: "string", default: "7" },
  markdown: { type: "string" },
  help: { type: "boolean" },
});

/** What rendered scenes depend on. */
const RENDERED_BY = ["src/scene", "src/camera.rs", "src/srgb.rs", "bench/speed/render.rs"];

/** Least number of runs whose median is worth printing. */
const LEAST_ROUNDS = 7;

function asked() {
  let parsed;
  try {
    parsed = parseArgs({ options: OPTIONS, allowPositionals: true });
  } catch (error) {
    throw new Trouble(`${error instanceof Error ? error.message : error}\n\n${HELP}`);
  }
  const { values, positionals } = parsed;
  const rounds = Number(values.rounds);
  if (!Number.isInteger(rounds) || rounds < LEAST_ROUNDS) {
    throw new Trouble(`--rounds must be a whole number, ${LEAST_ROUNDS} at least.`);
  }
  if (values["best-only"] && values["paper-only"]) {
    throw new Trouble("--best-only and --paper-only leave nothing to solve.");
  }
  const presets = ["best", "paper"].filter(
    (preset) => !values[preset === "best" ? "paper-only" : "best-only"],
  );
  const sizes = values.size ?? (values.quick ? [USUAL] : SIZES);
  const chosen = cases({ names: positionals, sizes, presets });
  return { ...values, rounds, cases: values["kernels-only"] ? [] : chosen };
}

/**
 * Solves all cases; a row is said as soon as it is known.
 * @param {import("../bench/speed/cases.js").Case[]} chosen
 * @param {number} rounds
 */
async function solves(chosen, rounds) {
  const targets = join(root, process.env.CARGO_TARGET_DIR ?? "target", "release/examples/speed");
  const start = {
    native: () => new Server(targets),
    wasm: () => new Server(process.execPath, [join(root, "bench/speed/wasm.js")]),
  };
  const engines = Object.entries(start).map(([by, fresh]) => ({ by, fresh, server: fresh() }));
  const python = peers();
  const others = python ? PEERS.map(({ name, work }) => ({ by: name, server: python, work })) : [];
  const results = [];
  try {
    for (const one of chosen) {
      const { scene, width, height } = one;
      const folder = join(root, "out/speed", `${scene}-${width}x${height}`);
      mkdirSync(folder, { recursive: true });
      console.error(`\n${scene}, ${width}×${height}`);
      // The ray caster takes minutes for a film of full size; 60 MB keep it.
      await unlessFresh(relative(root, folder), RENDERED_BY, () =>
        start.native().once({ work: "render", folder, scene, width, height }),
      );
      const entries = await measure(one, folder, engines, others, rounds);
      results.push({ one, entries });
      console.error(table(rows.HEAD, rows.rows({ one, entries })));
    }
  } finally {
    for (const { server } of [...engines, ...others]) server.end();
  }
  return results;
}

await ifMain(import.meta.url, async () => {
  const wanted = asked();
  if (wanted.help) return console.log(HELP);
  await setup();
  await wasm();
  const module = await benchWasm();
  await run("cargo", ["build", "--locked", "--release", "--quiet", "--example", "speed"]);

  const begin = performance.now();
  const results = await solves(wanted.cases, wanted.rounds);
  const text = [
    `${machine()}. One thread; medians of ${wanted.rounds} runs in which all take turns.`,
    ...(results.length
      ? [table(rows.HEAD, results.flatMap(rows.rows)), table(figures.HEAD, figures.rows(results))]
      : []),
    table(kernels.HEAD, await kernels.rows(module, wanted.rounds)),
  ].join("\n\n");
  console.log(`\n${text}`);
  if (wanted.markdown) writeFileSync(wanted.markdown, `${text}\n`);
  console.error(`\n${duration(performance.now() - begin)}`);
});
