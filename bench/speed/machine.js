// The machine that is measured, in one line.

import { cpus, release, type } from "node:os";

import { ask } from "../../scripts/shell.js";

export function machine() {
  const all = cpus();
  const cores = `${all.length} ${all.length === 1 ? "core" : "cores"}`;
  return [
    `${all[0]?.model.trim() ?? "unknown processor"}, ${cores}`,
    `${type()} ${release()}`,
    ask("rustc", "--version")?.replace(/ \(.*/, "") ?? "no rustc",
    `Node ${process.versions.node} (V8 ${process.versions.v8})`,
  ].join("; ");
}
