/**
 * What a person can ask for: open, run, pause, step, reset, cancel.
 *
 * Commands change the store and tell the worker. Whatever goes wrong ends as a sentence in the
 * message bar; frames and curves live in the store and survive a broken or stopped worker.
 */

import { during } from "./busy";
import { announce } from "./dom";
import {
  answer,
  forgetAsked,
  hold,
  look,
  lookThrough,
  prepare,
  show,
  viewer,
  want,
} from "./looking";
import { presentFound, putAway } from "./memory/held";
import type { Setting } from "./memory/setting";
import { adopt, follows, knows, sameFrames } from "./opened";
import { paceOf } from "./pace";
import { standingAt } from "./timeline/line";
import { sceneOf } from "./scenes";
import { store, type State } from "./store";
import { text } from "./text";
import { sentence } from "./wording";
import { Client, Ended, type Remote } from "./worker/client";
import type { Failure, Found, FrameFile, Part, Setup, Source, Wanted } from "./worker/protocol";

/** How long the worker may take to answer before cancelling ends it. */
const PATIENCE_MS = 1500;

const client = new Client("solver", {
  progress: show,
  failure: (failure) => {
    answer();
    failed(failure, true);
  },
});

lookThrough((use) => attempt(null, () => client.call(use)));

/** Loads the core; `memory/first.ts` says what is opened first. */
export async function load(): Promise<boolean> {
  await attempt(text.waits.loading, async () => {
    store.update({ catalogues: await client.call((service) => service.catalogues()) });
  });
  return store.state.catalogues !== null;
}

export function openScene(name: string, setting?: Partial<Setting>): Promise<boolean> {
  return open(sceneOf(name), text.waits.rendering, setting);
}

/**
 * Opens a pair, set as `setting` says and else as a new one is, with the result that was found with it; what was open
 * stays when this one is no good.
 */
export function open(
  source: Source,
  phrase: string,
  setting: Partial<Setting> = {},
  found: Found | null = null,
): Promise<boolean> {
  store.update({ opening: source });
  return attempt(phrase, async () => {
    try {
      await client.inTurn(async (service) => {
        // Another may have been chosen while this one waited.
        if (store.state.opening !== source) return;
        const { opened, keep, refused } = await openWith(service, source, setting, found);
        forgetAsked();
        const shown = opened.restored ? found : null;
        adopt(source, opened, { keep, setting: refused ? {} : setting, found: shown });
        if (refused) store.update({ message: sentence(refused) });
        await look();
        prepare(setupOf(store.state));
        announce(text.page.isOpen(opened.title, opened.width, opened.height));
      });
    } finally {
      if (store.state.opening === source) store.update({ opening: null });
    }
  });
}

/**
 * Opens a pair with as much of `setting` as is given, the present options where it gives none: a preset that was
 * chosen because the other refuses the frames is the one to open them with. What is refused of all that is left out.
 */
async function openWith(
  service: Remote,
  source: Source,
  setting: Partial<Setting>,
  found: Found | null,
) {
  const { state } = store;
  const keep = Object.keys(setting).length === 0 && sameFrames(source, state.source);
  const { shapes, camera, options = state.options } = setting;
  const given = { ...(shapes && { shapes }), ...(camera && { camera }), options };
  const setup: Partial<Setup> = keep ? setupOf(state) : given;
  try {
    return { opened: await service.open(source, setup, found), keep, refused: null };
  } catch (error) {
    const { name, message } = error as Error;
    const { preset } = options;
    const plain: Partial<Setup> = { options: preset ? { preset } : {} };
    const same = JSON.stringify(plain) === JSON.stringify(setup);
    if (keep || same || name !== "Error" || error instanceof Ended) throw error;
    return { opened: await service.open(source, plain, null), keep, refused: message };
  }
}

