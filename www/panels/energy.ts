/** The functional (7) falling, pass by pass. */

import uPlot from "uplot";

import { byId, themeColour } from "../dom";
import { compact, number, percent } from "../format";
import { store, type State } from "../store";

const HEIGHT = 150;

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
          points: { show: false },
        },
      ],
    },
    dataOf(store.state),
    place,
  );
}

/** Passes are counted in whole numbers. */
const WHOLE = [1, 2, 5, 10, 20, 50, 100, 200, 500, 1000, 2000, 5000];

const labels = (_: uPlot, values: (number | null)[]) =>
  values.map((value) => (value === null ? "" : compact(value)));

function dataOf({ report }: Readonly<State>): uPlot.AlignedData {
  const history = report?.history ?? [];
  return [history.map((_, i) => i + 1), history];
}

function inWords({ report }: Readonly<State>): string {
  if (!report) return "";
  const { data, smoothness, length, total } = report.energy;
  const first = report.history[0] ?? total;
  const part = (value: number) => percent(value / (total || 1), 0);
  return `From ${number(first)} to ${number(total)}. Of what is left, ${part(data)} is misfit of the frames, ${part(smoothness)} depth's roughness, ${part(length)} length of curves.`;
}
