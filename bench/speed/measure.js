// One case: everything is tried once, then all take turns, so that a machine that is busy for a while hits all alike.

import { Trouble } from "../../scripts/shell.js";
import { firstUsable } from "./scores.js";
import { median } from "./statistics.js";

/** Seconds that a sample takes at least: what is over sooner is repeated, and the median taken. */
const SAMPLE = 0.2;

/** @typedef {import("./server.js").Server} Server */
/** @typedef {import("./scores.js").Score} Score */
/** @typedef {Record<string, number | null>} Seconds total, motion, depth, curves, usable, next */

/**
 * @typedef {object} Entry
 * @property {string} by who: native, wasm, TV-L1 or DIS
 * @property {string | null} preset
 * @property {Seconds[]} samples one for each round
 * @property {Score | null} score at the end
 * @property {Score | null} next after a warm start with the following frame
 * @property {number | null} passes
 * @property {string | null} status how it ended
 * @property {number | null} bytes memory beyond that of an idle process
 */

/** @typedef {{ by: string, server: Server, fresh: () => Server }} Engine */
/** @typedef {{ by: string, server: Server, work: string }} Peer */

/**
 * All who solve or find flow in one case; who fails is left out.
 * @param {import("./cases.js").Case} one
 * @param {string} folder where it has been rendered
 * @param {Engine[]} engines
 * @param {Peer[]} peers
 * @param {number} rounds
 * @returns {Promise<Entry[]>}
 */
export async function measure(one, folder, engines, peers, rounds) {
  const turns = [];
  for (const preset of one.presets) {
    for (const engine of engines) {
      try {
        turns.push(await ours(engine, { folder, preset }));
      } catch (error) {
        if (!(error instanceof Trouble)) throw error;
        console.error(error.message);
        // What has failed once may be in no state to go on.
        engine.server.end();
        engine.server = engine.fresh();
      }
    }
  }
  for (const peer of peers) turns.push(await theirs(peer, folder));
  for (let round = 0; round < rounds; round++) {
    for (const { entry, run } of turns) entry.samples.push(await sample(run));
  }
  return turns.map(({ entry }) => entry);
}

/**
 * @param {Engine} engine
 * @param {{ folder: string, preset: string }} request
 */
async function ours(engine, request) {
  const trial = await engine.server.ask({ work: "trial", ...request });
  const usable = firstUsable(trial.scores);
  const { bytes } = await engine.fresh().once({ work: "memory", ...request });
  /** @type {Entry} */
  const entry = {
    by: engine.by,
    preset: request.preset,
    samples: [],
    score: trial.scores.at(-1),
    next: trial.next,
    passes: trial.scores.length,
    status: trial.status,
    bytes,
  };
  return { entry, run: () => engine.server.ask({ work: "solve", usable, ...request }) };
}

/**
 * @param {Peer} peer
 * @param {string} folder
 */
async function theirs({ by, server, work }, folder) {
  const { aee } = await server.ask({ work, folder });
  /** @type {Entry} */
  const entry = {
    by,
    preset: null,
    samples: [],
    score: { aee, wrong: NaN },
    next: null,
    passes: null,
    status: null,
    bytes: null,
  };
  return { entry, run: () => server.ask({ work, folder }) };
}

/**
 * @param {() => Promise<Seconds>} run
 * @returns {Promise<Seconds>}
 */
async function sample(run) {
  /** @type {Seconds[]} */
  const runs = [];
  for (let spent = 0; spent < SAMPLE;) {
    const seconds = await run();
    runs.push(seconds);
    spent += (seconds["total"] ?? SAMPLE) + (seconds["next"] ?? 0);
  }
  return Object.fromEntries(
    Object.keys(runs[0] ?? {}).map((key) => [key, median(column(runs, key))]),
  );
}

/**
 * What `samples` have under `key`, without what is not known.
 * @param {Seconds[]} samples
 * @param {string} key
 */
export function column(samples, key) {
  return samples.map((seconds) => seconds[key] ?? null).filter((value) => value !== null);
}
