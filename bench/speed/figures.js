// The few figures that tell whether the solver is fast enough, out of the main table.

import { USUAL } from "./cases.js";
import { column } from "./measure.js";
import { over } from "./rows.js";
import { geometricMean, median } from "./statistics.js";
import { number } from "./table.js";

/** @typedef {import("./rows.js").Result} Result */
/** @typedef {import("./measure.js").Entry} Entry */
/** @typedef {{ what: string, preset: string, size: string, regions: number[], key: "total" | "usable" | "next" }} Ratio */

const BEST = { preset: "best", size: USUAL, regions: [3, 4] };

/** @type {Ratio[]} */
const RATIOS = [
  { ...BEST, what: "two or three curves, from circles", key: "total" },
  { ...BEST, what: "two or three curves, first usable picture", key: "usable" },
  { ...BEST, what: "two or three curves, next frame", key: "next" },
  { what: "no curve", preset: "best", size: "640x480", regions: [1], key: "total" },
  { what: "from circles", preset: "paper", size: USUAL, regions: [1, 2, 3, 4, 5], key: "total" },
];

/** Time a pixel at the first size over that at the second should be 1 or so. */
const GROWTH = ["1920x1080", USUAL];

export const HEAD = ["geometric mean (largest) over scenes", "preset", "size", "native", "wasm"];

/**
 * @param {Result[]} results
 * @returns {string[][]}
 */
export function rows(results) {
  const ratios = RATIOS.map(({ what, preset, size, regions, key }) => {
    const these = results.filter(
      ({ one }) => sizeOf(one) === size && regions.includes(one.regions),
    );
    const cells = ["native", "wasm"].map((by) =>
      summary(these.map(({ entries }) => ratio(entries, by, preset, key))),
    );
    return [`${what} ÷ TV-L1`, preset, size, ...cells];
  });
  const growth = ["native", "wasm"].map((by) => summary(perPixel(results, by)));
  return [...ratios, ["time per pixel", "best", GROWTH.join(" ÷ "), ...growth]];
}

/**
 * @param {Entry[]} entries
 * @param {string} by
 * @param {string} preset
 * @param {"total" | "usable" | "next"} key
 */
function ratio(entries, by, preset, key) {
  const entry = entries.find((e) => e.by === by && e.preset === preset);
  return entry ? over(entry, key, entries, "TV-L1") : null;
}

/**
 * Seconds a pixel in the large frame over those in the small one, scene by scene.
 * @param {Result[]} results
 * @param {string} by
 */
function perPixel(results, by) {
  const cost = (/** @type {string} */ scene, /** @type {string | undefined} */ size) => {
    const result = results.find(({ one }) => one.scene === scene && sizeOf(one) === size);
    const entry = result?.entries.find((e) => e.by === by && e.preset === "best");
    const total = entry ? median(column(entry.samples, "total")) : null;
    return result && total !== null ? total / (result.one.width * result.one.height) : null;
  };
  const scenes = [...new Set(results.map(({ one }) => one.scene))];
  return scenes.map((scene) => {
    const [large, small] = GROWTH.map((size) => cost(scene, size));
    return large && small ? large / small : null;
  });
}

/** @param {(number | null)[]} values */
function summary(values) {
  const known = values.filter((value) => value !== null);
  if (!known.length) return "–";
  return `${number(geometricMean(known))} (${number(Math.max(...known))})`;
}

/** @param {import("./cases.js").Size} size */
function sizeOf({ width, height }) {
  return `${width}x${height}`;
}
