/** Which view, what it lets one choose, which tool, which of the two frames. */

import { find, remove } from "../curves";
import { byId, make } from "../dom";
import { number } from "../format";
import { redo, undo } from "../memory/history";
import { look } from "../looking";
import { store, type Showing, type State, type Tool, type ViewParams } from "../store";
import { text } from "../text";
import { available, GROUPS, groupOf, viewOf, zoomStep, type Setting } from "../views";

export function mountViewbar(): void {
  store.watch(({ catalogues, truth }) => [catalogues, truth], buildViews);
  store.watch(({ view, catalogues }) => [view, catalogues], showView);
  store.watch(
    ({ view, finding }) => [view, finding],
    ({ view, finding }) => {
      byId("hint").textContent = (view === "curves" && finding) || viewOf(view).hint;
    },
  );
  store.watch(
    (state) => {
      const { view, viewParams, split, ranges } = state;
      return [view, viewParams, split?.left, split?.right, ranges, zoomStep(state)];
    },
    () => void look(),
  );
  // One setting may set another, and so may a link.
  store.watch(
    ({ viewParams }) => [viewParams],
    ({ viewParams }) => {
      for (const box of byId("view-choices").querySelectorAll<HTMLInputElement>(
        "[type=checkbox]",
      )) {
        box.checked = viewParams[box.id.replace("setting-", "") as keyof ViewParams] === true;
      }
      for (const select of byId("view-choices").querySelectorAll("select")) {
        select.value = String(viewParams[select.id.replace("setting-", "") as keyof ViewParams]);
      }
    },
  );
  new ResizeObserver(keepChosenInSight).observe(byId("views"));
  mountTools();
  mountShowing();
}

/** The view that was looked at last in a group of several. */
const lastIn = new Map<string, string>();

function buildViews(state: Readonly<State>): void {
  const there = new Set(available(state).map(({ id }) => id));
  const rows = [byId("views"), byId("views-within")] as const;
  for (const row of rows) row.querySelectorAll("label").forEach((label) => label.remove());
  for (const group of GROUPS) {
    const views = group.views.filter((id) => there.has(id));
    if (views.length === 0) continue;
    const single = group.views.length === 1;
    rows[0].append(
      segment("group", single ? `view-${group.id}` : `group-${group.id}`, group.label, () =>
        store.update({ view: lastIn.get(group.id) ?? views[0]! }),
      ),
    );
    if (single) continue;
    for (const id of views) {
      const label = segment("view", `view-${id}`, viewOf(id).label, () =>
        store.update({ view: id }),
      );
      label.dataset["group"] = group.id;
      rows[1].append(label);
    }
  }
  showView(store.state);
}

function segment(name: string, id: string, text: string, choose: () => void): HTMLLabelElement {
  const input = make("input", { type: "radio", name, value: id, id });
  input.addEventListener("change", choose);
  return make("label", {}, input, make("span", {}, text));
}

/** Scrolls the row of views, and nothing else, to the one that is chosen: a narrower window may have cut it off. */
function keepChosenInSight(): void {
  const row = byId("views");
  const chosen = row.querySelector("label:has(:checked)")?.getBoundingClientRect();
  if (chosen) {
    const { left, right } = row.getBoundingClientRect();
    row.scrollLeft += Math.min(0, chosen.left - left) + Math.max(0, chosen.right - right);
  }
}

function showView(state: Readonly<State>): void {
  const view = viewOf(state.view);
  const group = groupOf(view.id);
  lastIn.set(group.id, view.id);
  const within = byId("views-within");
  within.hidden = group.views.length === 1;
  for (const label of within.querySelectorAll("label")) {
    label.hidden = label.dataset["group"] !== group.id;
  }
  for (const id of [`view-${view.id}`, `group-${group.id}`]) {
    const radio = document.getElementById(id) as HTMLInputElement | null;
    if (radio) radio.checked = true;
  }
  byId("stage").dataset["view"] = view.id;
  const editable = view.id === "curves";
  byId("tools").hidden = !editable;
  byId("overlay").hidden = view.id === "relief";
  byId("overlay").ariaLabel = editable ? text.stage.overlay : text.stage.pixelByPixel(view.label);
  byId("zoom").hidden = view.id === "relief";
  byId("showing").hidden = !editable;
  byId("relief").hidden = view.id !== "relief";
  // Not only cleared: some browsers go on showing a canvas on which nothing but clearing happens.
  byId("picture").hidden = view.id === "relief";
  byId("view-choices").replaceChildren(...view.settings(state).map(control));
}

function set<K extends keyof ViewParams>(
  key: K,
  value: ViewParams[K],
  also: Partial<ViewParams> = {},
): void {
  store.update({ viewParams: { ...store.state.viewParams, ...also, [key]: value } });
}

function control({ key, label, choices, range, percent, also }: Setting): HTMLElement {
  const present = store.state.viewParams[key];
  const id = `setting-${key}`;
  if (choices) {
    const select = make("select", { id });
    select.append(...choices.map(({ value, label }) => make("option", { value }, label)));
    select.value = String(present);
    select.addEventListener("change", () => set(key, select.value as never));
    return make("label", { class: "field" }, make("span", {}, label), select);
  }
  if (range) {
    const slider = make("input", { type: "range", id, ...range });
    const output = make("output", { for: id });
    const tell = () => {
      const value = Number(slider.value);
      output.textContent = percent
        ? `${Number((100 * value).toFixed(2))}\u00a0%`
        : number(value, 2);
      slider.setAttribute("aria-valuetext", output.textContent);
    };
    slider.value = String(present);
    slider.addEventListener("input", () => {
      tell();
      set(key, Number(slider.value) as never, also);
    });
    tell();
    return make("label", { class: "field" }, make("span", {}, label), slider, output);
  }
  const box = make("input", { type: "checkbox", id });
  box.checked = present === true;
  box.addEventListener("change", () => set(key, box.checked as never));
  return make("label", { class: "check field" }, box, make("span", {}, label));
}

function mountTools(): void {
  const radios = [...document.querySelectorAll<HTMLInputElement>('input[name="tool"]')];
  for (const radio of radios) {
    radio.addEventListener("change", () => store.update({ tool: radio.value as Tool }));
  }
  byId("find").addEventListener("click", () => void find());
  byId("undo").addEventListener("click", undo);
  byId("redo").addEventListener("click", redo);
  byId("delete").addEventListener("click", () => {
    if (store.state.selected !== null) remove(store.state.selected);
  });
  store.watch(
    ({ tool, past, future, selected }) => [tool, past.length, future.length, selected],
    ({ tool, past, future, selected }) => {
      for (const radio of radios) radio.checked = radio.value === tool;
      byId("overlay").dataset["tool"] = tool;
      byId<HTMLButtonElement>("undo").disabled = past.length === 0;
      byId<HTMLButtonElement>("redo").disabled = future.length === 0;
      byId<HTMLButtonElement>("delete").disabled = selected === null;
    },
  );
  store.watch(
    ({ frames, busy, running }) => [frames, busy, running],
    ({ frames, busy, running }) => {
      byId<HTMLButtonElement>("find").disabled = !frames || busy !== null || running;
    },
  );
}

function mountShowing(): void {
  const radios = [...document.querySelectorAll<HTMLInputElement>('input[name="showing"]')];
  for (const radio of radios) {
    radio.addEventListener("change", () => store.update({ showing: radio.value as Showing }));
  }
  store.watch(
    ({ showing }) => [showing],
    ({ showing }) => {
      for (const radio of radios) radio.checked = radio.value === showing;
    },
  );
}
