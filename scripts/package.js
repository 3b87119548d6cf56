// npm run package: the npm package in out/package, with a README of its own, and packed beside it.

import { cpSync, mkdirSync, readFileSync, rmSync, writeFileSync } from "node:fs";
import { join } from "node:path";

import { licencesOfCore } from "./licences.js";
import { ifMain, root, run, Trouble } from "./shell.js";
import { setup } from "./setup.js";
import { wasm } from "./wasm.js";

/** Bytes that the packed package may have. */
export const LARGEST = 800_000;

/** What of package.json others need. */
const KEYS = [
  "name",
  "version",
  "description",
  "keywords",
  "license",
  "repository",
  "type",
  "engines",
  "bin",
  "exports",
  "types",
];

/** What goes in, by where it comes from. */
const FILES = {
  cli: "cli",
  "cli/README.md": "README.md",
  "pkg/relievo.d.ts": "pkg/relievo.d.ts",
  "pkg/relievo_bg.wasm": "pkg/relievo_bg.wasm",
  "pkg/relievo_decoders_bg.wasm": "pkg/relievo_decoders_bg.wasm",
  "CHANGELOG.md": "CHANGELOG.md",
  "LICENSE-APACHE": "LICENSE-APACHE",
  "LICENSE-MIT": "LICENSE-MIT",
};

/** Generated modules, which go in without their comments: those are in the types as well. */
const GLUE = ["pkg/relievo.js", "pkg/relievo_decoders.js"];

/** Assembles and packs; the path of the packed file. */
export async function pack() {
  const folder = join(root, "out/package");
  rmSync(folder, { recursive: true, force: true });
  mkdirSync(folder, { recursive: true });
  for (const [from, to] of Object.entries(FILES)) {
    cpSync(join(root, from), join(folder, to), { recursive: true });
  }
  rmSync(join(folder, "cli/README.md"));
  for (const name of GLUE) {
    const text = readFileSync(join(root, name), "utf8");
    writeFileSync(join(folder, name), text.replaceAll(/^ *\/\*\*[^]*?\*\/\n/gm, ""));
  }
  writeFileSync(join(folder, "licences.txt"), licencesOfCore());
  const all = JSON.parse(readFileSync(join(root, "package.json"), "utf8"));
  const own = Object.fromEntries(KEYS.map((key) => [key, all[key]]));
  writeFileSync(join(folder, "package.json"), `${JSON.stringify(own, null, 2)}\n`);
  const where = ["--pack-destination", "out"];
  const [packed] = JSON.parse(await run("npm", ["pack", "./out/package", "--json", ...where]));
  if (packed.size > LARGEST) {
    throw new Trouble(`The package has ${packed.size} bytes; ${LARGEST} are allowed.`);
  }
  return join(root, "out", packed.filename);
}

await ifMain(import.meta.url, async () => {
  await setup();
  await wasm();
  console.log(`\n${await pack()}`);
});
