/** All that the page says stands in `www/text`, so that another language can be put in its place. */

import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { parseSync } from "vite";

import { en } from "../../www/text/en";
import { later } from "../../www/text/en/later";
import { markup } from "../../www/text/en/markup";
import { worker } from "../../www/text/en/worker";
import { expect, test } from "./helpers";

const WWW = fileURLToPath(new URL("../../www", import.meta.url));
const read = (name: string) => readFileSync(join(WWW, name), "utf8");

/** Two letters, and either a gap or a capital: what may be words for people. */
const WORDS = /\p{L}{2}.*\s|\s.*\p{L}{2}|^\p{Lu}\p{Ll}/su;

/** What looks like words and is none: for stylesheets, for canvases, and for those who write this page. */
const NONE = [
  /^rgb\(|px|^\(.*:.*\)|^translate\(|^<svg |^[#:.[]|sans-serif/,
  // Keys, and names of errors.
  /^(Arrow\w+|Backspace|Delete|End|Enter|Escape|Home|\w+Error|InsecureContext)$/,
  /^(Ended|Error|Panic|Unloaded)$/,
  // Names of formats; a quantity by the core's name; what a drag carries.
  /^(WebM|WebP|Depth|Files)$/,
  // Sides of a divider, parts of a chart, messages to a worker.
  /^(frame|found|horn-schunck) |^(area|curve|dots|fork|join) |^ current$|^take over$|^recorded $/,
];
/** Files of names that are the same in every language: formats and codecs, BibTeX. */
const NAMES = ["intake/formats.ts", "intake/codecs.ts", "export/cite.ts"];
/** Errors that somebody catches before anyone sees them, or that only who writes this page can make. */
const UNSEEN = [
  "the page has no element #",
  "the computation was ended",
  "the recording of ",
  " cannot be loaded",
  "no picture",
  "no answer",
  "not played",
];

interface Node {
  type: string;
  [key: string]: unknown;
}

const isNode = (value: unknown): value is Node =>
  typeof value === "object" && value !== null && typeof (value as Node).type === "string";

/** The strings in a part of a program that may be shown, parts of templates among them. */
function strings(node: Node): string[] {
  const { type, key, value } = node;
  if (/^(Import|TS(Literal|Type))/.test(type)) return [];
  if (type === "Literal") return typeof value === "string" ? [value] : [];
  if (type === "TemplateElement") return [(value as { cooked: string }).cooked];
  // Classes are for the stylesheet.
  if (type === "Property" && (key as Node)["name"] === "class") return [];
  return Object.values(node)
    .flat()
    .flatMap((child) => (isNode(child) ? strings(child) : []));
}

/** All of the page's code but the texts. */
const CODE = readdirSync(WWW, { recursive: true, encoding: "utf8" })
  .map((name) => name.replaceAll("\\", "/"))
  .filter((name) => name.endsWith(".ts") && !name.startsWith("text/"));

test("no sentence stands in the page's code", () => {
  expect(CODE.length).toBeGreaterThan(80);
  const said = CODE.filter((name) => !NAMES.includes(name)).flatMap((name) => {
    const { program, errors } = parseSync(name, read(name));
    expect(errors).toEqual([]);
    return strings(program as unknown as Node)
      .filter((text) => WORDS.test(text) && !UNSEEN.includes(text))
      .filter((text) => !NONE.some((pattern) => pattern.test(text)))
      .map((text) => `${name}: ${text}`);
  });
  expect(said, "belongs into www/text").toEqual([]);
});

test("index.html has words by their keys alone, and uses every key", () => {
  const html = read("index.html");
  const used = [...html.matchAll(/\{\{(\w+)\}\}/g)].map(([, key]) => key!);
  expect([...new Set(used)].sort()).toEqual(Object.keys(markup).sort());
  const body = html.slice(html.indexOf("<body>"));
  const shown = body.replaceAll(/<[^>]*>|\{\{\w+\}\}/g, " ").match(/\p{L}[^\s]*/gu);
  expect(shown).toEqual(["Relievo"]);
  const spoken = [...html.matchAll(/(?:title|alt|placeholder|aria-label)="([^"]+)"/g)];
  for (const [, words] of spoken) expect(words).toMatch(/^\{\{\w+\}\}$/);
  for (const sheet of readdirSync(join(WWW, "style"))) {
    expect(read(`style/${sheet}`), sheet).not.toMatch(/content: *["'][^"']*\p{L}/u);
  }
});

test("the page is built with them", async ({ opened: page }) => {
  await expect(page.locator("html")).toHaveAttribute("lang", en.language);
  await expect(page).toHaveTitle(markup.title);
  await expect(page.locator("#export")).toHaveText(markup.export);
  const all = await page.content();
  expect(all).not.toContain("{{");
});

/** The keys of all texts, of those within others the last. */
const keysOf = (texts: object): string[] =>
  Object.entries(texts).flatMap(([key, value]) =>
    typeof value === "object" && !Array.isArray(value) ? keysOf(value) : [key],
  );

test("no text is left that nobody says", () => {
  const code = CODE.map(read).join("\n");
  const words = new Set(code.match(/[\w-]+/g));
  const keys = keysOf({ en, later, worker });
  expect(keys.length).toBeGreaterThan(250);
  // The core says how a run ended.
  const ended = ["converged", "exhausted", "diverged"];
  expect(keys.filter((key) => !words.has(key) && !ended.includes(key))).toEqual([]);
});

test("every lesson has a title and a file in this language", () => {
  const files = readdirSync(join(WWW, "lessons", en.language));
  const titled = Object.keys(en.lessons.titles).map((name) => `${name}.html`);
  expect(files.sort()).toEqual(titled.sort());
});
