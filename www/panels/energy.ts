/**
 * The functional (7) falling, pass by pass.
 *
 * Where a finer scale begins or weights are chosen anew, energy is another sum from there on: the line is broken.
 */

import uPlot from "uplot";

import { byId, themeColour } from "../dom";
import { compact, number, percent } from "../format";
import { store, type State } from "../store";
import { text } from "../text";
import { sentence } from "../wording";
import type { Report } from "../worker/protocol";

const words = text.energy;

const HEIGHT = 160;
let plot: uPlot | null = null;

export function mountEnergy(): void {
  byId("energy-log").addEventListener("change", () => rebuild());
  store.watchAfter(
    ({ report, started, running }) => [report, started, running],
    (state) => {
      const shown = state.started && (state.report?.history.length ?? 0) > 0;
      byId("energy-panel").hidden = !shown;
      if (!shown) return;
      if (plot) plot.setData(dataOf(state));
      else rebuild();
      byId("energy-text").textContent = inWords(state);
    },
  );
  // The first plot takes the browser long: made while nobody waits, it does not hold up the first pass.
  store.watch(
    ({ frames }) => [frames !== null],
    ({ frames }) => frames && whenIdle(prepare),
  );
  // Not in the frame in which all else takes its new size.
  new ResizeObserver(() => setTimeout(fit)).observe(byId("energy-plot"));
}

function fit(): void {
  const width = byId("energy-plot").clientWidth;
  if (plot && width > 0 && plot.width !== width) plot.setSize({ width, height: HEIGHT });
}

/** With something to draw: fonts take time as well. */
function prepare(): void {
  if (!plot) rebuild([SAMPLE, SAMPLE]);
}

const SAMPLE = [1, 2, 3];

const whenIdle = (work: () => void) =>
  "requestIdleCallback" in window ? requestIdleCallback(work) : setTimeout(work, 500);

/** The plot in other colours. */
export function recolour(): void {
  if (plot) rebuild();
}

/** A new plot. */
function rebuild(data = dataOf(store.state)): void {
  const place = byId("energy-plot");
  plot?.destroy();
  const logarithmic = byId<HTMLInputElement>("energy-log").checked;
  const soft = themeColour("--ink-soft");
  const grid = { stroke: themeColour("--line"), width: 1 };
  const font = "12px system-ui, sans-serif";
  plot = new uPlot(
    {
      width: place.clientWidth || 300,
      height: HEIGHT,
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
        { label: words.pass },
        {
          label: words.energy,
          stroke: themeColour("--cyan"),
          width: 2,
          // A pass between two breaks makes no line.
          points: { show: true, size: 5 },
        },
      ],
      hooks: { draw: [markBreaks] },
    },
    data,
    place,
  );
}

/** Passes are counted in whole numbers. */
const WHOLE = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];

const labels = (_: uPlot, values: (number | null)[]) =>
  values.map((value) => (value === null ? "" : compact(value)));

/** Passes after which energy became another sum, as far as a pass has been made since. */
const breaks = ({ breaks, history }: Report) =>
  [...new Set(breaks)].filter((after) => after > 0 && after < history.length);

/** Passes and their energy, with nothing in between where it became another sum. */
function dataOf({ report }: Readonly<State>): uPlot.AlignedData {
  const broken = new Set(report ? breaks(report) : []);
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

/** A dashed line where energy became another sum. */
function markBreaks(chart: uPlot): void {
  const { ctx, bbox } = chart;
  const { report } = store.state;
  const ratio = window.devicePixelRatio || 1;
  ctx.save();
  ctx.strokeStyle = themeColour("--ink-soft");
  ctx.lineWidth = ratio;
  ctx.setLineDash([3 * ratio, 3 * ratio]);
  ctx.beginPath();
  for (const after of report ? breaks(report) : []) {
    const x = Math.round(chart.valToPos(after + 0.5, "x", true));
    ctx.moveTo(x, bbox.top);
    ctx.lineTo(x, bbox.top + bbox.height);
  }
  ctx.stroke();
  ctx.restore();
}

function inWords({ report, running }: Readonly<State>): string {
  if (!report) return "";
  const { data, smoothness, length, total } = report.energy;
  const part = (value: number) => percent(value / (total || 1), 0);
  const left = words.left(part(data), part(smoothness), part(length));
  // What the passes came to, as the line shows it: curves moved since have an energy of their own.
  if (!running && report.status === "running" && report.breaks.includes(report.history.length)) {
    return words.newSum;
  }
  const since = breaks(report).at(-1) ?? 0;
  const [first = number(total), ...later] = report.history.slice(since).map((e) => number(e));
  const fall = later.length > 0 ? words.fell(first, later.at(-1)!) : words.once(first);
  if (since === 0) return `${sentence(fall)} ${left}`;
  return words.sinceLine(fall, left);
}
