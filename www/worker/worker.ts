/**
 * The worker: runs the solver a step at a time, listens in between, and tells the page what changed.
 *
 * Progress is sent only when the page has drawn the last one, so however fast the solver or slow the
 * screen, there is never more than one on its way.
 */

import * as Comlink from "comlink";

import { text } from "../text/worker";
import { catalogues, fileKind, load, panicMessage, viewsOf } from "./core";
import { Engine } from "./engine";
import { keepPass, takePasses } from "./passes";
import { fieldsOf, measure, preview } from "./pictures";
import type {
  Failure,
  MeshData,
  PictureRequest,
  Progress,
  Service,
  Setup,
  Wanted,
} from "./protocol";

/** A pass that takes longer keeps those waiting who look at something else meanwhile, milliseconds. */
const LONG_MS = 150;
/** Least time between two reliefs: a new triangulation is work for the page. */
const MESH_INTERVAL_MS = 400;

/** So long the page is left in peace before it gets pictures as sharp as its screen in the place of quick ones. */
const SHARPEN_MS = 250;

const engine = new Engine();
const ready = load();

let running = false;
/** How long the last pass took, milliseconds. */
let took = 0;
/** Least time of a pass, milliseconds. */
let pace = 0;
let looping = false;
let look = begun({ id: 0, view: "", pictures: [], longest: 1, mesh: null });
let send: (progress: Progress) => Promise<void> = async () => {};
let fail: (failure: Failure) => void = () => {};

/** Lets waiting messages in. A message to oneself, since timers are held back to 4 ms. */
const turn = new MessageChannel();
const breathe = () =>
  new Promise<void>((resolve) => {
    turn.port1.onmessage = () => resolve();
    turn.port2.postMessage(null);
  });

/** Ends the rest between two passes. */
let wake = () => {};

/** Lets time pass, so that an eye can follow, until it is over or there is something to do. */
async function rest(milliseconds: number): Promise<void> {
  if (milliseconds <= 0) return breathe();
  await new Promise<void>((resolve) => {
    const timer = setTimeout(resolve, milliseconds);
    wake = () => {
      clearTimeout(timer);
      resolve();
    };
  });
}

function stop(): void {
  running = false;
  wake();
}

/** A broken core is told from bad input by the text its panic left behind. */
function describe(error: unknown): Failure {
  const left = panicMessage();
  if (left || error instanceof WebAssembly.RuntimeError) {
    return { message: left || String(error), panic: true };
  }
  return { message: error instanceof Error ? error.message : String(error), panic: false };
}

/** Runs `work` once the core is loaded; what it throws reaches the page as a sentence. */
async function guard<T>(work: () => T | Promise<T>): Promise<T> {
  try {
    await ready;
  } catch (error) {
    const reason = error instanceof Error ? error.message : String(error);
    throw Object.assign(new Error(text.notLoaded(reason)), { name: "Unloaded" });
  }
  try {
    return await work();
  } catch (error) {
    const { message, panic } = describe(error);
    if (panic) running = false;
    throw Object.assign(new Error(message), { name: panic ? "Panic" : "Error" });
  }
}

async function loop(): Promise<void> {
  if (looping) return;
  looping = true;
  try {
    while (running) {
      const start = performance.now();
      if (engine.step("all") !== "running") running = false;
      keepPass(engine);
      took = performance.now() - start;
      publish();
      // Before a pass in which nobody is heard, what the last one came to is on its way.
      if (took > LONG_MS) await told();
      await rest(running ? start + pace - performance.now() : 0);
    }
  } catch (error) {
    running = false;
    fail(describe(error));
  } finally {
    looping = false;
    publish();
  }
}

/** What the page looks at, with what it has of that already. */
interface Look {
  wanted: Wanted;
  /** Requests for pictures that no step changes (truth, baseline) and that were sent. */
  settled: Set<PictureRequest>;
  mesh: { iterations: number; at: number };
  /** The revision of which quick pictures were sent, and whether sharper ones are to come. */
  quick: { revision: number; blunt: boolean };
}

