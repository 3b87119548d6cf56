// A program that is asked by a line of JSON and answers by one: everything that is timed is one, so that all take
// turns on the same machine.

import { spawn } from "node:child_process";
import { createInterface } from "node:readline";

import { environment, root, Trouble } from "../../scripts/shell.js";

/** Libraries of peers read these; nothing timed here has more than one thread. */
const ONE_THREAD = Object.fromEntries(
  ["OMP", "OPENBLAS", "MKL", "NUMEXPR", "NUMBA"].map((name) => [`${name}_NUM_THREADS`, "1"]),
);

export class Server {
  /** @param {string} program @param {string[]} [options] */
  constructor(program, options = []) {
    this.name = [program, ...options].join(" ");
    this.child = spawn(program, options, {
      cwd: root,
      env: { ...environment, ...ONE_THREAD },
      stdio: ["pipe", "pipe", "inherit"],
    });
    /** @type {((line: string | null) => void) | null} */
    this.waiting = null;
    const answer = (/** @type {string | null} */ line) => {
      this.waiting?.(line);
      this.waiting = null;
    };
    createInterface({ input: this.child.stdout }).on("line", answer);
    this.child.on("error", () => answer(null));
    this.child.on("close", () => answer(null));
    this.child.stdin.on("error", () => answer(null));
  }

  /**
   * @param {Record<string, unknown>} request
   * @returns {Promise<any>}
   */
  async ask(request) {
    const line = await new Promise((resolve) => {
      if (this.child.exitCode !== null) return resolve(null);
      this.waiting = resolve;
      this.child.stdin.write(`${JSON.stringify(request)}\n`);
    });
    if (line === null)
      throw new Trouble(`"${this.name}" ended when asked ${JSON.stringify(request)}.`);
    const answer = JSON.parse(line);
    if (answer.error) throw new Trouble(`"${this.name}": ${answer.error}`);
    return answer;
  }

  /**
   * Asks one thing, and ends it.
   * @param {Record<string, unknown>} request
   */
  once(request) {
    return this.ask(request).finally(() => this.end());
  }

  end() {
    this.child.stdin.end();
  }
}
