// npm test: every check there is, each timed, and a summary. `npm test -- page cli` runs only the
// stages whose names contain one of those words.

import { existsSync, readdirSync, readFileSync, rmSync, statSync } from "node:fs";
import { createServer } from "node:net";
import { join } from "node:path";

import { build } from "./build.js";
import { ensureChromium } from "./chromium.js";
import { findFirefox } from "./firefox.js";
import { recordings } from "./recordings.js";
import { setup } from "./setup.js";
import { duration, ifMain, marked, root, run, stage, Trouble } from "./shell.js";
import { wasm } from "./wasm.js";

const WASM = ["--target", "wasm32-unknown-unknown"];
const DENY = ["--", "-D", "warnings"];

/** Tests of the page that run in Firefox as well: it opens, runs, and draws. */
const IN_FIREFOX = "opens on the blocks|asks nothing of other hosts|a run makes the energy fall";

/** @typedef {[string, () => Promise<unknown>]} Stage a name and what is done */

/**
 * Both halves run at once: compiling keeps more than one core busy only now and then, and so does a browser.
 * @type {Record<string, Stage[]>}
 */
const HALVES = {
  rust: [
    ["rust format", () => run("cargo", ["fmt", "--check"])],
    ["rust lint", () => run("cargo", ["clippy", "--locked", "--all-targets", ...DENY])],
    [
      "rust lint without features",
      () => run("cargo", ["clippy", "--locked", "--lib", "--no-default-features", ...DENY]),
    ],
    [
      "rust lint for wasm",
      async () => {
        const lint = ["clippy", "--locked", "--lib", "--no-default-features"];
        for (const feature of ["bench", "javascript-decoders"]) {
          await run("cargo", [...lint, "--features", feature, ...WASM, ...DENY]);
        }
      },
    ],
    [
      "rust docs",
      () => run("cargo", ["doc", "--locked", "--no-deps"], { RUSTDOCFLAGS: "-D warnings" }),
    ],
    ["rust tests", rustTests],
    ["crate as packed", crate],
    ["rust tests in Node", rustInNode],
  ],
  page: [
    ["build", build],
    ["page format", () => run("prettier", ["--check", "."])],
    ["page types", types],
    ["speed table tests", () => nodeTests("tests/speed")],
    ["command line tests", commandLine],
    ["npm package tests", npmPackage],
    ["page tests", page],
    ["page tests in Firefox", pageInFirefox],
  ],
};

/** Without the benches, which the lint has looked through, and what `crate` runs. */
function rustTests() {
  return run("cargo", ["test", "--locked", "--no-fail-fast", "--lib", "--tests"]);
}

/** Bytes of the packed crate: the sources and little else. */
const LARGEST_CRATE = 1_000_000;

/** What `cargo package` makes builds by itself, with its examples; those in its documentation run. */
async function crate() {
  await run("cargo", ["package", "--locked", "--allow-dirty", "--no-verify"]);
  const targets = join(root, process.env.CARGO_TARGET_DIR ?? "target");
  const { version } = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
  const folder = join(targets, "package", `relievo-${version}`);
  const { size } = statSync(`${folder}.crate`);
  if (size > LARGEST_CRATE) throw new Trouble(`The crate has ${size} bytes: what is in it?`);
  rmSync(folder, { recursive: true, force: true });
  await run("tar", ["-xzf", `${folder}.crate`, "-C", join(targets, "package")]);
  const test = ["test", "--locked", "--manifest-path", join(folder, "Cargo.toml")];
  const here = ["--target-dir", targets];
  await run("cargo", [...test, ...here, "--examples"]);
  return run("cargo", [...test, ...here, "--doc"]);
}

/** What both targets must agree in; the rest is the same code, compiled by the same compiler. */
function rustInNode() {
  const tests = ["core", "solver"].flatMap((name) => ["--test", name]);
  const features = ["--features", "javascript"];
  return run("cargo", ["test", "--locked", "--no-fail-fast", ...features, ...tests, ...WASM], {
    CARGO_TARGET_WASM32_UNKNOWN_UNKNOWN_RUNNER: "wasm-bindgen-test-runner",
    WASM_BINDGEN_TEST_ONLY_NODE: "1",
    // Seconds before the runner gives up on a whole binary.
    WASM_BINDGEN_TEST_TIMEOUT: "900",
  });
}

async function types() {
  await wasm();
  await run("tsc", ["-p", "tsconfig.json"]);
  await run("tsc", ["-p", "tsconfig.node.json"]);
  await run("tsc", ["-p", "tsconfig.worker.json"]);
}

async function commandLine() {
  await recordings();
  return nodeTests("tests/cli");
}

async function npmPackage() {
  await wasm();
  const chromium = await ensureChromium();
  return nodeTests("tests/package", chromium ? { RELIEVO_CHROMIUM: chromium } : {});
}

/**
 * @param {string} folder
 * @param {Record<string, string>} [extra]
 */
function nodeTests(folder, extra) {
  return run("node", ["--test", "--test-reporter=spec", ...filesIn(folder, ".test.js")], extra);
}

