/// <reference lib="esnext.disposable" />
import type { InitInput } from "../pkg/relievo.js";

/**
 * Relievo as a library for Node and for browsers.
 *
 * ```js
 * import { readFileSync } from "node:fs";
 * import { Frame, Solver } from "relievo";
 *
 * const read = (name) => Frame.decode(readFileSync(name), name);
 * const [first, second, third] = ["a.png", "b.png", "c.png"].map(read);
 * const solver = new Solver(first, second, { focal: 320 }, [], {});
 * while (solver.step() === "running");
 * console.log(JSON.parse(solver.report()).regions);
 * solver.next(third); // the following frame of the film, from what was found
 * while (solver.step() === "running");
 * ```
 *
 * The last argument holds what differs from the preset `best`, the default: `{ lambda: 200 }`, or
 * `{ preset: "paper" }` for the method as printed. `optionCatalogue()` lists all there is to set. What
 * goes in may be JSON text as well; what comes out (`report()`, `findCurves()`, …) is, and has the types `Report`,
 * `Shape[]`, … below.
 */
export * from "../pkg/relievo.js";

/**
 * Loads the WebAssembly, in a page or a worker: nothing else may be used before it resolves. `from` is where it lies,
 * or what it is; without it, it is looked for where the package has it. Rejects where WebAssembly has no SIMD. In Node
 * all is loaded already.
 */
export default function init(from?: InitInput | Promise<InitInput>): Promise<void>;

/**
 * Loads what opens files that are no PNG, after `init()`: `Frame.decode` and `decodeAll` of such files need it. `from` is
 * as in `init`. In Node it is loaded with the first of them.
 */
export function loadDecoders(from?: InitInput | Promise<InitInput>): Promise<void>;
