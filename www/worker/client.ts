/**
 * The page's end of the bridge: starts the worker, passes calls on, and puts up a new worker when the
 * old one broke or does not answer.
 */

import * as Comlink from "comlink";

import { text } from "../text";
import type { Failure, Progress, Service } from "./protocol";

export type Remote = Comlink.Remote<Service>;

type Listener = {
  /** Resolves when the progress is on the screen. */
  progress: (progress: Progress) => Promise<void>;
  failure: (failure: Failure) => void;
};

/** Thrown by calls that were under way when their worker was ended. */
export class Ended extends Error {
  constructor() {
    super("the computation was ended");
    this.name = "Ended";
  }
}

export class Client {
  private worker: Worker | null = null;
  private service: Remote | null = null;
  private abandon: (reason: Error) => void = () => {};
  private ended: Promise<never> = new Promise(() => {});
  private turn: Promise<unknown> = Promise.resolve();

  /** `name` is what the browser's tools call the worker. */
  constructor(
    private readonly name: "solver" | "viewer",
    private readonly listener: Listener,
  ) {}

  /** One call; rejects with a sentence, or with `Ended` when the worker was replaced meanwhile. */
  async call<T>(use: (service: Remote) => Promise<T>): Promise<T> {
    // The first call starts the first worker: until then the network is free for what is seen first.
    if (!this.service) this.start();
    return Promise.race([use(this.service!), this.ended]);
  }

  /**
   * A call that waits for those made in turn before: each opens a pair or speaks of the one that is open,
   * and the worker answers others while it opens one.
   */
  inTurn<T>(use: (service: Remote) => Promise<T>): Promise<T> {
    const mine = Promise.race([this.turn, this.ended]).then(() => this.call(use));
    this.turn = mine.catch(() => {});
    return mine;
  }

  /** Ends the worker, whatever it is doing, and puts up a new one, which knows nothing yet. */
  restart(): void {
    this.worker?.terminate();
    this.abandon(new Ended());
    this.turn = Promise.resolve();
    this.start();
  }

  /** Ends the worker; the next call starts another. */
  end(): void {
    this.worker?.terminate();
    this.abandon(new Ended());
    this.turn = Promise.resolve();
    this.worker = null;
    this.service = null;
  }

  private start(): void {
    const worker = new Worker(new URL("./worker.ts", import.meta.url), {
      type: "module",
      name: this.name,
    });
    this.ended = new Promise((_, reject) => {
      this.abandon = reject;
    });
    this.ended.catch(() => {});
    worker.addEventListener("error", (event) => {
      event.preventDefault();
      const message = event.message || text.page.workerFailed;
      this.abandon(Object.assign(new Error(message), { name: "Panic" }));
      // While it runs by itself there is no call that could hear of it.
      if (this.worker === worker) this.listener.failure({ message, panic: true });
    });
    this.worker = worker;
    this.service = Comlink.wrap<Service>(worker);
    // What a worker that has been replaced still says is heard by nobody.
    const current = () => this.worker === worker;
    void this.service.subscribe(
      Comlink.proxy(async (progress: Progress) => {
        if (current()) await this.listener.progress(progress);
      }),
      Comlink.proxy((failure: Failure) => {
        if (current()) this.listener.failure(failure);
      }),
    );
  }
}
