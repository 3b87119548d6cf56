/**
 * The worker: runs the solver a step at a time, and listens in between. What the page hears of it is `telling.ts`.
 */

import * as Comlink from "comlink";

import { text } from "../text/worker";
import { catalogues, fileKind, load, panicMessage, viewsOf } from "./core";
import { Engine } from "./engine";
import { keepPass } from "./passes";
import { fieldsOf, measure, preview } from "./pictures";
import type { Failure, Service, Setup, Wanted } from "./protocol";
import { buffersOf, Teller } from "./telling";

/** A pass that takes longer keeps those waiting who look at something else meanwhile, milliseconds. */
const LONG_MS = 150;

const engine = new Engine();
const ready = load();

let running = false;
/** How long the last pass took, milliseconds. */
let took = 0;
/** Least time of a pass, milliseconds. */
let pace = 0;
let looping = false;
let fail: (failure: Failure) => void = () => {};

const teller = new Teller(
  engine,
  () => ({ running, slow: took > LONG_MS }),
  (error) => {
    running = false;
    fail(describe(error));
  },
);

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
      teller.publish();
      // Before a pass in which nobody is heard, what the last one came to is on its way.
      if (took > LONG_MS) await teller.told(LONG_MS);
      await rest(running ? start + pace - performance.now() : 0);
    }
  } catch (error) {
    running = false;
    fail(describe(error));
  } finally {
    looping = false;
    teller.publish();
  }
}

/** Curves or weights that change leave the pass count alone but not what there is to see. */
function configure(setup: Setup): void {
  if (engine.configure(setup)) teller.forgetMesh();
}

/** Work for the solver, as it is set and looked at now. Where things stand is told even when it is refused. */
function obey(setup: Setup | null, wanted: Wanted, work: () => void): Promise<void> {
  return guard(() => {
    teller.lookAt(wanted);
    try {
      if (setup) configure(setup);
      work();
    } catch (error) {
      if (!(error instanceof WebAssembly.RuntimeError)) teller.publish();
      throw error;
    }
    teller.publish();
  });
}

/** Bytes that the page takes and the worker gives up. */
const moved = (bytes: Uint8Array<ArrayBuffer>) => Comlink.transfer(bytes, [bytes.buffer]);
const allMoved = (files: Uint8Array<ArrayBuffer>[]) =>
  Comlink.transfer(
    files,
    files.map(({ buffer }) => buffer),
  );

const service: Service = {
  catalogues: () => guard(catalogues),

  async subscribe(progress, failure) {
    teller.send = progress;
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

  views: (bytes) => guard(async () => allMoved(await viewsOf(bytes))),

  fields: (file) => guard(async () => allMoved(await fieldsOf(file))),

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
      teller.lookAt(wanted);
      teller.publish();
    }),

  visit: (standing, wanted) =>
    guard(async () => {
      await engine.visit(standing);
      teller.lookAt(wanted);
      teller.publish();
    }),

  apart: (one, other) => guard(() => engine.apart(one, other)),

  goOn: (standing, at, setup, wanted, least) =>
    guard(async () => {
      stop();
      const begun = await engine.goOn(standing, at, setup);
      teller.lookAt(wanted);
      pace = least;
      running = true;
      void loop();
      teller.publish();
      return begun;
    }),

  follow: (next) =>
    guard(async () => {
      stop();
      const followed = await engine.follow(next);
      teller.forgetMesh();
      return Comlink.transfer(followed, followed.frames);
    }),

  find: (camera) => guard(() => engine.find(camera)),

  findFocal: (camera) => guard(() => engine.findFocal(camera)),

  configure: (setup) =>
    guard(() => {
      configure(setup);
      teller.publish();
    }),

  look: (wanted) =>
    guard(() => {
      teller.lookAt(wanted);
      teller.publish();
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

Comlink.expose(service);
