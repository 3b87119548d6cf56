/**
 * The functional (7) falling, pass by pass.
 *
 * A finer scale has other pixels, smoothed less, and weights change once curves have settled and once motions
 * are held: energy is another sum from there on, so the line is broken.
 */

import uPlot from "uplot";

import { byId, themeColour } from "../dom";
import { compact, number, percent } from "../format";
import { store, type State } from "../store";
import { sentence } from "../wording";
import type { Report } from "../worker/protocol";

const HEIGHT = 160;
/** Room above the plot for the names of scales. */
const HEADROOM = 18;

let plot: uPlot | null = null;

export function mountEnergy(): void {
  byId("energy-log").addEventListener("change", rebuild);
  store.watch(
    ({ report, started }) => [report, started],
    (state) => {
      const shown = state.started && (state.report?.history.length ?? 0) > 0;
      byId("energy-panel").hidden = !shown;
      if (!shown) {
        plot?.destroy();
        plot = null;
        return;
      }
      if (plot) plot.setData(dataOf(state));
      else rebuild();
      byId("energy-text").textContent = inWords(state);
    },
  );
  new ResizeObserver(() => {
    const width = byId("energy-plot").clientWidth;
    if (plot && width > 0 && plot.width !== width) plot.setSize({ width, height: HEIGHT });
  }).observe(byId("energy-plot"));
}

/** A new plot: with another scale, or in other colours. */
export function rebuild(): void {
  const place = byId("energy-plot");
  plot?.destroy();
  plot = null;
  if (byId("energy-panel").hidden) return;
  const logarithmic = byId<HTMLInputElement>("energy-log").checked;
  const soft = themeColour("--ink-soft");
  const grid = { stroke: themeColour("--line"), width: 1 };
  const font = "12px system-ui, sans-serif";
  plot = new uPlot(
    {
      width: place.clientWidth || 300,
      height: HEIGHT,
      padding: [HEADROOM, null, null, null],
      cursor: { show: false },
      legend: { show: false },
      scales: {
        x: { time: false },
        y: logarithmic ? { distr: 3 } : { range: (_, __, max) => [0, max * 1.05 || 1] },
      },
      axes: [
        { stroke: soft, grid, font, size: 28, ticks: { show: false }, incrs: WHOLE },
        { stroke: soft, grid, font, size: 48, ticks: { show: false }, values: labels },
      ],
      series: [
        { label: "Pass" },
        {
          label: "Energy",
          stroke: themeColour("--cyan"),
          width: 2,
          // One pass makes no line.
          points: { show: (_, __, first, last) => first === last, size: 6 },
        },
      ],
      hooks: { draw: [markBreaks] },
    },
    dataOf(store.state),
    place,
  );
}

/** Passes are counted in whole numbers. */
const WHOLE = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];

const labels = (_: uPlot, values: (number | null)[]) =>
  values.map((value) => (value === null ? "" : compact(value)));

interface Break {
  /** Passes that had been made. */
  after: number;
  /** What began, beside the line and in a sentence. */
  name: string;
  place: string;
}

/** Where energy became another sum, as far as a pass has been made since. */
function breaks({ refined, settled, rested, history }: Report): Break[] {
  const finer = refined.map((after, i) => {
    const name = `scale ${i + 2}`;
    return { after, name, place: ` on ${name}` };
  });
  const still = settled.map((after) => ({
    after,
    name: "settled",
    place: " once curves had settled",
  }));
  const held = rested.map((after) => ({
    after,
    name: "at rest",
    place: " once motions were held",
  }));
  const all = [...finer, ...still, ...held].sort((a, b) => a.after - b.after);
  return all.filter(({ after }) => after < history.length);
}

/** Passes and their energy, with nothing in between where it became another sum. */
function dataOf({ report }: Readonly<State>): uPlot.AlignedData {
  const broken = new Set(report ? breaks(report).map(({ after }) => after) : []);
  const passes: number[] = [];
  const energies: (number | null)[] = [];
  for (const [i, energy] of (report?.history ?? []).entries()) {
    if (broken.has(i)) {
      passes.push(i + 0.5);
      energies.push(null);
    }
    passes.push(i + 1);
    energies.push(energy);
  }
  return [passes, energies];
}

/**
 * A dashed line where energy became another sum, and above it what began: names of scales end there, others start.
 * Where a scale took few passes there is room for its number alone.
 */
function markBreaks(chart: uPlot): void {
  const { ctx, bbox } = chart;
  const { report } = store.state;
  const ratio = window.devicePixelRatio || 1;
  ctx.save();
  ctx.strokeStyle = ctx.fillStyle = themeColour("--ink-soft");
  ctx.lineWidth = ratio;
  ctx.setLineDash([3 * ratio, 3 * ratio]);
  ctx.font = `${11 * ratio}px system-ui, sans-serif`;
  ctx.textBaseline = "bottom";
  const gap = 3 * ratio;
  let taken = 0;
  for (const { after, name } of report ? breaks(report) : []) {
    const x = Math.round(chart.valToPos(after + 0.5, "x", true));
    ctx.beginPath();
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
    ctx.stroke();
    const before = name.startsWith("scale");
    const end = before ? x + gap : x - gap + ctx.measureText(name).width;
    const short = before && end - ctx.measureText(name).width < taken + gap;
    ctx.textAlign = before ? "right" : "left";
    ctx.fillText(short ? name.replace("scale ", "") : name, before ? end : x - gap, bbox.top - gap);
    taken = end;
  }
  ctx.restore();
}

function inWords({ report }: Readonly<State>): string {
  if (!report) return "";
  const { data, smoothness, length, total } = report.energy;
  const part = (value: number) => percent(value / (total || 1), 0);
  const left = `Of what is left, ${part(data)} is misfit of the frames, ${part(smoothness)} depth's roughness, ${part(length)} length of curves.`;
  const begun = breaks(report);
  // What the passes came to, as the line shows it: curves moved since have an energy of their own.
  const fall = (start: number, end: number, place: string) => {
    const passes = report.history.slice(start, end).map((energy) => number(energy));
    const [first = number(total), ...later] = passes;
    return later.length > 0 ? `from ${first} to ${later.at(-1)}${place}` : `${first}${place}`;
  };
  const all = report.history.length;
  if (begun.length === 0)
    return `${sentence(fall(0, all, all === 1 ? " after one pass" : ""))} ${left}`;
  const parts = [{ after: 0, place: " on scale 1" }, ...begun];
  const falls = parts.map(({ after, place }, i) => fall(after, parts[i + 1]?.after ?? all, place));
  return `${sentence(falls.join(", "))} ${left} A dashed line is where a finer scale begins, with other pixels, or where curves have settled or motions are held, with other weights: energy can be compared only between two lines.`;
}
