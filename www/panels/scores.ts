/**
 * How far from the truth, beside the baseline: as far as the truth is known.
 *
 * Horn–Schunck finds image motion and nothing else, so only two rows have a figure for it.
 */

import { byId, make } from "../dom";
import { fixed, percent } from "../format";
import { store, type State } from "../store";
import { text } from "../text";
import type { PartScores } from "../worker/protocol";

const words = text.scores;

interface Row {
  name: string;
  meaning: string;
  found: string;
  baseline?: string;
  /** Whether the method did better than the baseline. */
  better?: boolean;
}

export function mountScores(): void {
  store.watchAfter(({ scores, started, shapes }) => [scores, started, shapes.length], refresh);
}

function refresh({ scores, started }: Readonly<State>): void {
  byId("scores-panel").hidden = !scores || !started;
  if (!scores || !started) return;
  const { found, baseline } = scores;
  const regions = found.iou
    .map((iou, k) => regionLine(found, iou, k))
    .filter((_, k) => known(found, k));
  byId("scores").replaceChildren(
    table(
      ["", words.found, words.baseline],
      [
        {
          name: words.aee,
          meaning: words.aeeMeaning,
          found: unit(found.aee, 3, "px"),
          baseline: unit(baseline.aee, 3, "px"),
          better: less(found.aee, baseline.aee),
        },
        {
          name: words.aae,
          meaning: words.aaeMeaning,
          found: unit(found.aae, 2, "°"),
          baseline: unit(baseline.aae, 2, "°"),
          better: less(found.aae, baseline.aae),
        },
        {
          name: words.labels,
          meaning: words.labelsMeaning,
          found: found.labels_wrong === null ? "–" : percent(found.labels_wrong),
          baseline: "–",
        },
      ]
        .filter(({ found: own }) => own !== "–")
        .map(line),
    ),
    ...(regions.length > 0
      ? [
          table([words.region, words.iou, words.depth, words.flat, "T", "ω"], regions),
          make("p", { class: "note" }, words.meaning),
        ]
      : []),
  );
}

function line({ name, meaning, found, baseline, better }: Row): HTMLElement {
  return make(
    "tr",
    {},
    make("th", { scope: "row", title: meaning }, name),
    make("td", { class: better ? "better" : null }, found),
    make("td", { class: better === false ? "better" : null }, baseline ?? "–"),
  );
}

/** Whether anything is known of a region. */
const known = ({ iou, depth_error, translation_angle, rotation_error }: PartScores, k: number) =>
  [iou, depth_error, translation_angle, rotation_error].some((list) => (list[k] ?? null) !== null);

function regionLine(found: PartScores, iou: number | null, k: number): HTMLElement {
  const turned = found.rotation_error[k];
  const cells = [
    iou === null ? "–" : fixed(iou, 2),
    share(found.depth_error[k]),
    share(found.flat_depth_error[k]),
    unit(found.translation_angle[k], 1, "°"),
    unit(turned === null || turned === undefined ? turned : (turned * 180) / Math.PI, 2, "°"),
  ];
  return make(
    "tr",
    {},
    make("th", { scope: "row" }, k === 0 ? words.background : words.curve(k)),
    ...cells.map((text) => make("td", {}, text)),
  );
}

function table(heads: string[], rows: HTMLElement[]): HTMLElement {
  const head = make("tr", {}, ...heads.map((text) => headCell(text)));
  return make("table", {}, make("thead", {}, head), make("tbody", {}, ...rows));
}

const headCell = (text: string) => (text ? make("th", { scope: "col" }, text) : make("td"));

type Maybe = number | null | undefined;

const unit = (value: Maybe, decimals: number, name: string) =>
  value === null || value === undefined
    ? "–"
    : `${fixed(value, decimals)} ${name}`.replace(" °", "°");

const share = (value: Maybe) => (value === null || value === undefined ? "–" : percent(value, 0));

const less = (a: Maybe, b: Maybe) =>
  a === null || a === undefined || b === null || b === undefined ? undefined : a <= b;
