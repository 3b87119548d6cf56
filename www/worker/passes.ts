/** Passes put away as they are made, until the page takes them. */

import type { Engine } from "./engine";
import { squeeze } from "./keeping";
import type { Pass } from "./protocol";

/** Tells this worker's solves from those of any other. */
const WORKER = `${performance.timeOrigin}-${Math.random()}`;

let waiting: Promise<Pass>[] = [];
/** The pass put away last. */
let last = "";

/** Puts away where the solver stands, if it has made a pass since the last time. */
export function keepPass(engine: Engine): void {
  const { history, breaks, ...report } = engine.report();
  const solve = `${WORKER}-${engine.solve}`;
  const name = `${solve}-${report.iterations}`;
  const energy = history.at(-1);
  if (name === last || energy === undefined || !engine.started) return;
  last = name;
  const { setup, plain } = engine.standing();
  const { origin } = engine;
  const pass = {
    solve,
    origin,
    setup,
    report: { ...report, history: [], breaks: [] },
    energy,
    breaks,
  };
  waiting.push(squeeze(plain).then((bytes) => ({ ...pass, bytes })));
}

/** Those that were put away since the last time. */
export function takePasses(): Promise<Pass[]> {
  const taken = waiting;
  waiting = [];
  return Promise.all(taken);
}
