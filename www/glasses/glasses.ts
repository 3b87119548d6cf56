/**
 * Both eyes' pictures: side by side as the core lays them out, in turn, on the full screen; and by what the anaglyph is
 * mixed.
 *
 * A pair is wider than the frame, and its halves in turn are a motion: so they are drawn here and not on the stage.
 */

import { byId, make } from "../dom";
import { takePicture } from "../stage/snapshot";
import { SharpCanvas } from "../stage/canvas";
import { store, type State } from "../store";
import { text } from "../text";

/** Each eye's picture is shown for so long: six in a second. */
const TURN_MS = 166;

/** Between pictures that are to be fused, in CSS pixels. */
const GAP = 8;

let second = false;
let turning: ReturnType<typeof setInterval> | undefined;

export function mountGlasses(): void {
  const stage = byId("stage");
  const element = make("canvas", { class: "layer eyes", role: "img", hidden: true });
  byId("picture").after(element);
  const canvas = new SharpCanvas(element, paint);
  const method = make("p", { class: "method" });
  const pause = make("button", { type: "button", class: "tool wiggle" });
  const whole = make("button", { type: "button", class: "tool" }, text.glasses.full);
  const bar = make("div", { class: "glasses-bar", hidden: true }, method, pause, whole);
  stage.append(bar);

  pause.addEventListener("click", () => turn(turning === undefined));
  whole.addEventListener("click", () => {
    if (document.fullscreenElement) void document.exitFullscreen();
    else void stage.requestFullscreen().catch(() => {});
  });
  whole.hidden = !document.fullscreenEnabled;
  document.addEventListener("fullscreenchange", () => {
    whole.textContent = document.fullscreenElement ? text.glasses.leaveFull : text.glasses.full;
  });

  const turn = (on: boolean) => {
    clearInterval(turning);
    turning = undefined;
    if (on) {
      turning = setInterval(() => {
        second = !second;
        canvas.invalidate();
      }, TURN_MS);
    }
    pause.textContent = on ? text.glasses.stop : text.glasses.wiggle;
  };
  const still = matchMedia("(prefers-reduced-motion: reduce)");

  store.watch(
    ({ view, viewParams, split, catalogues, truth }) => [
      view,
      viewParams.presentation,
      split === null,
      catalogues,
      truth,
    ],
    (state) => {
      const { view, viewParams } = state;
      element.hidden = !paired(state);
      element.ariaLabel =
        viewParams.presentation === "wiggle" ? text.glasses.inTurn : text.glasses.besideEachOther;
      // Places and pixels of one picture mean nothing on two.
      for (const id of ["overlay", "zoom"]) byId(id).hidden = paired(state) || view === "relief";
      bar.hidden = view !== "anaglyph" && view !== "relief";
      pause.hidden = !wiggling(state);
      turn(wiggling(state) && !still.matches);
      canvas.invalidate();
    },
  );
  store.watch(
    ({ pictures, view }) => [pictures, view],
    () => canvas.invalidate(),
  );
  store.watch(
    ({ view, viewParams, catalogues }) => [view, viewParams, catalogues],
    (state) => (method.textContent = methodOf(state)),
  );
  takePicture("anaglyph", () =>
    paired(store.state) ? new Promise((done) => element.toBlob(done)) : null,
  );
}

const paired = ({ view, viewParams, split }: Readonly<State>) =>
  view === "anaglyph" && viewParams.presentation !== "anaglyph" && !split;

const wiggling = (state: Readonly<State>) =>
  paired(state) && state.viewParams.presentation === "wiggle";

function methodOf({ view, viewParams, catalogues }: Readonly<State>): string {
  if (view !== "anaglyph" || viewParams.presentation !== "anaglyph") return "";
  const which = catalogues?.glasses.findIndex(({ value }) => value === viewParams.glasses) ?? -1;
  return catalogues?.methods[which] ?? "";
}

function paint(
  context: CanvasRenderingContext2D,
  { width, height }: { width: number; height: number },
): void {
  const { state } = store;
  if (!paired(state)) return;
  const picture = state.pictures[0];
  // One that is not there yet leaves the last one standing.
  if (!picture?.width || !state.pictured.endsWith("stereo")) return;
  context.fillStyle = getComputedStyle(byId("stage")).backgroundColor;
  context.fillRect(0, 0, width, height);
  const wiggle = wiggling(state);
  // Pictures at half their width are for a screen that takes them without a gap.
  const gap = wiggle || state.viewParams.presentation === "half" ? 0 : GAP;
  const margin = Math.min(16, width / 40);
  const half = picture.width / 2;
  const across = wiggle ? half : picture.width;
  const scale = Math.min(
    (width - 2 * margin - gap) / across,
    (height - 2 * margin) / picture.height,
  );
  const [w, h] = [half * scale, picture.height * scale];
  const top = (height - h) / 2;
  const left = (width - across * scale - gap) / 2;
  context.imageSmoothingQuality = "medium";
  const eye = (which: number, x: number) =>
    context.drawImage(picture, which * half, 0, half, picture.height, x, top, w, h);
  if (wiggle) {
    eye(second ? 1 : 0, left);
  } else {
    eye(0, left);
    eye(1, left + w + gap);
  }
}
