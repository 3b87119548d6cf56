// npm run licences: the licences of all that is shipped, in www/public/licences.txt, from the lock files.

import { existsSync, readdirSync, readFileSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { ask, ifMain, root, Trouble } from "./shell.js";
import { setup } from "./setup.js";

export const FILE = "www/public/licences.txt";

/**
 * Licences that ask for no more than that their text goes along, in the order of preference; the last one for parts
 * that are used unchanged, and for which it is said where their source is.
 */
const ACCEPTED = [
  "MIT",
  "Apache-2.0",
  "ISC",
  "Zlib",
  "BSD-3-Clause",
  "BSD-2-Clause",
  "0BSD",
  "Unicode-3.0",
  "MPL-2.0",
];

/** @typedef {{ name: string, version: string, licence: string, text: string }} Part */

/** Crates that end up in the WebAssembly: what the crate needs when it runs, without macros. */
function crates() {
  const options = [
    "--locked",
    "--format-version",
    "1",
    "--features",
    "javascript,javascript-decoders",
  ];
  const target = ["--filter-platform", "wasm32-unknown-unknown"];
  const text = ask("cargo", "metadata", ...options, ...target);
  if (text === null)
    throw new Trouble("cargo metadata failed: are the crates of Cargo.lock there?");
  const { packages, resolve } = JSON.parse(text);
  /** @type {Map<string, any>} */
  const known = new Map(packages.map((/** @type {any} */ one) => [one.id, one]));
  const nodes = new Map(resolve.nodes.map((/** @type {any} */ node) => [node.id, node]));
  const isMacro = (/** @type {string} */ id) =>
    known.get(id).targets.some((/** @type {any} */ it) => it.kind.includes("proc-macro"));
  const reached = new Set([resolve.root]);
  for (const id of reached) {
    for (const { pkg, dep_kinds: kinds } of nodes.get(id).deps) {
      const runs = kinds.some((/** @type {any} */ { kind }) => kind === null);
      if (runs && !isMacro(pkg)) reached.add(pkg);
    }
  }
  reached.delete(resolve.root);
  return [...reached].map((id) => {
    const { name, version, license, manifest_path: manifest } = known.get(id);
    return part(name, version, license, join(manifest, ".."));
  });
}

/** Packages that the page imports; Vite puts them into it. */
function bundled() {
  const sources = readdirSync(join(root, "www"), { recursive: true, encoding: "utf8" });
  const imports = sources
    .filter((name) => name.endsWith(".ts"))
    .map((name) => readFileSync(join(root, "www", name), "utf8"))
    .flatMap((text) => [
      ...text.matchAll(/\b(?:from|import\(?)\s*"((?:@[^"/]+\/)?[^"./@][^"/]*)/g),
    ]);
  return [...new Set(imports.map(([, name]) => String(name)))].map((name) => {
    const folder = join(root, "node_modules", name);
    const { version, license, repository } = JSON.parse(
      readFileSync(join(folder, "package.json"), "utf8"),
    );
    const one = part(name, version, license, folder);
    const source = String(repository?.url ?? repository).replace(/^git\+/, "");
    return one.licence === "MPL-2.0"
      ? { ...one, text: `${name} is used unchanged; its source is at ${source}\n\n${one.text}` }
      : one;
  });
}

/**
 * @param {string} name
 * @param {string} version
 * @param {string} offered the licences to choose from
 * @param {string} folder where their texts are
 * @returns {Part}
 */
function part(name, version, offered, folder) {
  const words = offered.replaceAll(/[()]/g, "").split(/ OR |\//);
  const licence = ACCEPTED.find((one) => words.includes(one));
  if (licence === undefined) {
    throw new Trouble(
      `${name} ${version} is under ${offered}, which scripts/licences.js does not know.`,
    );
  }
  const names = readdirSync(folder)
    .filter((file) => /^(licen[cs]e|copying)/i.test(file))
    .sort();
  const [, kind = licence] = /^([A-Za-z]+)/.exec(licence) ?? [];
  const own = names.find((file) => file.toUpperCase().includes(kind.toUpperCase())) ?? names[0];
  const text = own === undefined ? `(no text comes with it: ${licence})` : read(join(folder, own));
  return { name, version, licence, text };
}

/** @param {string} path */
const read = (path) =>
  readFileSync(path, "utf8")
    .replaceAll("\r\n", "\n")
    .replaceAll(/[ \t]+$/gm, "")
    .trim();

/** Of the page and its WebAssembly: the text of the file, as it should be. */
export const licences = () => listed([...crates(), ...bundled()], "its WebAssembly and its page");

/** Of the WebAssembly alone. */
export const licencesOfCore = () => listed(crates(), "its WebAssembly");

/**
 * @param {Part[]} parts
 * @param {string} where they are
 */
function listed(parts, where) {
  parts.sort((a, b) => (a.name < b.name ? -1 : a.name > b.name ? 1 : 0));
  /** @type {Map<string, Part[]>} */
  const byText = new Map();
  for (const one of parts) byText.set(one.text, [...(byText.get(one.text) ?? []), one]);
  const sections = [...byText].map(([text, group]) => {
    const heads = group.map(({ name, version, licence }) => `${name} ${version} (${licence})`);
    return `${"=".repeat(79)}\n${heads.join("\n")}\n${"=".repeat(79)}\n\n${text}\n`;
  });
  return `Relievo is under MIT or Apache 2.0, as you like. Inside ${where} there are also
${parts.map(({ name, version, licence }) => `  ${name} ${version} (${licence})`).join("\n")}
under the licences that follow. Made by npm run licences.

${sections.join("\n")}`;
}

/** Whether the file is as it should be. */
export const current = () =>
  existsSync(join(root, FILE)) && readFileSync(join(root, FILE), "utf8") === licences();

await ifMain(import.meta.url, async () => {
  await setup();
  writeFileSync(join(root, FILE), licences());
  console.log(FILE);
});
