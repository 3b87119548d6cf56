/**
 * One row for each region: its colour, its size, its motion, and the depth factor that two frames
 * leave open.
 */

import { remove, select } from "../curves";
import { byId, icon, make } from "../dom";
import { count, fixed, number, percent } from "../format";
import { inUse } from "../intake/slots";
import { look } from "../looking";
import { addAtCentre } from "../stage/tools";
import { store, type State } from "../store";
import { text } from "../text";
import type { RegionReport, Shape } from "../worker/protocol";
import { fieldsButton } from "./frames";

const words = text.regions;

export function mountRegions(): void {
  byId("add-circle").addEventListener("click", () => {
    store.update({ view: "curves", tool: "select" });
    addAtCentre();
  });
  store.watch(({ shapes, catalogues, width }) => [shapes.length, catalogues, width], build);
  store.watchAfter(
    ({ shapes, selected, report, started, catalogues, frames, slots }) => [
      shapes,
      selected,
      report,
      started,
      catalogues,
      frames,
      slots,
    ],
    refresh,
  );
}

let rows: HTMLElement[] = [];

function build({ shapes, catalogues, width }: Readonly<State>): void {
  // A recording is there before its frames.
  const regions = width > 0 ? shapes.length + 1 : 0;
  rows = Array.from({ length: regions }, (_, label) =>
    row(label, catalogues?.colours[label] ?? "grey"),
  );
  byId("regions").replaceChildren(...rows);
  refresh(store.state);
}

function row(label: number, colour: string): HTMLElement {
  const chip = make("span", { class: "chip", "aria-hidden": "true" });
  chip.style.background = colour;
  const head = make("div", { class: "region-head" }, chip);
  if (label === 0) {
    head.append(make("strong", {}, words.background));
  } else {
    const choose = make("button", { type: "button", class: "choose" }, words.curve(label));
    choose.addEventListener("click", () => {
      store.update({ view: "curves", tool: "select" });
      select(label - 1);
      byId("overlay").focus({ preventScroll: true });
    });
    head.append(choose);
  }
  head.append(make("span", { class: "facts" }));
  if (label > 0) {
    const drop = make("button", { type: "button", class: "quiet icon-only" }, icon("delete"));
    drop.append(make("span", { class: "visually-hidden" }, words.remove(label)));
    drop.addEventListener("click", () => {
      remove(label - 1);
      holdPlace(label);
    });
    head.append(drop);
  }
  return make("li", { class: "region" }, head, motionTable(), scale(label));
}

/** The row is gone and others are new: the keyboard goes on at the one that moved up, or the last. */
function holdPlace(label: number): void {
  const drops = document.querySelectorAll<HTMLElement>("#regions button.icon-only");
  (drops[Math.min(label, drops.length) - 1] ?? byId("add-circle")).focus();
}

function motionTable(): HTMLElement {
  const line = (name: string, hint: string, unit: string) => [
    make("i", { title: hint }, name),
    ...[0, 1, 2].map(() => make("span", { "data-number": name })),
    make("span", { class: "unit" }, unit),
  ];
  return make(
    "div",
    { class: "motion" },
    ...line("T", words.translation, "· Z̄"),
    ...line("ω", words.rotation, "°"),
  );
}

/** Factors between a quarter and four, the middle of the slider leaving depth as it is. */
function scale(label: number): HTMLElement {
  const id = `scale-${label}`;
  const slider = make("input", { type: "range", id, min: -2, max: 2, step: 0.05, value: 0 });
  const output = make("output", { for: id }, "×1");
  slider.addEventListener("input", () => {
    const factor = 2 ** Number(slider.value);
    output.textContent = `×${number(factor, 2)}`;
    const scales = store.state.shapes.map(() => 1);
    scales.push(1);
    store.update({
      scales: scales.map((one, k) => (k === label ? factor : (store.state.scales[k] ?? one))),
    });
    void look();
  });
  return make("div", { class: "scale" }, make("label", { for: id }, words.depth), slider, output);
}

function refresh(state: Readonly<State>): void {
  const { shapes, selected, report, started, frames, slots, interlaced } = state;
  for (const [label, element] of rows.entries()) {
    const region = started ? report?.regions.find((one) => one.label === label) : undefined;
    const chosen = label > 0 && selected === label - 1;
    element.classList.toggle("selected", chosen);
    element.querySelector(".choose")?.setAttribute("aria-pressed", String(chosen));
    const shape = shapes[label - 1];
    const facts = element.querySelector(".facts")!;
    facts.textContent = region ? facing(region) : shape ? briefly(shape) : words.rest;
    const table = element.querySelector<HTMLElement>(".motion")!;
    table.hidden = !region?.rigid;
    element.querySelector<HTMLElement>(".scale")!.hidden = !region || rows.length < 2;
    if (region) fill(table, region);
  }
  byId("regions-note").textContent = !frames ? "" : notes(shapes.length, started);
  const warnings = started ? (report?.warnings ?? []) : [];
  const lines = warnings.map((text) => make("li", {}, text));
  const [first] = slots;
  if (started && first && interlaced[0] && inUse(state)) {
    lines.push(make("li", {}, fieldsButton("fields-instead", first)));
  }
  byId("warnings").replaceChildren(...lines);
}

function notes(curves: number, started: boolean): string {
  if (curves === 0) return words.noCurve;
  return started ? words.scales : words.rough;
}

const briefly = (shape: Shape) =>
  shape.kind === "circle"
    ? words.circle(Math.round(shape.x), Math.round(shape.y), Math.round(shape.r))
    : words.corners(shape.points.length);

/** Curves are in front of the background anyway: only other curves are worth a word. */
function facing({
  pixels,
  share,
  model,
  rigid,
  part_of,
  ambiguous,
  in_front_of,
}: RegionReport): string {
  const facts: string[] = [
    `${count(pixels)}\u00a0px\u00a0·\u00a0${percent(share)}`,
    rigid ? words.models[model] : words.nonRigid,
  ];
  if (part_of != null) facts.push(part_of > 0 ? words.oneWith(part_of) : words.isBackground);
  if (ambiguous) facts.push(words.ambiguous);
  const curves = in_front_of.filter((label) => label > 0);
  if (curves.length > 0) facts.push(words.inFrontOf(curves));
  return facts.join(" · ");
}

function fill(table: HTMLElement, region: RegionReport): void {
  const cells = [...table.querySelectorAll<HTMLElement>("[data-number]")];
  const degrees = region.rotation.map((angle) => (angle * 180) / Math.PI);
  const texts = [
    ...region.translation.map((value) => fixed(value, 4)),
    ...degrees.map((value) => fixed(value, 3)),
  ];
  cells.forEach((cell, i) => (cell.textContent = texts[i] ?? ""));
}
