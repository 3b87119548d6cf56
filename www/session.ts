/**
 * What a person can ask for: open, run, pause, step, reset, cancel, look.
 *
 * Commands change the store and tell the worker. Whatever goes wrong ends as a sentence in the
 * message bar; frames and curves live in the store and survive a broken or stopped worker.
 */

import { announce } from "./dom";
import { store, type State } from "./store";
import { wantedBy } from "./views";
import { ending, sentence } from "./wording";
import { Client, Ended } from "./worker/client";
import type {
  Failure,
  MeshData,
  Opened,
  Part,
  Progress,
  Setup,
  Source,
  Wanted,
} from "./worker/protocol";

/** Size at which built-in sequences are ray-cast. */
const SCENE_SIZE = { width: 320, height: 240 };
/** How long the worker may take to answer before cancelling ends it. */
const PATIENCE_MS = 1500;

let meshListener: (mesh: MeshData) => void = () => {};

/** The relief view hears of new meshes here: they are too large to keep in the store. */
export function onMesh(listener: (mesh: MeshData) => void): void {
  meshListener = listener;
}

const client = new Client({ progress: show, failure: (failure) => failed(failure, true) });

/** Loads the core and opens the first sequence. */
export async function start(): Promise<void> {
  await attempt("Loading", async () => {
    store.update({ catalogues: await client.call((service) => service.catalogues()) });
  });
  if (store.state.catalogues) await openScene("blocks");
}

export function openScene(name: string): Promise<boolean> {
  return open({ kind: "scene", name, ...SCENE_SIZE }, "Rendering the sequence");
}

/** Opens a pair; what was open stays when this one is no good. */
export function open(source: Source, phrase: string): Promise<boolean> {
  return attempt(phrase, async () => {
    const opened = await client.call((service) => service.open(source, null));
    forgetAsked();
    adopt(source, opened);
    await look();
    announce(`${opened.title} is open, ${opened.width} by ${opened.height} pixels.`);
  });
}

function adopt(source: Source, opened: Opened): void {
  store.state.frames?.forEach((frame) => frame.close());
  store.update({
    source,
    title: opened.title,
    lesson: opened.lesson,
    width: opened.width,
    height: opened.height,
    frames: opened.frames,
    names: opened.names,
    truth: opened.truth,
    shapes: opened.setup.shapes,
    camera: opened.setup.camera,
    focalFinding: null,
    selected: null,
    past: [],
    future: [],
    finding: null,
    running: false,
    started: false,
    report: null,
    contours: [],
    pictures: [],
    pictured: "",
    scores: null,
    scales: [],
    showing: "first",
    tool: "select",
  });
  // A view that needs the truth makes no sense without.
  if (!opened.truth && store.state.view === "compare") store.update({ view: "curves" });
}

const setupOf = (state: Readonly<State>): Setup => ({
  camera: state.camera,
  shapes: state.shapes,
  options: { ...state.options },
});

export async function run(): Promise<void> {
  if (store.state.running) return;
  store.update({ running: true, started: true, selected: null });
  const ok = await attempt(null, async () => {
    await client.call((service) => service.run(setupOf(store.state)));
    announce("Running.");
  });
  if (!ok) store.update({ running: false });
}

/** The worker finishes the step it is in; the progress after it says that it has stopped. */
export async function pause(): Promise<void> {
  await attempt(null, () => client.call((service) => service.pause()));
}

export function step(part: Part): Promise<boolean> {
  store.update({ started: true });
  return attempt(null, () => client.call((service) => service.step(setupOf(store.state), part)));
}

export async function reset(): Promise<void> {
  await attempt(null, async () => {
    await client.call((service) => service.reset(setupOf(store.state)));
    announce("Back at the drawn curves.");
  });
  store.update({ running: false, started: false });
}

/** Stops at once: asks first, and ends the worker when it does not answer. */
export async function cancel(): Promise<void> {
  const polite = client.call((service) => service.reset(setupOf(store.state))).then(() => true);
  const late = new Promise<boolean>((resolve) => setTimeout(() => resolve(false), PATIENCE_MS));
  const answered = await Promise.race([polite.catch(() => false), late]);
  if (!answered) await recover();
  store.update({ running: false, started: false, busy: null });
  announce("Cancelled; frames and curves are kept.");
}

