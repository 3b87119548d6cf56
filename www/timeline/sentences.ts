/** What the timeline says: of a pass what changed and the equation that it came from, of two lines how far apart they are. */

import { count, number, percent } from "../format";
import { text } from "../text";
import { endOf, type Kept, type Line, type Timeline } from "./line";
import type { OptionEntry, OptionValues, Report } from "../worker/protocol";

type Last = NonNullable<Report["last"]>;

const words = text.timeline;

/** A part of what is said; what is aside can be left out where there is little room. */
export interface Said {
  words: string;
  aside: boolean;
}

const first = (words: string): Said => ({ words, aside: false });
const aside = (words: string): Said => ({ words, aside: true });

/** What is said of a pass, to be put one after the other. */
export function passSaid(timeline: Timeline, line: Line, at: number, report: Report): Said[] {
  const { last, levels } = report;
  if (!last) return [first(words.bare(at))];
  const { stage } = last;
  const parted = at === line.from + 1 && line.from > timeline.first;
  return [
    first(words.passDid(at)),
    aside(levels > 1 ? words.scaleOf(levels - last.level, levels) : ""),
    first(last.taken_back ? words.takenBack(stage) : none(last) ? words.noSteps : words.did(stage)),
    ...[parted ? wayOn(line) : "", cameTo(last), last.taken_back ? "" : words.cameFrom(stage)]
      .filter(Boolean)
      .map((words) => aside(` ${words}`)),
  ];
}

/** Whether depth pixel by pixel explained no region better. */
const none = ({ stage, adopted }: Last) => stage === "steps" && !adopted;

function cameTo(last: Last): string {
  const { stage, adopted, taken_back, changed } = last;
  if (taken_back) return words.finished;
  if (none(last)) return words.nothingChanged;
  return stage === "steps" ? words.adopted(adopted) : words.changed(changed, count(changed));
}

const wayOn = ({ from, whole }: Line) =>
  whole ? words.goneOn(from) : words.goneOnFromCurves(from);

/** Of a pass that was let go. */
export const thinnedSentence = (wanted: number, shown: number) =>
  wanted === shown ? "" : ` ${words.notKept(wanted)}`;

/** The energy after a pass, and what became of that before it. */
export function energySentence({ first }: Timeline, line: Line, at: number): string {
  const energy = line.energies[at - first - 1];
  if (energy === undefined) return "";
  const before = line.energies[at - first - 2];
  const e = number(energy);
  if (before === undefined) return words.energy(e);
  if (line.breaks.includes(at - 1)) return words.newSum(e);
  const change = energy / before - 1;
  if (Math.abs(change) < 5e-5) return words.asBefore(e);
  const share = percent(Math.abs(change), Math.abs(change) < 0.01 ? 2 : 1);
  return change < 0 ? words.less(e, share) : words.more(e, share);
}

/** The scale that a pass was made at, for the axis. */
export function scaleName({ report: { last, levels } }: Kept["pass"]): string {
  return last && levels > 1 ? `${levels - last.level}/${levels}` : "";
}

/** What lines are called. */
export function lineName({ first }: Timeline, line: Line, second: boolean): string {
  if (!second) return words.first;
  return line.from === first ? words.second : words.from(line.from);
}

/** Settings of one line that are others in the other; `labels` are the options' names. */
export function differences(
  one: OptionValues,
  other: OptionValues,
  labels: { key: string; label: string }[],
): string {
  const value = (options: OptionValues, key: string) =>
    JSON.stringify((options as Record<string, unknown>)[key] ?? null);
  const names = labels.filter(({ key }) => value(one, key) !== value(other, key));
  return names.map(({ label }) => label).join(", ");
}

/** What each of two lines is called, with the settings that tell them apart. */
export function namesOf(timeline: Timeline, options: OptionEntry[]): string[] {
  const set = timeline.lines.map(
    (line) => (line.passes.at(-1)?.pass.setup.options ?? {}) as Record<string, unknown>,
  );
  const apart = options.filter(({ key }) => new Set(set.map((one) => shown(one[key]))).size > 1);
  return timeline.lines.map((line, i) => {
    const values = apart.map((entry) => words.setting(entry.label, valueOf(entry, set[i]!)));
    return [lineName(timeline, line, i > 0), values.join(", ")].filter(Boolean).join(": ");
  });
}

const shown = (value: unknown) => JSON.stringify(value ?? null);

function valueOf(entry: OptionEntry, set: Record<string, unknown>): string {
  const preset = String(set["preset"] ?? "best") as keyof OptionEntry["defaults"];
  const value = set[entry.key] ?? entry.defaults[preset];
  if (entry.kind === "choice") {
    return entry.choices.find((one) => one.value === value)?.label ?? String(value);
  }
  if (typeof value === "boolean") return value ? words.on : words.off;
  return typeof value === "number" ? number(value) : words.automatic;
}

/** Two lines at a pass. */
export function comparison(
  timeline: Timeline,
  at: number,
  apart: number | null,
  differ: string,
): string {
  const energies = timeline.lines.map((line) => {
    const end = Math.min(at, endOf(timeline, line));
    return number(line.energies[end - timeline.first - 1] ?? NaN);
  });
  return [
    words.energies(energies[0]!, energies[1]!),
    apart === null ? "" : words.apart(percent(apart, 2)),
    differ ? words.differ(differ) : words.same,
  ]
    .filter(Boolean)
    .join(" ");
}
