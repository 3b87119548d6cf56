// What is shipped under others' licences is listed, as the lock files have it now.

import assert from "node:assert/strict";
import { readFileSync } from "node:fs";
import { join } from "node:path";
import { test } from "node:test";

import { current, FILE, licences } from "../../scripts/licences.js";
import { root } from "../../scripts/shell.js";

test("the list of licences is current", () => {
  assert.ok(current(), `${FILE} is not what the lock files say: npm run licences writes it`);
});

test("it knows what the WebAssembly and the page are made of, and no tools", () => {
  const text = licences();
  for (const name of ["image", "glam", "wasm-bindgen", "three", "uplot"]) {
    assert.match(text, new RegExp(`^  ${name} \\d`, "m"));
  }
  for (const name of ["vite", "syn", "arbitrary"]) {
    assert.doesNotMatch(text, new RegExp(`^  ${name} \\d`, "m"));
  }
});

test("crate and package are of one version, which the changelog knows", () => {
  const [crate, npm, changes] = ["Cargo.toml", "package.json", "CHANGELOG.md"].map((name) =>
    readFileSync(join(root, name), "utf8"),
  );
  const { version } = JSON.parse(String(npm));
  assert.match(String(crate), new RegExp(`^version = "${version}"$`, "m"));
  assert.match(String(changes), new RegExp(`^## ${version}$`, "m"));
});
