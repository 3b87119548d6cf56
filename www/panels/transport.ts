/** Run, pause, step, reset, cancel, and the line that says where the computation stands. */

import { byId, icon, make } from "../dom";
import { number, seconds } from "../format";
import { nextFrame, nextPair } from "../intake/reel";
import { PACES, paceOf } from "../pace";
import { giveUp, startOver } from "../memory/history";
import { keepPace, pause, run, step } from "../session";
import { store, type State } from "../store";
import { text } from "../text";
import { expectation } from "../wording";
import type { Part } from "../worker/protocol";

const words = text.status;

const parts = () => document.querySelectorAll<HTMLButtonElement>("[data-part]");

export function mountTransport(): void {
  const main = byId<HTMLButtonElement>("run");
  main.addEventListener("click", () => void (store.state.running ? pause() : run()));
  byId("step").addEventListener("click", () => void step("all"));
  byId("reset").addEventListener("click", () => void startOver());
  byId("cancel").addEventListener("click", () => void giveUp());
  for (const button of parts()) {
    button.addEventListener("click", () => void step(button.dataset["part"] as Part));
  }

  mountNextPair();

  const pace = byId<HTMLSelectElement>("pace");
  pace.append(...PACES.map(({ value, label }) => make("option", { value }, label)));
  pace.addEventListener("change", () => store.update({ pace: Number(pace.value) }));
  store.watch(
    (state) => [paceOf(state)],
    (state) => {
      pace.value = String(paceOf(state));
      void keepPace();
    },
  );

  store.watch(
    ({ running, busy, frames, started, report, working, playing }) => [
      playing,
      running,
      busy,
      frames,
      started,
      (working ?? report)?.status,
    ],
    (state) => {
      const { running, busy, frames, started, playing } = state;
      const report = state.working ?? state.report;
      const over = started && report !== null && report.status !== "running";
      const name = running ? text.run.pause : over ? text.run.again : text.run.run;
      main.replaceChildren(icon(running ? "pause" : "run"), name);
      const idle = frames !== null && busy === null;
      main.disabled = !idle;
      const held = document.activeElement;
      // A solver that has come to its end takes no step before it starts over.
      const takesSteps = idle && !running && !over;
      byId<HTMLButtonElement>("step").disabled = !takesSteps;
      byId<HTMLButtonElement>("reset").disabled = !idle || !started;
      for (const button of parts()) button.disabled = !takesSteps;
      // A button that is disabled or hidden cannot hold the keyboard's place.
      if (held?.closest(".transport") && held.matches(":disabled, [hidden]")) main.focus();
      // A recording that plays while the core loads is nothing to wait for.
      byId("cancel").hidden = !running && (busy === null || playing);
      document.body.dataset["running"] = String(running);
    },
  );
  store.watch(
    ({ report, working, running, started, busy, playing }) => [
      report,
      working,
      running,
      started,
      busy,
      playing,
    ],
    (state) => {
      byId("status").textContent = standing(state);
      const expected =
        state.started && !state.busy && !state.running ? state.report?.expected : null;
      byId("expected").textContent = expected ? expectation(expected) : "";
    },
  );
}

/** After a solve, the next pair of the film that this one is from. */
function mountNextPair(): void {
  const button = byId<HTMLButtonElement>("next-pair");
  button.addEventListener("click", () => void nextPair());
  store.watch(
    ({ reel, source, running, busy, started }) => [reel, source, running, busy, started],
    (state) => {
      const { reel, running, busy, started } = state;
      const next = nextFrame(state);
      button.hidden = next === null || !started;
      button.disabled = running || busy !== null;
      if (next === null || !reel?.pair) return;
      const [from, to] = [reel.pair.at[1], next].map((index) => reel.film.label(index));
      button.title = text.run.nextPair(from!, to!);
    },
  );
}

/** One line: how far, how it ended, how much energy is left, how long it took. */
export function standing(state: Readonly<State>): string {
  const { running, started, busy, frames, playing } = state;
  // Of the solver, whichever pass is looked at.
  const report = state.working ?? state.report;
  if (busy && !playing) return words.waiting(busy);
  if (!frames && !playing) return "";
  if (!report || !started) return words.ready;
  const { iterations, level, levels, status, energy } = report;
  const parts = [
    playing ? words.recorded : running ? words.running : words.ended[status],
    words.passes(iterations),
  ];
  if (levels > 1) parts.push(words.scale(levels - level, levels));
  parts.push(`E ${number(energy.total)}`);
  if (report.seconds.total > 0) parts.push(seconds(report.seconds.total));
  return parts.map((part) => part.replaceAll(" ", "\u00a0")).join("\u00a0· ");
}
