// The main table: a row for each case and each who solved it.

import { column } from "./measure.js";
import { median, medianRatio, spread } from "./statistics.js";
import { number, percent } from "./table.js";

/** @typedef {import("./measure.js").Entry} Entry */
/** @typedef {{ one: import("./cases.js").Case, entries: Entry[] }} Result */

export const HEAD = [
  "scene",
  "size",
  "regions",
  "by",
  "preset",
  "total, s",
  "± %",
  "motion, s",
  "depth, s",
  "curves, s",
  "usable, s",
  "next frame, s",
  "÷ TV-L1",
  "÷ DIS",
  "bytes/px",
  "AEE, px",
  "labels wrong, %",
  "passes",
  "next: AEE, px",
  "labels wrong, %",
];

/**
 * @param {Result} result
 * @returns {string[][]}
 */
export function rows({ one, entries }) {
  const pixels = one.width * one.height;
  return entries.map((entry) => {
    const seconds = (/** @type {string} */ key) => number(median(column(entry.samples, key)));
    const passes = entry.passes === null ? "–" : String(entry.passes);
    const ended = entry.status === null || entry.status === "converged" ? "" : `, ${entry.status}`;
    return [
      one.scene,
      `${one.width}×${one.height}`,
      String(one.regions),
      entry.by,
      entry.preset ?? "–",
      seconds("total"),
      percent(spread(column(entry.samples, "total"))),
      ...["motion", "depth", "curves", "usable", "next"].map(seconds),
      number(over(entry, "total", entries, "TV-L1")),
      number(over(entry, "total", entries, "DIS")),
      entry.bytes === null ? "–" : String(Math.round(entry.bytes / pixels)),
      number(entry.score?.aee),
      one.regions > 1 && entry.preset ? percent(entry.score?.wrong) : "–",
      passes + ended,
      number(entry.next?.aee),
      one.regions > 1 ? percent(entry.next?.wrong) : "–",
    ];
  });
}

/**
 * An entry's time over a peer's, round by round; null for the peer itself or without it.
 * @param {Entry} entry
 * @param {"total" | "usable" | "next"} key
 * @param {Entry[]} entries
 * @param {string} by
 */
export function over(entry, key, entries, by) {
  const peer = entries.find((other) => other.by === by);
  if (!peer || !entry.preset) return null;
  const times = (/** @type {Entry} */ of, /** @type {string} */ k) =>
    of.samples.map((sample) => sample[k] ?? null);
  return medianRatio(times(entry, key), times(peer, "total"));
}
