/** What the timeline says: of a pass what changed and the equation that it came from, of two lines how far apart they are. */

import { count, number, percent } from "../format";
import { endOf, type Kept, type Line, type Timeline } from "./line";
import type { OptionEntry, OptionValues, Report } from "../worker/protocol";

type Last = NonNullable<Report["last"]>;

/** What a pass did, and where that comes from. */
const STAGES: Record<Last["stage"], [did: string, from: string]> = {
  planes: [
    "every region was taken for a plane, and its image motion fitted",
    "the data term of (7), by Gauss–Newton; labels by cheapest cuts",
  ],
  search: [
    "motions in many directions were tried for each region, and the best was kept with a relief",
    "(7) with (1), by Gauss–Newton from each of them; labels by cheapest cuts",
  ],
  selection: [
    "motion and relief were improved, and it was asked whether a region rests, turns, travels or does both",
    "(7), by Gauss–Newton, and a price for each number of a motion; labels by cheapest cuts",
  ],
  surfaces: [
    "motion and relief of each region were improved",
    "(7), by Gauss–Newton; labels by cheapest cuts",
  ],
  steps: [
    "depth was found pixel by pixel where a smooth relief fails",
    "ψ of (7) under every depth, neighbours kept alike",
  ],
  descent: [
    "motions, depth and curves took a step each",
    "(7): T and ω by least squares, depth by (9), curves by (17)",
  ],
};

/** One sentence on a pass. */
export function passSentence(
  timeline: Timeline,
  line: Line,
  at: number,
  { last, levels }: Report,
): string {
  if (!last) return `Pass ${at}.`;
  const scale = levels > 1 ? `, scale ${levels - last.level} of ${levels}` : "";
  const [did, from] = STAGES[last.stage];
  const parted = at === line.from + 1 && line.from > timeline.first ? wayOn(line) : "";
  if (last.taken_back) {
    return `${parted}Pass ${at}${scale}: ${did}; that raised (7), so labels, motions and relief were put back, and the scale is done with.`;
  }
  if (last.stage === "steps" && !last.adopted) {
    return `${parted}Pass ${at}${scale}: depth pixel by pixel would explain no region better, so nothing was changed. From ${from}.`;
  }
  return `${parted}Pass ${at}${scale}: ${did}; ${sides(last)}. From ${from}.`;
}

function sides({ changed, stage, adopted }: Last): string {
  if (stage === "steps") {
    return adopted === 1 ? "1 region took it" : `${adopted} regions took it`;
  }
  if (changed === 0) return "no pixel changed sides";
  return changed === 1 ? "1 pixel changed sides" : `${count(changed)} pixels changed sides`;
}

const wayOn = ({ from, whole }: Line) =>
  whole
    ? `Gone on from pass ${from}. `
    : `Gone on from the curves of pass ${from} alone: under these settings depth and motion start anew. `;

export const START = "The start: curves as drawn, one depth everywhere, nothing moves.";

/** Of a pass that was let go. */
export const thinnedSentence = (wanted: number, shown: number) =>
  wanted === shown ? "" : ` (Pass ${wanted} is no longer kept.)`;

/** The energy after a pass, and what became of that before it. */
export function energySentence({ first }: Timeline, line: Line, at: number): string {
  const energy = line.energies[at - first - 1];
  if (energy === undefined) return "";
  const before = line.energies[at - first - 2];
  const e = `E ${number(energy)}`;
  if (before === undefined) return `${e}.`;
  if (line.breaks.includes(at - 1)) return `${e}, a new sum.`;
  const change = energy / before - 1;
  if (Math.abs(change) < 5e-5) return `${e}, as before.`;
  return `${e}, ${percent(Math.abs(change), Math.abs(change) < 0.01 ? 2 : 1)} ${change < 0 ? "less" : "more"} than before.`;
}

/** The scale that a pass was made at, for the axis. */
export function scaleName({ report: { last, levels } }: Kept["pass"]): string {
  return last && levels > 1 ? `${levels - last.level}/${levels}` : "";
}

/** What lines are called. */
export function lineName({ first }: Timeline, line: Line, second: boolean): string {
  if (!second) return "First";
  return line.from === first ? "Second" : `From ${line.from}`;
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
    const values = apart.map((entry) => `${entry.label.toLowerCase()} ${valueOf(entry, set[i]!)}`);
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
  if (typeof value === "boolean") return value ? "on" : "off";
  return typeof value === "number" ? number(value) : "automatic";
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
  const labels = apart === null ? "" : ` Labels differ in ${percent(apart, 2)} of all pixels.`;
  const settings = differ ? ` What differs is set under ${differ}.` : " The settings are the same.";
  return `E is ${energies[0]} on the first line, ${energies[1]} on the second.${labels}${settings}`;
}