async function page() {
  await build();
  const chromium = await ensureChromium();
  return run("playwright", ["test"], {
    RELIEVO_PORT: String(await freePort()),
    ...(chromium ? { RELIEVO_CHROMIUM: chromium } : {}),
  });
}

/** What most depends on the browser; nothing where no Firefox is installed. */
async function pageInFirefox() {
  const firefox = findFirefox();
  if (firefox === undefined) return console.log("No Firefox is installed: left out.");
  await build();
  return run("playwright", ["test", "--grep", IN_FIREFOX], {
    NODE_OPTIONS: `--require ${JSON.stringify(join(root, "scripts/firefox.cjs"))}`,
    RELIEVO_BROWSER: "firefox",
    RELIEVO_FIREFOX: firefox,
    RELIEVO_PORT: String(await freePort()),
  });
}

/**
 * @param {string} folder
 * @param {string} ending
 */
function filesIn(folder, ending) {
  const full = join(root, folder);
  const names = existsSync(full) ? readdirSync(full) : [];
  return names.filter((name) => name.endsWith(ending)).map((name) => join(full, name));
}

/** @returns {Promise<number>} */
function freePort() {
  return new Promise((resolve) => {
    const server = createServer().listen(0, "127.0.0.1", () => {
      const address = server.address();
      server.close(() => resolve(typeof address === "object" && address ? address.port : 0));
    });
  });
}

/** @param {unknown} output */
const plain = (output) => String(output ?? "").replaceAll(/\x1b\[[0-9;]*m/g, "");

/**
 * How many tests a stage's output speaks of; none for a stage that is one check.
 * @param {unknown} output
 */
function count(output) {
  const text = plain(output);
  const patterns = [
    /test result: \w+\. (\d+) passed; (\d+) failed/g,
    /^ℹ pass (\d+)\s+ℹ fail (\d+)/gm,
    /^\s+(\d+) passed/gm,
    /^\s+()(\d+) failed/gm,
  ];
  let [passed, failed] = [0, 0];
  for (const match of patterns.flatMap((pattern) => [...text.matchAll(pattern)])) {
    passed += Number(match[1] ?? 0);
    failed += Number(match[2] ?? 0);
  }
  return { passed, failed };
}

/**
 * The tests that a stage's output says have failed.
 * @param {unknown} output
 */
export function failing(output) {
  const text = plain(output);
  const patterns = [
    /^test (.+?) \.\.\. FAILED$/gm,
    /^\s*✖ (.+?) \([\d.]+ms\)$/gm,
    /^\s+\[\w+\] › (.+?) ?─*$/gm,
  ];
  const names = patterns.flatMap((pattern) => [...text.matchAll(pattern)].map(([, name]) => name));
  return [...new Set(names)];
}

/**
 * Does one stage.
 * @param {Stage} stage
 * @returns {Promise<{ name: string, failed: boolean, lines: string[] }>} with its lines of the summary
 */
async function done([name, work]) {
  const from = performance.now();
  let [word, output, reason] = ["ok", /** @type {unknown} */ (""), ""];
  try {
    output = await stage(name, work);
  } catch (error) {
    word = "FAILED";
    output = Object(error).output;
    reason = error instanceof Error ? error.message : String(error);
    console.error(reason);
  }
  const { passed, failed } = count(output);
  const tests = passed + failed ? `${passed} passed${failed ? `, ${failed} failed` : ""}` : "";
  const time = duration(performance.now() - from);
  const lines = [`${word.padEnd(7)} ${name.padEnd(26)} ${time.padStart(11)}  ${tests || reason}`];
  if (reason) lines.push(...failing(output).map((test) => `          ${test}`));
  return { name, failed: reason !== "", lines };
}

/**
 * Does stages one after the other.
 * @param {Stage[]} stages
 */
async function inTurn(stages) {
  const ended = [];
  for (const each of stages) ended.push(await done(each));
  return ended;
}

await ifMain(import.meta.url, async () => {
  const begin = performance.now();
  const words = process.argv.slice(2);
  const halves = Object.entries(HALVES).map(([half, stages]) => {
    const chosen = stages.filter(([name]) => !words.length || words.some((w) => name.includes(w)));
    return { mark: `${half}  `, chosen };
  });
  if (halves.every(({ chosen }) => !chosen.length)) {
    const names = Object.values(HALVES).flatMap((stages) => stages.map(([name]) => name));
    throw new Trouble(`No stage is called that: ${names.join(", ")}.`);
  }
  await setup();

  const ended = await Promise.all(
    halves.map(({ mark, chosen }) => marked(mark, () => inTurn(chosen))),
  );
  const stages = ended.flat();
  console.log(`\n== Summary, ${duration(performance.now() - begin)}`);
  console.log(stages.flatMap(({ lines }) => lines).join("\n"));
  const failures = stages.filter(({ failed }) => failed).map(({ name }) => name);
  if (failures.length) {
    const [count, names] = [`${failures.length} of ${stages.length}`, failures.join(", ")];
    throw new Trouble(`${count} stages failed: ${names}.`);
  }
  console.log("\nAll is well.");
});
