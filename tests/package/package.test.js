// The npm package as someone has it who installs it: in Node of each version that is here, in a page and in a worker
// that Vite builds, with a consumer's tsc, and as a command.

import assert from "node:assert/strict";
import { execFileSync, spawnSync } from "node:child_process";
import { mkdirSync, mkdtempSync, readFileSync, rmSync, symlinkSync, writeFileSync } from "node:fs";
import { tmpdir } from "node:os";
import { delimiter, join } from "node:path";
import { after, before, describe, test } from "node:test";

import { chromium } from "@playwright/test";

import { chromiumFlags, findChromium } from "../../scripts/chromium.js";
import { LARGEST, pack } from "../../scripts/package.js";
import { root } from "../../scripts/shell.js";

// A path with spaces, as many have one.
const folder = mkdtempSync(join(tmpdir(), "relievo package "));
after(() => rmSync(folder, { recursive: true, force: true }));

/** This Node, and those that RELIEVO_NODES names. */
const nodes = [
  process.execPath,
  ...(process.env["RELIEVO_NODES"]?.split(delimiter) ?? []).filter(Boolean),
];

/** @type {string} */
let packed;
const empty = join(folder, "empty project");
const readme = readFileSync(join(root, "cli/README.md"), "utf8");
/** The examples of the README, that for Node first. */
const examples = [...readme.matchAll(/^```js\n(.*?)^```$/gms)].map(([, text]) => String(text));

before(async () => {
  packed = await pack();
  mkdirSync(empty);
  write("package.json", "{}");
  npm("install", packed);
  const scene = join(empty, "node_modules/relievo/cli/relievo.js");
  execFileSync(process.execPath, [scene, "scene", "squares", "--size", "64x48", "--out", "."], {
    cwd: empty,
  });
  for (const [from, to] of [
    ["frame0.png", "first.png"],
    ["frame1.png", "second.png"],
  ]) {
    writeFileSync(join(empty, String(to)), readFileSync(join(empty, String(from))));
  }
});

/**
 * @param {string} name
 * @param {string} text
 */
function write(name, text) {
  writeFileSync(join(empty, name), text);
}

/** @param {string[]} words */
function npm(...words) {
  const offline = ["--offline", "--no-audit", "--no-fund", "--ignore-scripts"];
  execFileSync("npm", [...words, ...offline], { cwd: empty, stdio: "pipe" });
}