/** Goes on to the next pair of a film, `next` after the second frame, from what was found; `false` when it is refused. */
export function follow(next: FrameFile, note: string): Promise<boolean> {
  return attempt(text.waits.nextPair, () =>
    client.inTurn(async (service) => {
      const { source } = store.state;
      if (source?.kind !== "files") return;
      const followed = await service.follow(next);
      forgetAsked();
      follows({ kind: "files", first: source.second, second: next, note }, followed);
      await look();
    }),
  );
}

/** Takes files for what is true of the pair that is open; `false` when they are refused. */
export function takeTruth(truth: FrameFile[]): Promise<boolean> {
  return attempt(text.truth.reading, () =>
    client.inTurn(async (service) => {
      const { source } = store.state;
      if (source?.kind !== "files") return;
      const known = await service.setTruth(truth);
      forgetAsked();
      knows({ ...source, truth }, known);
      await look();
    }),
  );
}

/** Whether a sequence was asked for since the state was `then`, and was not refused. */
export function overtaken(then: Pick<State, "source" | "opening">): boolean {
  const { source, opening } = store.state;
  const since = [source, opening].filter((pair) => pair !== then.source && pair !== then.opening);
  return since.some((pair) => pair?.kind === "scene");
}

const setupOf = (state: Readonly<State>): Setup => ({
  camera: state.camera,
  shapes: state.shapes,
  options: { ...state.options },
});

/**
 * Sends the solver to work, and looks anew at where it stands: what was computed before would tell of another state.
 * What is refused leaves everything as it was.
 */
export async function command(
  patch: Partial<State>,
  use: (service: Remote, setup: Setup, wanted: Wanted) => Promise<void>,
): Promise<boolean> {
  const { running, started } = store.state;
  forgetAsked();
  store.update({ ...patch, visit: null, working: null });
  const done = await attempt(null, () =>
    client.inTurn((service) => use(service, setupOf(store.state), want())),
  );
  if (!done) store.update({ running: running && store.state.running, started });
  return done;
}

export async function run(): Promise<void> {
  if (store.state.running) return;
  const patch = { running: true, started: true, selected: null };
  const done = await command(patch, (service, setup, wanted) => {
    prepare(setup);
    return service.run(setup, wanted, paceOf(store.state));
  });
  if (done) announce(text.run.running);
}

/** Tells the worker of another pace; a run that begins takes its own along. */
export async function keepPace(): Promise<void> {
  if (!store.state.running) return;
  const pace = paceOf(store.state);
  await attempt(null, () => client.call((service) => service.pace(pace)));
}

/** The worker finishes the step it is in; the progress after it says that it has stopped. */
export async function pause(): Promise<void> {
  await attempt(null, () => client.inTurn((service) => service.pause()));
}

export function step(part: Part): Promise<boolean> {
  return command({ started: true }, (service, setup, wanted) => service.step(setup, part, wanted));
}

/** Shows what was put away, with what is set. */
export function restore(found: Found): Promise<boolean> {
  const { report, contours } = found;
  // The worker may be asked for it only once it has it.
  const held = putAway(found, store.state);
  const patch = { started: true, selected: null, report, contours, held };
  return command(patch, (service, setup, wanted) => service.restore(setup, found, wanted));
}

/** The present result, put away; `null` when there is none, or it could not be. */
export function keep(): Promise<Found | null> {
  return ask(null, (service) => service.keep());
}

export async function reset(): Promise<boolean> {
  const done = await command({}, (service, setup, wanted) => service.reset(setup, wanted));
  if (done) announce(text.run.backAtCurves);
  return done;
}

/** Stops at once: asks first, and ends the worker when it does not answer. */
export async function cancel(): Promise<void> {
  // Without the page's settings, which may be what is wrong. A refusal is an answer, too.
  const polite = client
    .inTurn((service) => service.reset(null, want()))
    .then(
      () => true,
      (error: Error) => error.name !== "Panic",
    );
  const late = new Promise<boolean>((resolve) => setTimeout(() => resolve(false), PATIENCE_MS));
  const answered = await Promise.race([polite, late]);
  store.update({ running: false, started: false, visit: null, working: null });
  if (!answered) {
    await recover(true);
    // What hung may have been the core's own loading.
    if (!store.state.catalogues) void load();
  }
  announce(text.run.cancelled);
}