function begun(wanted: Wanted): Look {
  const quick = { revision: -1, blunt: false };
  return { wanted, settled: new Set(), mesh: { iterations: -1, at: -Infinity }, quick };
}

/** Where only the zoom is another, what is there is good until the sharper is. */
function looked(wanted: Wanted): Look {
  const same = (key: "view" | "pictures") =>
    JSON.stringify(wanted[key]) === JSON.stringify(look.wanted[key]);
  const next = begun(wanted);
  return same("view") && same("pictures") ? { ...next, quick: look.quick } : next;
}

let inFlight = false;
let stale = false;
/** The message that is being made, and the same until the page has taken it. */
let composed: Promise<unknown> = Promise.resolve();
let taken: Promise<unknown> = Promise.resolve();

/** Until the latest is on its way; a page that is busy is not waited for. */
async function told(): Promise<void> {
  const late = new Promise((resolve) => setTimeout(resolve, LONG_MS));
  if (stale) await Promise.race([taken, late]);
  await composed;
}

function publish(): void {
  clearTimeout(sharpening);
  if (inFlight) {
    stale = true;
    return;
  }
  inFlight = true;
  stale = false;
  const made = progress(look);
  composed = made.catch(() => {});
  taken = made
    .then(({ message, transfer }) => send(Comlink.transfer(message, transfer)))
    .catch((error: unknown) => {
      running = false;
      fail(describe(error));
    })
    .finally(() => {
      inFlight = false;
      if (stale) publish();
      else if (look.quick.blunt) sharpening = setTimeout(sharpen, SHARPEN_MS);
    });
}

let sharpening: ReturnType<typeof setTimeout> | undefined;

/** Quick pictures are followed by sharp ones once there is nothing else to do. */
function sharpen(): void {
  if (!running && !inFlight && look.quick.blunt) publish();
}

async function progress(to: Look): Promise<{ message: Progress; transfer: Transferable[] }> {
  const { wanted, settled } = to;
  const { revision } = engine;
  const report = engine.report();
  const contours = engine.contours();
  const quick = running || to.quick.revision !== revision;
  const blunt: PictureRequest[] = [];
  const transfer: Transferable[] = [];
  let mesh: Progress["mesh"] = null;
  if (wanted.mesh && meshIsDue(to, report.iterations)) {
    mesh = engine.mesh(wanted.mesh);
    transfer.push(...buffersOf(mesh));
    to.mesh = { iterations: report.iterations, at: performance.now() };
  }
  const scores = engine.scores();
  const pictures: (ImageBitmap | null)[] = [];
  const legends: Progress["legends"] = [];
  for (const request of wanted.pictures) {
    const drawn = settled.has(request)
      ? null
      : await engine.picture(request, wanted.longest, quick);
    if (drawn) transfer.push(drawn.picture);
    if (drawn?.blunt) blunt.push(request);
    else if (request.of !== "found") settled.add(request);
    pictures.push(drawn && drawn.picture);
    legends.push(drawn && drawn.legend);
  }
  to.quick = { revision, blunt: blunt.length > 0 };
  const passes = await takePasses();
  transfer.push(...passes.map(({ bytes }) => bytes.buffer));
  return {
    message: {
      id: wanted.id,
      view: wanted.view,
      running,
      started: running || engine.started,
      revision,
      report,
      contours,
      pictures,
      legends,
      mesh,
      scores,
      passes,
      slow: running && took > LONG_MS,
    },
    transfer,
  };
}

const buffersOf = (mesh: MeshData) =>
  Object.values(mesh).flatMap((list) => (typeof list === "number" ? [] : [list.buffer]));

function meshIsDue({ mesh }: Look, iterations: number): boolean {
  const rested = !running || performance.now() - mesh.at > MESH_INTERVAL_MS;
  return rested && mesh.iterations !== iterations;
}

