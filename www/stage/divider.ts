/** The divider between two views: a button that sets it up, what either side shows, and the bar that is dragged. */

import { announce, byId, make } from "../dom";
import { percent } from "../format";
import { store, type State } from "../store";
import { text } from "../text";
import { sidesFor, sideOfView } from "./sides";
import { stagePane } from "./place";

const bar = () => byId<HTMLInputElement>("divider");
const SELECTS = ["left", "right"] as const;

export function mountDivider(): void {
  byId("split").addEventListener("click", toggle);
  bar().addEventListener("input", () => {
    const { split } = store.state;
    if (split) store.update({ split: { ...split, at: Number(bar().value) / 100 } });
  });
  for (const name of SELECTS) {
    const select = byId<HTMLSelectElement>(`side-${name}`);
    select.addEventListener("change", () => {
      const { split } = store.state;
      if (split) store.update({ split: { ...split, [name]: select.value } });
    });
  }
  store.watch(({ split, truth }) => [split, truth], show);
  store.watch(
    ({ view, viewParams, truth }) => [view, viewParams.motion, viewParams.error, truth],
    (state) => {
      const { split } = state;
      if (!split) return;
      // The view that is chosen takes the right side.
      const right = sideOfView(state);
      const known = sidesFor(state).some(({ id }) => id === split.left);
      const left = known ? split.left : "frame first";
      store.update({ split: right === null ? null : { left, right, at: split.at } });
    },
  );
}

function toggle(): void {
  const { state } = store;
  if (state.split) {
    store.update({ split: null });
    announce(text.split.off);
    return;
  }
  const own = sideOfView(state);
  const right = own && own !== "frame first" ? own : "frame second";
  store.update({
    split: { left: "frame first", right, at: 0.5 },
    // What is no flat picture cannot be beside one.
    ...(own ? {} : { view: "curves" }),
  });
  announce(text.split.on);
  bar().focus({ preventScroll: true });
}

function show(state: Readonly<State>): void {
  const { split } = state;
  byId("split").ariaPressed = String(split !== null);
  byId("sides").hidden = split === null;
  bar().hidden = split === null;
  if (!split) return;
  const all = sidesFor(state);
  const groups = [...new Set(all.map(({ whose }) => whose))];
  for (const name of SELECTS) {
    const select = byId<HTMLSelectElement>(`side-${name}`);
    const ids = [...select.options].map(({ value }) => value);
    if (ids.join() !== all.map(({ id }) => id).join()) {
      select.replaceChildren(
        ...groups.map((label) =>
          make(
            "optgroup",
            { label },
            ...all
              .filter(({ whose }) => whose === label)
              .map((one) => make("option", { value: one.id }, one.label)),
          ),
        ),
      );
    }
    select.value = split[name];
  }
  bar().value = String(100 * split.at);
  bar().setAttribute("aria-valuetext", text.split.at(percent(split.at, 0)));
}

/** Half the width of the thumb, as in the stylesheet. */
const HALF = 22;

/** Lays the bar over the picture, once that has its place. */
export function placeDivider(): void {
  const { left, width } = visible();
  bar().style.left = `${left - HALF}px`;
  bar().style.width = `${width + 2 * HALF}px`;
}

/** Where the divider is on the stage, in CSS pixels from the left. */
export function dividerAt(at: number): number {
  const { left, width } = visible();
  return left + at * width;
}

/** The part of the stage that the picture covers. */
function visible(): { left: number; width: number } {
  const { left, scale } = stagePane();
  const { clientWidth } = byId("stage");
  const from = Math.max(0, left);
  const to = Math.min(clientWidth, left + store.state.width * scale);
  return { left: from, width: Math.max(1, to - from) };
}