/** What has not been sent yet, and so will tell of later changes, too. */
let configuring: Promise<void> | null = null;

/** Tells the worker of changed curves, camera or options: the latest only, one at a time. */
export async function configure(): Promise<void> {
  // What was wrong with the last setting says nothing of the next. Taken down now, not once the
  // worker has answered: by then the message may be that of a later one.
  store.update({ message: null });
  configuring ??= client.inTurn(configured);
  const mine = configuring;
  await attempt(null, () => mine);
  // It may have ended with its worker before it was sent.
  if (configuring === mine) configuring = null;
}

async function configured(service: Remote): Promise<void> {
  configuring = null;
  try {
    await service.configure(setupOf(store.state));
  } catch (error) {
    // Nobody needs to hear what was wrong with a setting that has been changed since.
    if (!configuring || (error as Error).name === "Panic") throw error;
  }
}

/** Anything else that is asked of the worker. */
export async function ask<T>(
  phrase: string | null,
  use: Parameters<typeof client.call<T>>[0],
): Promise<T | null> {
  let answer: T | null = null;
  await attempt(phrase, async () => {
    answer = await client.call(use);
  });
  return answer;
}

/** The same of whoever shows what is looked at: of a pass left behind, that is the viewer. */
export async function askShown<T>(
  phrase: string | null,
  use: Parameters<typeof client.call<T>>[0],
): Promise<T | null> {
  const { source, timeline, visit } = store.state;
  const standing = timeline && visit && standingAt(timeline, visit);
  if (!source || !standing) return ask(phrase, use);
  let answer: T | null = null;
  await attempt(phrase, async () => {
    answer = await viewer.ask(source, standing, use);
  });
  return answer;
}

/** Runs a command; `false` when it failed, which the message bar then explains. */
function attempt(phrase: string | null, work: () => Promise<unknown>): Promise<boolean> {
  return during(phrase, async () => {
    try {
      await work();
      return true;
    } catch (error) {
      if (!(error instanceof Ended)) {
        const { name, message } = error as Error;
        if (name === "Unloaded") unloaded(message);
        else failed({ message, panic: name === "Panic" });
      }
      return false;
    }
  });
}

function failed({ message, panic }: Failure, stopped = panic): void {
  store.update({
    // What is refused changes nothing: a run goes on as it was.
    running: store.state.running && !stopped,
    message: panic ? text.page.brokeDown(sentence(message)) : sentence(message),
  });
  if (panic) void recover();
}

/** The next worker loads the core again. */
function unloaded(reason: string): void {
  const message = text.page.notLoaded(sentence(reason));
  failed({ message, panic: false }, true);
  void recover();
}

let recovering: Promise<boolean> | null = null;

/** A new worker with the same frames, curves and settings. One that breaks down as well is left until someone cancels. */
async function recover(byHand = false): Promise<void> {
  if (recovering && !byHand) return;
  // A hang that was cancelled may be of what was found.
  const found = byHand ? null : presentFound(store.state);
  client.restart();
  const reopened = attempt(text.waits.afresh, () =>
    client.inTurn((service) => reopen(service, found)),
  );
  recovering = reopened;
  // Commands that were under way end first, and say what they know of the run.
  await new Promise((next) => setTimeout(next));
  hold();
  const nothing = { started: false, report: null, contours: [], scores: null };
  store.update({ running: false, ...nothing, visit: null, working: null });
  const open = await reopened;
  if (recovering !== reopened) return;
  recovering = null;
  forgetAsked();
  if (open) await look();
}

async function reopen(service: Remote, found: Found | null): Promise<void> {
  const { source } = store.state;
  if (!source) return;
  try {
    await service.open(source, setupOf(store.state), found);
  } catch {
    // Frames are there for whoever mends the setting; what is wrong with it is said when it is used.
    await service.open(source, {}, null);
  }
}
