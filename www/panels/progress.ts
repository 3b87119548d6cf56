/** What is being done in one sentence, a bar, and the time that is left. */

import { byId, make } from "../dom";
import { paceOf } from "../pace";
import { estimate, type PassTime } from "../progress";
import { store, type State } from "../store";
import { text } from "../text";
import { remaining } from "../wording";
import type { Report } from "../worker/protocol";

let passes: PassTime[] = [];
let at = 0;
let seen = 0;

export function mountProgress(): void {
  store.watch(
    ({ running }) => [running],
    ({ running, report, working }) => {
      if (!running) return;
      passes = [];
      at = performance.now();
      seen = (working ?? report)?.iterations ?? 0;
    },
  );
  store.watch(
    ({ report, working, running, busy, playing }) => [report, working, running, busy, playing],
    (state) => {
      const report = state.working ?? state.report;
      if (state.running && report) count(report);
      show(state);
    },
  );
}

/** The screen may miss passes: those are taken to have been alike. */
function count({ iterations, level }: Report): void {
  // A run that starts over counts from one again.
  if (iterations < seen) [passes, seen] = [[], 0];
  const made = iterations - seen;
  if (made === 0) return;
  const now = performance.now();
  for (let i = 0; i < made; i++) passes.push({ level, time: (now - at) / made });
  [at, seen] = [now, iterations];
}

function show(state: Readonly<State>): void {
  const { running, busy, playing } = state;
  const report = state.working ?? state.report;
  const bar = byId<HTMLProgressElement>("progress");
  bar.hidden = !running && (busy === null || playing);
  const doing = byId("doing");
  if (!running || !report) {
    bar.removeAttribute("value");
    doing.textContent = "";
    return;
  }
  const { done, left } = estimate(report, passes, paceOf(state));
  // It does not go back when an estimate was too bright.
  const before = passes.length > 1 ? bar.value : 0;
  bar.value = Math.max(before, Math.min(0.99, done));
  // A narrow screen has room for the time alone.
  doing.replaceChildren(
    make("span", { class: "task" }, `${task(report, state)} `),
    make("span", { class: "left" }, remaining(left)),
  );
}

function task({ level, levels, iterations }: Report, { options, shapes }: Readonly<State>): string {
  const { paper, whole, noCurves, coarse, starting, full } = text.progress;
  if (options.preset === "paper") return paper;
  const what = shapes.length > 0 ? whole : noCurves;
  if (level > 0) return coarse(what, levels - level, levels);
  return iterations === 0 ? starting : full(what);
}