test("it is small, and nothing is in it that has no business there", () => {
  const { size } = JSON.parse(
    execFileSync("npm", ["pack", packed, "--dry-run", "--json"], { encoding: "utf8" }),
  )[0];
  assert.ok(size <= LARGEST, `${size} bytes`);
  const { files } = JSON.parse(
    execFileSync("npm", ["pack", packed, "--dry-run", "--json"], { encoding: "utf8" }),
  )[0];
  const names = files.map((/** @type {any} */ file) => file.path);
  for (const name of ["README.md", "LICENSE-MIT", "licences.txt", "pkg/relievo_bg.wasm"]) {
    assert.ok(names.includes(name), name);
  }
  assert.ok(names.every((/** @type {string} */ name) => !/^(src|tests|www|scripts)\//.test(name)));
});

for (const node of nodes) {
  const version = execFileSync(node, ["--version"], { encoding: "utf8" }).trim();
  describe(`in Node ${version}`, () => {
    test("the README's example runs", () => {
      write("example.mjs", String(examples[0]));
      const { status, stdout, stderr } = ran(node, "example.mjs");
      assert.equal(status, 0, stderr);
      assert.match(stdout, /^0 [01](\.\d+)? /m);
      assert.match(stdout, new RegExp(`^${64 * 48}$`, "m"));
    });

    test("require gives the same", () => {
      write(
        "common.cjs",
        `const { Frame, limits, default: init } = require("relievo");
         init().then(() => console.log(limits(), typeof Frame.decode));`,
      );
      const { status, stdout, stderr } = ran(node, "common.cjs");
      assert.equal(status, 0, stderr);
      assert.match(stdout, /"minSide":16.* function/);
    });
  });
}

/**
 * @param {string} node
 * @param {string} script
 */
function ran(node, script) {
  return spawnSync(node, [script], { cwd: empty, encoding: "utf8" });
}

describe("a consumer's tsc", () => {
  const program = `
    import init, { Frame, Solver, type Options, type Report, type Status } from "relievo";
    export async function solve(bytes: Uint8Array[]): Promise<Report> {
      await init();
      const [first, second] = bytes.map((one, i) => Frame.decode(one, \`frame \${i}\`));
      const options: Partial<Options> = { preset: "paper", mu: null };
      const solver = new Solver(first!, second!, { focal: 320 }, [{ kind: "circle", x: 9, y: 9, r: 4 }], options);
      let status: Status = "running";
      while (status === "running") status = solver.step();
      const depth: Float32Array = solver.depth();
      return depth.length ? JSON.parse(solver.report()) : Promise.reject();
    }`;
  const strict = ["--noEmit", "--strict", "--target", "es2022", "--types", "[]"].slice(0, -2);
  /** @type {[string, string[]][]} */
  const settings = [
    ["of a page", ["--module", "esnext", "--moduleResolution", "bundler", "--lib", "es2022,dom"]],
    ["of a Node program", ["--module", "nodenext", "--lib", "es2022,dom"]],
  ];
  for (const [whose, options] of settings) {
    test(`${whose} takes the types, and finds a mistake`, () => {
      const tsc = join(root, "node_modules/.bin/tsc");
      const checked = (/** @type {string} */ text) => {
        write("program.mts", text);
        const words = [...strict, ...options, "program.mts"];
        return spawnSync(tsc, words, { cwd: empty, encoding: "utf8" });
      };
      const right = checked(program);
      assert.equal(right.status, 0, right.stdout);
      assert.match(checked(program.replace('"paper"', '"papier"')).stdout, /papier/);
    });
  }
});

test("a global install puts relievo on the path", () => {
  const prefix = join(folder, "global place");
  npm("install", "--global", "--prefix", prefix, packed);
  const path = [join(prefix, "bin"), process.env["PATH"]].join(delimiter);
  const options = { cwd: folder, env: { ...process.env, PATH: path }, encoding: "utf8" };
  const { version } = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
  const { stdout } = spawnSync("relievo", ["--version"], /** @type {any} */ (options));
  assert.equal(String(stdout).trim(), version);
  assert.match(
    String(spawnSync("relievo", ["scenes"], /** @type {any} */ (options)).stdout),
    /blocks/,
  );
});

describe("Vite", () => {
  /** @type {import("@playwright/test").Browser} */
  let browser;
  /** @type {{ close: () => Promise<void> }[]} */
  const servers = [];

  before(async () => {
    for (const name of ["vite"])
      symlinkSync(join(root, "node_modules", name), join(empty, "node_modules", name));
    const example = String(examples[1]);
    write(
      "main.js",
      `${example}\ndocument.title = "page " + blob.size;
      new Worker(new URL("./worker.js", import.meta.url), { type: "module", name: document.baseURI })
        .addEventListener("message", ({ data }) => { document.body.textContent = data; });`,
    );
    // Relative addresses in a worker are relative to its script.
    const there = example.replace("fetch(name)", "fetch(new URL(name, self.name))");
    write("worker.js", `${there}\npostMessage("worker " + blob.size);`);
    write(
      "index.html",
      '<!doctype html><title></title><body></body><script type="module" src="./main.js"></script>',
    );
    mkdirSync(join(empty, "public"));
    for (const name of ["first.png", "second.png"]) {
      writeFileSync(join(empty, "public", name), readFileSync(join(empty, name)));
    }
    const executablePath = findChromium();
    browser = await chromium.launch({
      ...(executablePath ? { executablePath } : {}),
      args: chromiumFlags,
    });
  });
  after(async () => {
    await browser?.close();
    for (const server of servers) await server.close();
  });

  const common = {
    root: empty,
    base: "./",
    configFile: /** @type {false} */ (false),
    logLevel: /** @type {"error"} */ ("error"),
    worker: { format: /** @type {"es"} */ ("es") },
    optimizeDeps: { exclude: ["relievo"] },
  };
  const free = { host: "127.0.0.1", port: 0 };

  /** @param {string | undefined} address */
  async function works(address) {
    const page = await browser.newPage();
    /** @type {string[]} */
    const broken = [];
    page.on("pageerror", (error) => broken.push(error.message));
    await page.goto(String(address));
    const said = page.waitForFunction(
      () => /^page \d/.test(document.title) && /^worker \d/.test(document.body.textContent ?? ""),
      undefined,
      { timeout: 30_000 },
    );
    await said.catch(() => assert.fail(`it does not come to its end: ${broken.join("; ")}`));
    await page.close();
  }

  test("builds a page and a worker that work", async () => {
    const vite = await import("vite");
    await vite.build({ ...common, build: { outDir: "dist/deep down" } });
    // Served from a folder below the root: nothing may ask for an absolute address.
    const server = await vite.preview({ ...common, build: { outDir: "dist" }, preview: free });
    servers.push(server);
    await works(new URL("deep%20down/index.html", server.resolvedUrls?.local[0]).href);
  });

  test("serves them while one develops", async () => {
    const vite = await import("vite");
    const server = await (await vite.createServer({ ...common, server: free })).listen();
    servers.push(server);
    await works(server.resolvedUrls?.local[0]);
  });
});
