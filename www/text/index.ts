/**
 * All that the page says, in the language that it is built in: `www/text/en` is English, in parts.
 *
 * Texts with values are functions. Another language is a folder beside `en` with the same parts, each typed by the
 * English one (`export const de: Text = …`), so that the compiler names whatever is missing. What comes with dialogs that
 * are fetched later is in `later.ts`, the worker's few sentences in `worker.ts`, and those of `index.html` in
 * `en/markup.ts`, which the build puts in.
 */

import { en } from "./en";

export { default as about } from "./en/about.html?raw";

export type Text = typeof en;

export const text: Text = en;
