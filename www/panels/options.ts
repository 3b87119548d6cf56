/**
 * The form for the solver's options, made from the core's own list: the preset and the main ones first, the others
 * under the term of (7) that they belong to.
 *
 * The store keeps only what was changed; everything else is the preset's. A weight that can be chosen
 * from the data shows what was chosen.
 */

import { byId, make } from "../dom";
import { number } from "../format";
import { change as record } from "../memory/history";
import { store, type State } from "../store";
import { text } from "../text";
import type { OptionEntry, OptionValues, PresetEntry } from "../worker/protocol";
import { fromSlider, STEPS, toSlider } from "./slider";

const words = text.options;

type Value = number | string | boolean | null;

export function mountOptions(): void {
  store.watch(({ catalogues }) => [catalogues], build);
  store.watch(({ options, report, catalogues }) => [options, report?.weights, catalogues], refresh);
  byId("options-reset").addEventListener("click", () => {
    const { preset } = store.state.options;
    change(preset ? { preset } : {});
  });
}

function change(options: OptionValues): void {
  record({ options });
}

function set(key: OptionEntry["key"], value: Value): void {
  change({ ...store.state.options, [key]: value });
}

/** The preset in force. */
const presetOf = ({ options, catalogues }: Readonly<State>) =>
  catalogues?.presets.find(({ value }, i) => (options.preset ? value === options.preset : i === 0));

/** What an option is now: as it was changed, or as the preset has it. */
function valueOf(state: Readonly<State>, { key, defaults }: OptionEntry): Value {
  const changed = state.options[key];
  if (changed !== undefined) return changed;
  const preset = presetOf(state);
  return preset ? defaults[preset.value] : null;
}

interface Field {
  descriptor: OptionEntry;
  /** Shows a value, or what was chosen from the data; `idle`: the option has no effect. */
  show: (value: Value, chosen: number | null, idle: boolean) => void;
  /** Why the option has no effect, where it has none. */
  reason: HTMLElement;
}

let fields: Field[] = [];

function build({ catalogues }: Readonly<State>): void {
  if (!catalogues) return;
  fields = [];
  const preset = presetField(catalogues.presets);
  const rows = catalogues.options.map((descriptor) => {
    const { element, show, reason } = field(descriptor);
    fields.push({ descriptor, show, reason });
    return { descriptor, element };
  });
  const rest = catalogues.options.filter(({ main }) => !main);
  const rowsWhere = (holds: (descriptor: OptionEntry) => boolean) =>
    rows.filter(({ descriptor }) => holds(descriptor)).map(({ element }) => element);
  byId("options").replaceChildren(...(preset ? [preset] : []), ...rowsWhere(({ main }) => main));
  const groups = [...new Set(rest.map(({ group }) => group))];
  byId("option-groups").replaceChildren(
    ...groups.map((name) =>
      make(
        "details",
        {},
        make("summary", {}, name),
        ...rowsWhere(({ main, group }) => !main && group === name),
      ),
    ),
  );
}

function presetField(presets: PresetEntry[]): HTMLElement | null {
  if (presets.length < 2) return null;
  const select = make("select", { id: "option-preset" });
  select.append(
    ...presets.map(({ value, label }) => make("option", { value }, `${value}: ${label}`)),
  );
  select.addEventListener("change", () => change({ preset: presets[select.selectedIndex]!.value }));
  return make("label", { class: "field" }, make("span", {}, words.preset), select);
}

function field(descriptor: OptionEntry) {
  const { key, label, meaning, term, unit } = descriptor;
  const id = `option-${key}`;
  const head = make("div", { class: "option-head" }, make("label", { for: id }, label));
  const help = make("p", { class: "note", id: `${id}-help` }, meaning, " ");
  // What is no term of an equation is said by the heading.
  if (term.includes("(")) help.append(make("span", { class: "term" }, term));
  const reason = make("strong", { class: "reason" });
  help.prepend(reason);
  const element = make("div", { class: "option" }, head);
  let show: Field["show"];

  if (descriptor.kind === "choice") {
    const select = make("select", { id, "aria-describedby": `${id}-help` });
    select.append(
      ...descriptor.choices.map(({ value, label }) => make("option", { value }, label)),
    );
    select.addEventListener("change", () => set(key, select.value));
    show = (value, _, idle) => {
      select.value = String(value);
      // A choice of one is a fact, not a question.
      select.disabled = idle || select.options.length < 2;
    };
    element.append(select);
  } else if (descriptor.kind === "toggle") {
    const box = make("input", { type: "checkbox", id, "aria-describedby": `${id}-help` });
    box.addEventListener("change", () => set(key, box.checked));
    show = (value, _, idle) => {
      box.checked = value === true;
      box.disabled = idle;
    };
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
    const automatic = descriptor.kind === "number" && descriptor.automatic;
    const auto = make("input", { type: "checkbox", id: `${id}-auto` });
    if (automatic) {
      auto.addEventListener("change", () =>
        set(key, auto.checked ? null : Number(exact.value) || 0),
      );
      head.append(make("label", { class: "check" }, auto, words.automatic));
    }
    if (unit) help.append(` · ${unit}`);
    show = (present, chosen, idle) => {
      const free = automatic && present === null;
      auto.checked = free;
      auto.disabled = idle;
      slider.disabled = free || idle;
      exact.disabled = free || idle;
      const shown = free ? chosen : Number(present);
      // Not under the fingers of someone who types while it runs.
      if (document.activeElement !== exact) {
        exact.value = shown === null ? "" : String(Number(shown.toPrecision(4)));
      }
      exact.placeholder = free ? words.placeholder : "";
      slider.value = String(shown === null ? 0 : toSlider(descriptor, shown));
      slider.setAttribute("aria-valuetext", shown === null ? words.chosen : number(shown));
    };
    element.append(value);
  }
  element.append(help);
  return { element, show, reason };
}

function refresh(state: Readonly<State>): void {
  const present = presetOf(state);
  for (const { descriptor, show, reason } of fields) {
    const weights: Partial<Record<string, number>> = { ...state.report?.weights };
    const chosen = weights[descriptor.key];
    const idle = present !== undefined && !descriptor.presets.includes(present.value);
    show(valueOf(state, descriptor), chosen && chosen > 0 ? chosen : null, idle);
    reason.textContent = idle ? `${words.idle(present.value)} ` : "";
  }
  const preset = document.getElementById("option-preset") as HTMLSelectElement | null;
  if (preset && present) preset.value = present.value;
  const changed = Object.keys(state.options).some((key) => key !== "preset");
  byId("options-reset").hidden = !changed;
}
