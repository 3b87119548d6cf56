/**
 * What is found at the pixel under the pointer, the last tap or the keyboard's crosshair. The core tells it; one question
 * is on its way at a time, the latest next.
 */

import { announce, byId, make } from "../dom";
import { fixed, number } from "../format";
import { askShown } from "../session";
import { store } from "../store";
import { text } from "../text";
import { wantedParams } from "../views";
import type { Point, Probe } from "../worker/protocol";
import { currentCrosshair, currentSketch, sketchChanged } from "./tools";
import { pixelAt, placeOf } from "./zoom";
import { holding } from "./grip";

const words = text.readout;

let pixel: Point | null = null;
let byKey = false;

export function mountReadout(): void {
  const overlay = byId("overlay");
  overlay.addEventListener("pointermove", (event) => {
    if (event.pointerType === "mouse") point(placeOf(event));
  });
  overlay.addEventListener("pointerleave", (event) => {
    if (event.pointerType === "mouse" && !byKey) show(null);
  });
  overlay.addEventListener("click", (event) => point(placeOf(event)));
  sketchChanged(() => {
    const crosshair = currentCrosshair();
    if (crosshair) {
      byKey = true;
      show(crosshair.map(Math.round) as Point);
    } else if (byKey) {
      byKey = false;
      show(null);
    }
  });
  store.watch(
    ({ source, view }) => [source, view],
    () => show(null),
  );
  store.watch(
    ({ revision, report, scales }) => [revision, report?.iterations, scales],
    () => pixel && show(pixel),
  );
}

function point(place: Point): void {
  if (holding() || currentSketch()) return show(null);
  byKey = false;
  show(pixelAt(place));
}

let asking = false;

function show(next: Point | null): void {
  pixel = next;
  byId("readout").hidden = next === null;
  if (!next) return;
  byId("readout").dataset["corner"] = corner(next);
  byId("readout-place").textContent = words.place(next[0], next[1]);
  if (!store.state.started) write(null);
  else if (!asking) void answer();
}

/** The readout stays out of the way of what it reads. */
function corner([x, y]: Point): string {
  const { width, height } = store.state;
  return x < width / 2 && y > height / 2 ? "top" : "bottom";
}

async function answer(): Promise<void> {
  asking = true;
  while (pixel) {
    const [x, y] = pixel;
    const params = wantedParams(store.state);
    const probe = await askShown(null, (service) => service.probe(x, y, params));
    const last = pixel as Point | null;
    if (!last || (last[0] === x && last[1] === y)) {
      if (last) write(probe);
      break;
    }
  }
  asking = false;
}

function write(probe: Probe | null): void {
  const rows = probe ? rowsOf(probe) : [];
  byId("readout-values").replaceChildren(
    ...rows.flatMap(([name, value, title]) => [
      make("dt", { title: title ?? null }, name),
      make("dd", {}, value),
    ]),
  );
  const place = byId("readout-place").textContent ?? "";
  if (byKey) announce([place, ...rows.map(([name, value]) => `${name} ${value}`)].join("; "));
}

function rowsOf(probe: Probe): [string, string, string?][] {
  const { label, depth, u, v, speed, psi, confidence, occluded } = probe;
  const told = (value: number | null, text: (value: number) => string) =>
    value === null ? words.unknown : text(value);
  return [
    [words.region, label === 0 ? words.background : words.curve(label)],
    [words.depth, told(depth, (z) => words.timesMean(number(z))), words.depthTitle],
    [
      words.motion,
      told(speed, (s) => words.pixels(fixed(s, 2), fixed(u, 2), fixed(v, 2))),
      words.motionTitle,
    ],
    ["ψ", told(psi, (value) => fixed(value, 1)), words.residualTitle],
    [words.confidence, number(confidence, 2), words.confidenceTitle],
    ...(occluded ? [[words.hidden, words.inSecond] as [string, string]] : []),
  ];
}