/** Curves or weights that change leave the pass count alone but not what there is to see. */
function configure(setup: Setup): void {
  if (engine.configure(setup)) look.mesh.iterations = -1;
}

/** Work for the solver, as it is set and looked at now. Where things stand is told even when it is refused. */
function obey(setup: Setup | null, wanted: Wanted, work: () => void): Promise<void> {
  return guard(() => {
    look = looked(wanted);
    try {
      if (setup) configure(setup);
      work();
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) publish();
      throw error;
    }
    publish();
  });
}

const moved = (bytes: Uint8Array<ArrayBuffer>) => Comlink.transfer(bytes, [bytes.buffer]);

const service: Service = {
  catalogues: () => guard(catalogues),

  async subscribe(progress, failure) {
    send = progress;
    fail = failure;
  },

  preview: (file, longest) =>
    guard(async () => {
      const seen = await preview(file, longest);
      return Comlink.transfer(seen, [seen.picture]);
    }),

  truthKinds: (files, said) =>
    guard(() => files.map(({ name, bytes }) => fileKind(name, bytes, said) ?? null)),

  setTruth: (files) => guard(() => engine.setTruth(files)),

  views: (bytes) => guard(async () => handedOver(await viewsOf(bytes))),

  fields: (file) => guard(async () => handedOver(await fieldsOf(file))),

  displacement: (first, second) => guard(() => measure(first, second)),

  open: (source, keep, found) =>
    guard(async () => {
      const opened = await engine.open(source, keep, found);
      stop();
      return Comlink.transfer(opened, opened.frames);
    }),

  keep: () => guard(() => engine.keep()),

  restore: (setup, found, wanted) =>
    guard(async () => {
      stop();
      await engine.restore(setup, found);
      look = looked(wanted);
      publish();
    }),

  visit: (standing, wanted) =>
    guard(async () => {
      await engine.visit(standing);
      look = looked(wanted);
      publish();
    }),

  apart: (one, other) => guard(() => engine.apart(one, other)),

  goOn: (standing, at, setup, wanted, least) =>
    guard(async () => {
      stop();
      const begun = await engine.goOn(standing, at, setup);
      look = looked(wanted);
      pace = least;
      running = true;
      void loop();
      publish();
      return begun;
    }),

  follow: (next) =>
    guard(async () => {
      stop();
      const followed = await engine.follow(next);
      look.mesh.iterations = -1;
      return Comlink.transfer(followed, followed.frames);
    }),

  find: (camera) => guard(() => engine.find(camera)),

  findFocal: (camera) => guard(() => engine.findFocal(camera)),

  configure: (setup) =>
    guard(() => {
      configure(setup);
      publish();
    }),

  look: (wanted) =>
    guard(() => {
      look = looked(wanted);
      publish();
    }),

  run: (setup, wanted, least) =>
    obey(setup, wanted, () => {
      pace = least;
      if (engine.atEnd()) engine.reset();
      running = true;
      void loop();
    }),

  probe: (x, y, params) => guard(() => engine.probe(x, y, params)),

  mesh: (params) =>
    guard(() => {
      const mesh = engine.mesh(params);
      return Comlink.transfer(mesh, buffersOf(mesh));
    }),

  pace: (milliseconds) =>
    guard(() => {
      pace = milliseconds;
      wake();
    }),

  pause: () => guard(stop),

  step: (setup, part, wanted) =>
    obey(setup, wanted, () => {
      stop();
      engine.step(part);
      keepPass(engine);
    }),

  reset: (setup, wanted) =>
    obey(setup, wanted, () => {
      stop();
      engine.reset();
    }),

  file: (name, params) => guard(() => moved(engine.file(name, params))),

  png: (request) => guard(() => moved(engine.png(request))),
};

/** Bytes that the page takes and the worker gives up. */
const handedOver = (files: Uint8Array<ArrayBuffer>[]) =>
  Comlink.transfer(
    files,
    files.map(({ buffer }) => buffer),
  );

Comlink.expose(service);
