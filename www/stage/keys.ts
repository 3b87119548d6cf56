/**
 * The stage and the page by keyboard.
 *
 * On the stage, all views but 3-D: arrows move a crosshair that reads the pixel under it, + and −, 0 and 1 zoom
 * (`zoom.ts`). With curves: arrows move the selected curve (Shift: ten pixels), + and − resize it, Delete removes
 * it, N and P select the next and the last, C adds a circle at the centre. With a drawing tool Enter sets a centre or corner, Enter on the first corner closes, Escape
 * gives up. Everywhere: Ctrl Z and Ctrl Shift Z undo and redo.
 */

import { moved, remove, replace, resized, select } from "../curves";
import { byId } from "../dom";
import { redo, undo } from "../memory/history";
import { store } from "../store";
import type { Point } from "../worker/protocol";
import { holding } from "./grip";
import {
  addAtCentre,
  currentCrosshair,
  currentSketch,
  finish,
  setCrosshair,
  setSketch,
} from "./tools";
import { bringIn, zoomKey } from "./zoom";

const ARROWS: Record<string, Point> = {
  ArrowLeft: [-1, 0],
  ArrowRight: [1, 0],
  ArrowUp: [0, -1],
  ArrowDown: [0, 1],
};

/** The largest change of size one key press makes. */
const GROW = 1.08;

export function mountKeys(): void {
  byId("overlay").addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    // A curve in the pointer's hand is not the keyboard's.
    if (holding()) return;
    const { view, tool } = store.state;
    const edits = view === "curves";
    const used = edits && (tool === "select" ? editing(event) : drawing(event));
    if (used || pointing(event) || zoomKey(event.key)) event.preventDefault();
  });
  byId("overlay").addEventListener("blur", () => setCrosshair(null));
  document.addEventListener("keydown", (event) => {
    if (!(event.ctrlKey || event.metaKey) || event.altKey) return;
    if (typing(event.target) || holding()) return;
    const key = event.key.toLowerCase();
    if (key === "z" && !event.shiftKey) undo();
    else if ((key === "z" && event.shiftKey) || key === "y") redo();
    else return;
    event.preventDefault();
  });
}

function editing(event: KeyboardEvent): boolean {
  const { shapes, selected } = store.state;
  const shape = selected === null ? undefined : shapes[selected];
  const arrow = ARROWS[event.key];
  if (arrow) {
    if (!shape) return false;
    const far = event.shiftKey ? 10 : 1;
    replace(selected!, moved(shape, arrow[0] * far, arrow[1] * far));
    return true;
  }
  switch (event.key) {
    case "+":
    case "=":
      if (shape) replace(selected!, resized(shape, GROW));
      return shape !== undefined;
    case "-":
    case "_":
      if (shape) replace(selected!, resized(shape, 1 / GROW));
      return shape !== undefined;
    case "Delete":
    case "Backspace":
      if (selected !== null) remove(selected);
      return true;
    case "Escape":
      if (selected === null) return false;
      select(null);
      return true;
    case "n":
    case "N":
      if (shapes.length > 0) select(((selected ?? -1) + 1) % shapes.length);
      return true;
    case "p":
    case "P":
      if (shapes.length > 0) select(((selected ?? 0) - 1 + shapes.length) % shapes.length);
      return true;
    case "c":
    case "C":
      addAtCentre();
      return true;
    default:
      return false;
  }
}

/** The crosshair reads what is under it. */
function pointing(event: KeyboardEvent): boolean {
  if (event.key === "Escape") {
    const there = currentCrosshair() !== null;
    setCrosshair(null);
    return there;
  }
  const next = stepped(event);
  if (next) setCrosshair(next.map(Math.round) as Point);
  return next !== null;
}

/** Where an arrow key takes the crosshair, which begins in the middle. */
function stepped({ key, shiftKey }: KeyboardEvent): Point | null {
  const { width, height } = store.state;
  const here: Point = currentCrosshair() ?? [(width - 1) / 2, (height - 1) / 2];
  const arrow = ARROWS[key];
  if (!arrow) return null;
  const far = shiftKey ? 10 : 1;
  const within = (value: number, size: number) => Math.min(size - 1, Math.max(0, value));
  const next: Point = [
    within(here[0] + arrow[0] * far, width),
    within(here[1] + arrow[1] * far, height),
  ];
  bringIn(next);
  return next;
}

function drawing(event: KeyboardEvent): boolean {
  const { width, height, tool } = store.state;
  const here: Point = currentCrosshair() ?? [(width - 1) / 2, (height - 1) / 2];
  const sketch = currentSketch();
  const next = stepped(event);
  if (next) {
    setCrosshair(next);
    if (sketch) setSketch({ ...sketch, tip: next });
    return true;
  }
  if (event.key === "Escape") {
    if (sketch) setSketch(null);
    else store.update({ tool: "select" });
    setCrosshair(null);
    return true;
  }
  if (event.key !== "Enter" && event.key !== " ") return false;
  if (sketch?.tool === "polygon" && !currentCrosshair()) {
    // Its corners were set by pointer, so that there is no place to set another.
    if (sketch.points.length >= 3) finish();
    return true;
  }
  if (tool === "circle") {
    if (sketch) finish();
    else setSketch({ tool, points: [here], tip: here });
  } else {
    const corners = sketch?.points ?? [];
    const [first] = corners;
    const closing = first && Math.hypot(first[0] - here[0], first[1] - here[1]) < 3;
    const twice = corners.at(-1)?.every((value, i) => value === here[i]);
    if (corners.length >= 3 && (closing || twice)) finish();
    else setSketch({ tool: "polygon", points: [...corners, here], tip: here });
  }
  if (!currentSketch()) setCrosshair(null);
  else setCrosshair(here);
  return true;
}

/** Fields have an undo of their own. */
function typing(target: EventTarget | null): boolean {
  return (
    target instanceof HTMLTextAreaElement ||
    (target instanceof HTMLInputElement && ["text", "number", "search"].includes(target.type))
  );
}