/** Counts what was asked for, so that answers to earlier questions can be told. */
let asked = 0;
let answered = 0;
let lookAgain = false;

/** Tells the worker what the page is looking at: the latest only, once the last was answered. */
export async function look(): Promise<void> {
  if (!store.state.source) return;
  if (asked !== answered) {
    lookAgain = true;
    return;
  }
  const sent = await attempt(null, () => client.call((service) => service.look(want())));
  if (!sent) answered = asked;
}

/** Whatever is still on its way is no longer wanted. */
function forgetAsked(): void {
  asked += 1;
  answered = asked;
  lookAgain = false;
}

function want(): Wanted {
  asked += 1;
  return { id: asked, ...wantedBy(store.state) };
}

let configuring: Promise<void> | null = null;
let configureAgain = false;

/** Tells the worker of changed curves, camera or options: the latest only, one at a time. */
export async function configure(): Promise<void> {
  // What was wrong with the last setting says nothing of the next. Taken down now, not once the
  // worker has answered: by then the message may be that of a later one.
  store.update({ message: null });
  await attempt(null, configured);
}

async function configured(): Promise<void> {
  if (configuring) {
    configureAgain = true;
    return configuring;
  }
  configuring = (async () => {
    do {
      configureAgain = false;
      await client.call((service) => service.configure(setupOf(store.state)));
    } while (configureAgain);
  })();
  try {
    await configuring;
  } finally {
    configuring = null;
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

/** Runs a command; `false` when it failed, which the message bar then explains. */
async function attempt(phrase: string | null, work: () => Promise<unknown>): Promise<boolean> {
  if (phrase) store.update({ busy: phrase });
  try {
    await work();
    return true;
  } catch (error) {
    if (!(error instanceof Ended)) {
      const { name, message } = error as Error;
      failed({ message, panic: name === "Panic" });
    }
    return false;
  } finally {
    if (phrase) store.update({ busy: null });
  }
}

function failed({ message, panic }: Failure, stopped = panic): void {
  store.update({
    // What is refused changes nothing: a run goes on as it was.
    running: store.state.running && !stopped,
    message: panic
      ? `The computation broke down (${sentence(message)}) It was started afresh; your frames and curves are kept.`
      : sentence(message),
  });
  if (panic) void recover();
}

let recovering = false;

/** A new worker with the same frames, curves and settings. */
async function recover(): Promise<void> {
  if (recovering) return;
  recovering = true;
  try {
    client.restart();
    // Commands that were under way end first, and with them what they said the page was busy with.
    await new Promise((next) => setTimeout(next));
    forgetAsked();
    const { source } = store.state;
    store.update({
      busy: "Starting afresh",
      running: false,
      started: false,
      report: null,
      contours: [],
      scores: null,
    });
    if (!source) return;
    await client.call((service) => service.open(source, setupOf(store.state)));
    await client.call((service) => service.look(want()));
  } catch (error) {
    if (!(error instanceof Ended)) store.update({ message: sentence((error as Error).message) });
  } finally {
    recovering = false;
    store.update({ busy: null });
  }
}

/** Takes one progress in and resolves once it is drawn, which lets the worker send the next. */
async function show(progress: Progress): Promise<void> {
  const { state } = store;
  if (progress.id !== asked) {
    progress.pictures.forEach((picture) => picture?.close());
    return;
  }
  answered = asked;
  const pictures = progress.pictures.map((picture, i) => picture ?? state.pictures[i] ?? null);
  for (const [i, old] of state.pictures.entries()) if (old && pictures[i] !== old) old.close();
  const finished = state.running && !progress.running;
  store.update({
    running: progress.running,
    report: progress.report,
    contours: progress.contours,
    pictures,
    pictured: progress.view,
    scores: progress.scores,
  });
  if (progress.mesh) meshListener(progress.mesh);
  if (finished) announce(ending(progress.report));
  if (lookAgain) {
    lookAgain = false;
    void look();
  }
  if (!document.hidden) await new Promise((drawn) => requestAnimationFrame(drawn));
}
