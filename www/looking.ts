/**
 * What the page looks at: asks for it, and takes in what comes, from the solver where it stands or, of a pass that it has
 * left behind, from the viewer.
 */

import { announce } from "./dom";
import { store } from "./store";
import { text } from "./text";
import { entered, keptAt, reportAt, standingAt, type Visit } from "./timeline/line";
import { Viewer } from "./viewer";
import { wantedBy } from "./views";
import { sentence } from "./wording";
import type { Remote } from "./worker/client";
import type { MeshData, Progress, Setup, Standing, Wanted } from "./worker/protocol";

let meshListener: (mesh: MeshData) => void = () => {};

/** The relief view hears of new meshes here: they are too large to keep in the store. */
export function onMesh(listener: (mesh: MeshData) => void): void {
  meshListener = listener;
}

type Ask = (use: (service: Remote) => Promise<void>) => Promise<boolean>;
let askSolver: Ask = async () => false;

/** How the solver is asked. */
export function lookThrough(ask: Ask): void {
  askSolver = ask;
}

export const viewer = new Viewer(
  (message) => {
    // A solver in a pass draws it all the same, only later.
    if (!store.state.visit) return;
    void visit(null);
    store.update({ message: sentence(message) });
  },
  (progress) => {
    const { pictures, legends, view } = progress;
    // What is chosen by now is on its way.
    const wanted = (slow || store.state.visit) && view === store.state.pictured;
    if (!wanted) return pictures.forEach((one) => one?.close());
    const kept = <T>(all: (T | null)[], last: (T | null)[]) =>
      all.map((one, i) => one ?? last[i] ?? null);
    const sharp = kept(pictures, store.state.pictures);
    for (const [i, old] of store.state.pictures.entries()) if (old !== sharp[i]) old?.close();
    store.update({ pictures: sharp, legends: kept(legends, store.state.legends) });
  },
);

/** The last pass of a solver whose passes take long, for the viewer to draw meanwhile. */
let slow: Standing | null = null;

/** In frames of more pixels any pass may be a long one. */
const SMALL = 200_000;
const large = () => store.state.width * store.state.height > SMALL;

/** The viewer opens the frames, to be there once a run has begun. */
export function prepare(setup: Setup): void {
  const { source } = store.state;
  if (source && large()) void viewer.warm(source, setup);
}

/** Counts what was asked for, so that answers to earlier questions can be told. */
let asked = 0;
let answered = 0;
let lookAgain = false;

/** Tells the workers what the page is looking at: the latest only, once the last was answered. */
export async function look(): Promise<void> {
  const { frames, source, visit } = store.state;
  if (!frames || !source) return;
  if (visit) return lookBack();
  if (slow) void lookAhead(slow);
  if (asked !== answered) {
    lookAgain = true;
    return;
  }
  await tell();
}

async function tell(): Promise<void> {
  const sent = await askSolver((service) => service.look(want()));
  if (!sent) answered = asked;
}

/** Shows what there is while the solver is in a pass. */
async function lookAhead(standing: Standing): Promise<void> {
  const { source } = store.state;
  const drawn = await viewer.show(source!, standing, wantedBy(store.state));
  if (!drawn) return;
  if (slow !== standing || store.state.visit) return drawn.pictures.forEach((one) => one?.close());
  draw(drawn);
}

/** Shows a pass that the solver has left behind. */
async function lookBack(): Promise<void> {
  const { source, timeline, visit } = store.state;
  const standing = timeline && visit && standingAt(timeline, visit);
  if (!source || !standing) return;
  const drawn = await viewer.show(source, standing, wantedBy(store.state));
  if (!drawn) return;
  if (store.state.visit !== visit) return drawn.pictures.forEach((one) => one?.close());
  draw(drawn);
  store.update({ contours: drawn.contours, scores: drawn.scores });
}

function draw({ pictures, legends, view, mesh }: Progress): void {
  for (const old of store.state.pictures) old?.close();
  store.update({ pictures, legends, pictured: view });
  if (mesh) meshListener(mesh);
}

/** A question about several passes, put to the viewer. */
export async function askOf<T>(
  standing: Standing,
  use: (service: Remote) => Promise<T>,
): Promise<T | null> {
  const { source } = store.state;
  return source && viewer.ask(source, standing, use, true);
}

/**
 * Goes to a pass of the timeline, or, without one, to where the solver stands; resolves when it is drawn, or another was
 * asked for.
 */
export async function visit(to: Visit | null): Promise<void> {
  const { state } = store;
  const { timeline } = state;
  if (!to || !timeline) {
    if (!state.visit) return;
    store.update({ visit: null, report: state.working, working: null });
    forgetAsked();
    if (state.running) slow ??= timeline?.lines.at(-1)?.passes.at(-1)?.pass ?? null;
    return look();
  }
  const kept = keptAt(timeline, to);
  const line = timeline.lines[to.line]!;
  store.update({
    visit: to,
    working: state.visit ? state.working : state.report,
    report: kept && reportAt(timeline, line, kept),
    started: kept !== null,
  });
  if (!state.visit) {
    // The solver need not draw meanwhile.
    forgetAsked();
    void tell();
  }
  await lookBack();
}

/** Whatever is still on its way is no longer wanted. */
export function forgetAsked(): void {
  asked += 1;
  answered = asked;
  lookAgain = false;
}

/** Nothing on its way is wanted any more, nor is anything to be asked for until `forgetAsked`. */
export function hold(): void {
  asked += 1;
}

/** That was the answer. */
export function answer(): void {
  answered = asked;
}

export function want(): Wanted {
  asked += 1;
  const wanted = wantedBy(store.state);
  const nothing = store.state.visit ? { pictures: [], mesh: null } : {};
  return { ...wanted, ...nothing, id: asked };
}

/** Takes one progress of the solver in and resolves once it is drawn, which lets the worker send the next. */
export async function show(progress: Progress): Promise<void> {
  takePasses(progress);
  if (progress.id !== asked) {
    progress.pictures.forEach((picture) => picture?.close());
    return;
  }
  answered = asked;
  const { state } = store;
  const finished = state.running && !progress.running && progress.started;
  const { running, started, revision, report, contours, scores, view } = progress;
  if (state.visit) {
    store.update({ running, revision, working: report });
  } else {
    const pictures = progress.pictures.map((picture, i) => picture ?? state.pictures[i] ?? null);
    for (const [i, old] of state.pictures.entries()) if (old && pictures[i] !== old) old.close();
    const legends = progress.legends.map((legend, i) =>
      progress.pictures[i] ? legend : (state.legends[i] ?? null),
    );
    const shown = { report, contours, pictures, legends, pictured: view, scores };
    store.update({ running, started, revision, ...shown });
    if (progress.mesh) meshListener(progress.mesh);
  }
  if (!running) slow = null;
  if (finished) announce(text.ending[report.status](report.iterations));
  if (lookAgain) {
    lookAgain = false;
    void look();
  }
  if (!document.hidden) await new Promise((drawn) => requestAnimationFrame(drawn));
}

function takePasses({ passes, running, slow: long }: Progress): void {
  if (passes.length > 0) {
    store.update({ timeline: passes.reduce(entered, store.state.timeline) });
  }
  if (running && (long || large())) slow = passes.at(-1) ?? slow;
}
