/**
 * Puts a step of a lesson on the stage: its pair, curves, options and view, and the solve that it asks for.
 *
 * A step that differs from the one before by the view alone keeps what was found.
 */

import { lead } from "../memory/address";
import { settingsOf } from "../memory/held";
import { targetOf } from "../memory/link";
import { run, step as takeStep } from "../session";
import { store } from "../store";
import { goOn, goTo } from "../timeline/going";
import type { Source } from "../worker/protocol";
import type { Step } from "./lesson";

/** What the last step left on the stage. */
let set: { setup: string; source: Source | null; settings: string } | null = null;
/** Steps called for; only the last is set up. */
let called = 0;

export async function stage(step: Step): Promise<void> {
  const { catalogues } = store.state;
  const target = catalogues && targetOf(step.state, catalogues);
  if (!target) return;
  called += 1;
  const mine = called;
  const setup = setupIn(step.state);
  if (isSet(setup)) {
    const { viewParams = store.state.viewParams } = target.setting ?? {};
    store.update({ viewParams, split: null, ...(target.view && { view: target.view }) });
  } else {
    if (!(await lead(target)) || mine !== called) return;
    store.update({ split: null });
  }
  const { source, started } = store.state;
  set = { setup, source, settings: settingsOf(store.state) };
  if (!started && !store.state.running) {
    if (step.solve === "run") await run();
    for (let pass = 0; pass < Number(step.solve) && mine === called; pass += 1)
      await takeStep("all");
  }
  if (!step.beside) return store.update({ beside: false });
  await solved();
  if (mine === called && set.source === store.state.source) await branch(step.beside);
}

/** Waits until nothing runs. */
function solved(): Promise<void> {
  return new Promise((done) => {
    let stop = () => {};
    stop = store.watch(
      ({ running }) => [running],
      ({ running }) => {
        // The first time is within `watch`.
        if (!running) void Promise.resolve().then(() => (stop(), done()));
      },
    );
  });
}

/** Solves once more from the start with an option set otherwise, as a second line, and shows both. */
async function branch(option: string): Promise<void> {
  const { timeline, options } = store.state;
  const [key = "", value = ""] = option.split(":");
  if (!timeline) return;
  await goTo({ line: 0, at: timeline.first });
  store.update({ options: { ...options, [key]: value }, beside: true });
  await goOn();
}

/** Whether the stage has this pair, set so, and nobody has changed it since. */
function isSet(setup: string): boolean {
  const { state } = store;
  return (
    set !== null &&
    set.setup === setup &&
    set.source === state.source &&
    set.settings === settingsOf(state)
  );
}

/** A link without its view and how that is set: what the solver sees. */
function setupIn(link: string): string {
  const [place = "", query = ""] = link.split("?");
  const seen = query.split("&").filter((part) => !part.startsWith("p="));
  return [place.split("/")[0], ...seen].join("&");
}
