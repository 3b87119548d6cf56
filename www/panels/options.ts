/**
 * The form for the solver's options, made from the core's own list.
 *
 * The store keeps only what was changed; everything else is the preset's. A weight that can be chosen
 * from the data shows what was chosen.
 */

import { byId, make } from "../dom";
import { number } from "../format";
import { configure } from "../session";
import { store, type State } from "../store";
import type { OptionDescriptor } from "../worker/protocol";
import { fromSlider, STEPS, toSlider } from "./slider";

type Value = number | string | boolean | null;

export function mountOptions(): void {
  store.watch(({ catalogues }) => [catalogues], build);
  store.watch(({ options, report, catalogues }) => [options, report?.weights, catalogues], refresh);
  byId("options-reset").addEventListener("click", () => {
    const { preset } = store.state.options;
    change(preset === undefined ? {} : { preset });
  });
}

function change(options: State["options"]): void {
  store.update({ options });
  void configure();
}

function set(key: string, value: Value): void {
  change({ ...store.state.options, [key]: value });
}

/** What an option is now: as it was changed, or as the preset has it. */
function valueOf({ options, catalogues }: Readonly<State>, { key, defaults }: OptionDescriptor) {
  const changed = options[key];
  if (changed !== undefined) return changed;
  const preset = options["preset"] ?? catalogues?.presets[0]?.value ?? "";
  return defaults?.[String(preset)] ?? null;
}

let fields: {
  descriptor: OptionDescriptor;
  show: (value: Value, chosen: number | null) => void;
}[] = [];

function build({ catalogues }: Readonly<State>): void {
  if (!catalogues) return;
  fields = [];
  const preset = presetField(catalogues.presets);
  const rows = catalogues.options.map((descriptor) => {
    const { element, show } = field(descriptor);
    fields.push({ descriptor, show });
    return element;
  });
  const details = make("details", {}, make("summary", {}, "Weights and choices"), ...rows);
  byId("options").replaceChildren(...(preset ? [preset] : []), details);
}

function presetField(presets: { value: string; label: string }[]): HTMLElement | null {
  if (presets.length < 2) return null;
  const select = make("select", { id: "option-preset" });
  select.append(
    ...presets.map(({ value, label }) => make("option", { value }, `${value}: ${label}`)),
  );
  select.addEventListener("change", () => change({ preset: select.value }));
  return make("label", { class: "field" }, make("span", {}, "Preset"), select);
}

function field(descriptor: OptionDescriptor) {
  const { key, label, meaning, term, unit, kind, automatic } = descriptor;
  const id = `option-${key}`;
  const head = make("div", { class: "option-head" }, make("label", { for: id }, label));
  const help = make("p", { class: "note", id: `${id}-help` }, meaning, " ");
  if (term) help.append(make("span", { class: "term" }, term));
  const element = make("div", { class: "option" }, head);
  let show: (value: Value, chosen: number | null) => void;

  if (kind === "choice") {
    const select = make("select", { id, "aria-describedby": `${id}-help` });
    select.append(
      ...(descriptor.choices ?? []).map(({ value, label }) => make("option", { value }, label)),
    );
    select.addEventListener("change", () => set(key, select.value));
    // A choice of one is a fact, not a question.
    select.disabled = select.options.length < 2;
    show = (value) => (select.value = String(value));
    element.append(select);
  } else if (kind === "toggle") {
    const box = make("input", { type: "checkbox", id, "aria-describedby": `${id}-help` });
    box.addEventListener("change", () => set(key, box.checked));
    show = (value) => (box.checked = value === true);
    head.append(box);
  } else {
    const slider = make("input", { type: "range", min: 0, max: STEPS, step: 1 });
    slider.setAttribute("aria-label", label);
    const exact = make("input", {
      type: "number",
      id,
      step: "any",
      "aria-describedby": `${id}-help`,
    });
    slider.addEventListener("input", () => {
      exact.value = String(fromSlider(descriptor, Number(slider.value)));
    });
    slider.addEventListener("change", () => set(key, fromSlider(descriptor, Number(slider.value))));
    exact.addEventListener("change", () => {
      if (exact.value.trim() !== "") set(key, Number(exact.value));
    });
    const value = make("div", { class: "value" }, slider, exact);
    const auto = make("input", { type: "checkbox", id: `${id}-auto` });
    if (automatic) {
      auto.addEventListener("change", () =>
        set(key, auto.checked ? null : Number(exact.value) || 0),
      );
      head.append(make("label", { class: "check" }, auto, "from the data"));
    }
    if (unit) help.append(` · ${unit}`);
    show = (present, chosen) => {
      const free = automatic === true && present === null;
      auto.checked = free;
      slider.disabled = free;
      exact.disabled = free;
      const shown = free ? chosen : Number(present);
      // Not under the fingers of someone who types while it runs.
      if (document.activeElement !== exact) {
        exact.value = shown === null ? "" : String(Number(shown.toPrecision(4)));
      }
      exact.placeholder = free ? "auto" : "";
      slider.value = String(shown === null ? 0 : toSlider(descriptor, shown));
      slider.setAttribute(
        "aria-valuetext",
        shown === null ? "chosen from the data" : number(shown),
      );
    };
    element.append(value);
  }
  element.append(help);
  return { element, show };
}

function refresh(state: Readonly<State>): void {
  for (const { descriptor, show } of fields) {
    const chosen = state.report?.weights[descriptor.key];
    show(valueOf(state, descriptor), typeof chosen === "number" && chosen > 0 ? chosen : null);
  }
  const preset = document.getElementById("option-preset") as HTMLSelectElement | null;
  if (preset && state.options["preset"] !== undefined) {
    preset.value = String(state.options["preset"]);
  }
  const changed = Object.keys(state.options).some((key) => key !== "preset");
  byId("options-reset").hidden = !changed;
}
