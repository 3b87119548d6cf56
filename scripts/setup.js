// Set-up: says what is missing and installs it. Nothing is done twice, so running it again is cheap.
// Only what Node itself brings may be imported here: it runs before any npm package is installed.

import { existsSync, readFileSync, rmSync } from "node:fs";
import { platform } from "node:os";
import { join } from "node:path";

import { ask, cache, ifMain, root, run, stage, toolRoot, Trouble, which } from "./shell.js";

const WASM = "wasm32-unknown-unknown";
const RUSTUP = "curl --proto '=https' --tlsv1.2 -sSf https://sh.rustup.rs | sh -s -- -y";

// Tools that work for a second a day: compiling them fast counts for more than their speed. They share
// what they have in common.
const COMPILED_ONCE = {
  CARGO_TARGET_DIR: join(cache, "compiled"),
  CARGO_PROFILE_RELEASE_OPT_LEVEL: "1",
  CARGO_PROFILE_RELEASE_LTO: "off",
  CARGO_PROFILE_RELEASE_CODEGEN_UNITS: "16",
  CARGO_PROFILE_RELEASE_DEBUG: "false",
};

/** Everything that building, serving and testing need, except a browser. */
export async function setup() {
  checkNode();
  await linker();
  await rust();
  await packages();
  await tool("wasm-bindgen-cli", "wasm-bindgen", lockedVersion("wasm-bindgen"));
  rmSync(COMPILED_ONCE.CARGO_TARGET_DIR, { recursive: true, force: true });
}

function checkNode() {
  const [major = 0, minor = 0] = process.versions.node.split(".").map(Number);
  if (major > 22 || (major === 22 && minor >= 12) || (major === 20 && minor >= 19)) return;
  throw new Trouble(
    `Node ${process.versions.node} is too old: 20.19 or later of version 20, or 22.12 or later, is needed. ` +
      "Install it from https://nodejs.org or with: npx n lts",
  );
}

/** rustup brings a compiler but no linker, without which no build script runs. */
async function linker() {
  const present = platform() === "darwin" ? ask("xcode-select", "-p") : ask("cc", "--version");
  if (present !== null) return;
  if (platform() === "darwin") {
    throw new Trouble("There is no C linker. Install Apple's with: xcode-select --install");
  }
  await apt("a C linker", "gcc", "libc6-dev");
}

async function rust() {
  if (which("rustup") === null) return rustWithoutRustup();
  // rustup alone brings no compiler; asking it for one would begin to install it unannounced.
  if (installedToolchains() === "") {
    await stage("Rust", () => run("rustup", ["default", "stable"]));
  }
  newEnough("rustup update stable && rustup default stable");
  if (!(ask("rustup", "target", "list", "--installed") ?? "").split("\n").includes(WASM)) {
    await stage(`Rust's ${WASM} target`, () => run("rustup", ["target", "add", WASM]));
  }
  const components = ask("rustup", "component", "list", "--installed") ?? "";
  for (const component of ["clippy", "rustfmt"]) {
    if (components.split("\n").some((line) => line.startsWith(component))) continue;
    await stage(`Rust's ${component}`, () => run("rustup", ["component", "add", component]));
  }
}

/** What rustup has installed, empty when that is nothing. */
function installedToolchains() {
  const list = ask("rustup", "toolchain", "list") ?? "";
  return list.startsWith("no installed") ? "" : list;
}

/** A Rust from elsewhere will do when it is new enough and knows the wasm target. */
function rustWithoutRustup() {
  newEnough(RUSTUP);
  const library = ask("rustc", "--print", "target-libdir", "--target", WASM);
  if (library === null || !existsSync(library)) {
    throw new Trouble(
      `This Rust cannot compile for ${WASM}, and there is no rustup to add it. Install rustup with: ${RUSTUP}`,
    );
  }
}

/**
 * Refuses a compiler older than Cargo.toml's `rust-version`.
 * @param {string} remedy the command that installs a newer one
 */
function newEnough(remedy) {
  const version = ask("rustc", "--version");
  if (ask("cargo", "--version") === null || version === null) {
    throw new Trouble(`Rust is missing. Install it with: ${remedy}`);
  }
  const manifest = readFileSync(join(root, "Cargo.toml"), "utf8");
  const [, least = "0"] = /^rust-version = "1\.(\d+)/m.exec(manifest) ?? [];
  const [, minor = "0"] = /^rustc 1\.(\d+)/.exec(version) ?? [];
  if (Number(minor) < Number(least)) {
    throw new Trouble(`${version} is too old: 1.${least} is needed. Install it with: ${remedy}`);
  }
}

async function packages() {
  if (packagesMatch()) return;
  await stage("npm packages", () => run("npm", ["ci", "--include=dev"]));
}

/** Whether node_modules holds what the lock file says, by npm's own note of what it installed. */
function packagesMatch() {
  const note = join(root, "node_modules", ".package-lock.json");
  if (!existsSync(note)) return false;
  const present = JSON.parse(readFileSync(note, "utf8")).packages;
  const locked = JSON.parse(readFileSync(join(root, "package-lock.json"), "utf8")).packages;
  return Object.entries(locked).every(
    ([path, { version, optional }]) =>
      path === "" || present[path]?.version === version || (optional && !present[path]),
  );
}

/**
 * A command-line tool from crates.io, compiled into the cache.
 * @param {string} crate
 * @param {string} program
 * @param {string} version
 */
async function tool(crate, program, version) {
  const present = ask(join(toolRoot, "bin", program), "--version");
  if (present?.split(" ").includes(version)) return;
  await stage(`${crate} ${version}, compiled into ${toolRoot} (some minutes, once)`, () =>
    run(
      "cargo",
      ["install", "--locked", "--version", version, "--root", toolRoot, crate],
      COMPILED_ONCE,
    ),
  );
}

/**
 * The version of a crate in Cargo.lock: wasm-bindgen's tool and library must be the same.
 * @param {string} crate
 */
function lockedVersion(crate) {
  const lock = readFileSync(join(root, "Cargo.lock"), "utf8");
  const version = new RegExp(`name = "${crate}"\nversion = "(.*)"`).exec(lock)?.[1];
  if (version === undefined) throw new Trouble(`Cargo.lock does not name ${crate}.`);
  return version;
}

/**
 * Debian packages, when we may install them.
 * @param {string} what
 * @param {string[]} names
 */
export async function apt(what, ...names) {
  if (ask("apt-get", "--version") === null || process.getuid?.() !== 0) {
    throw new Trouble(
      `There is no ${what.replace(/^an? /, "")}. Install it with: sudo apt-get install -y ${names.join(" ")}`,
    );
  }
  const quiet = { DEBIAN_FRONTEND: "noninteractive" };
  await stage(`${what} from Debian (${names.join(", ")})`, async () => {
    await run("apt-get", ["update", "-q"], quiet);
    await run("apt-get", ["install", "-y", "-q", "--no-install-recommends", ...names], quiet);
  });
}

await ifMain(import.meta.url, async () => {
  await setup();
  console.log("\nEverything needed is installed.");
});
