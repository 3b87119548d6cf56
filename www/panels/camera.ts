/** Focal length in pixels, the field of view it means, and, for those who know it, the principal point. */

import { announce, byId, make } from "../dom";
import { fixed } from "../format";
import { change } from "../memory/history";
import { ask } from "../session";
import { store } from "../store";
import { text } from "../text";
import { focalFindingOf } from "../wording";

const words = text.camera;

/** 2 arctan(w / 2f), in degrees. */
const fieldOfView = (width: number, focal: number) =>
  (2 * Math.atan(width / (2 * focal)) * 180) / Math.PI;
const focalOf = (width: number, degrees: number) =>
  width / (2 * Math.tan((degrees * Math.PI) / 360));

export function mountCamera(): void {
  const focal = numberField("focal", words.focal, "any");
  const view = numberField("fov", words.view, "0.1");
  const slider = make("input", { type: "range", id: "fov-slider", min: 5, max: 120, step: 0.5 });
  slider.setAttribute("aria-label", words.viewSlider);
  const cx = numberField("cx", words.column, "any");
  const cy = numberField("cy", words.row, "any");
  const advanced = make(
    "details",
    {},
    make("summary", {}, words.principal),
    make("div", { class: "pairing" }, cx.field, cy.field),
    make("p", { class: "note" }, words.principalMeaning),
  );
  const note = make("p", { class: "note" });
  byId("camera").append(
    make("div", { class: "pairing" }, focal.field, view.field),
    slider,
    note,
    advanced,
  );

  const set = (camera: Partial<typeof store.state.camera>) => {
    const { focalFinding } = store.state;
    change({
      camera: { ...store.state.camera, ...camera },
      focalFinding: camera.focal === undefined ? focalFinding : words.byHand,
    });
  };
  focal.input.addEventListener("change", () => set({ focal: asNumber(focal.input) ?? 0 }));
  const byAngle = (input: HTMLInputElement) => () => {
    const degrees = asNumber(input);
    if (degrees !== undefined && degrees > 0 && degrees < 180) {
      set({ focal: focalOf(store.state.width, degrees) });
    } else {
      store.update({ message: words.notDegrees });
    }
  };
  view.input.addEventListener("change", byAngle(view.input));
  slider.addEventListener("change", byAngle(slider));
  slider.addEventListener("input", () => {
    const f = focalOf(store.state.width, Number(slider.value));
    focal.input.value = f.toFixed(1);
    view.input.value = Number(slider.value).toFixed(1);
  });
  byId("find-focal").addEventListener("click", () => void findFocal());
  cx.input.addEventListener("change", () => set({ cx: asNumber(cx.input) }));
  cy.input.addEventListener("change", () => set({ cy: asNumber(cy.input) }));

  store.watch(
    ({ camera, width, height }) => [camera, width, height],
    ({ camera, width, height }) => {
      if (width === 0) return;
      const degrees = fieldOfView(width, camera.focal);
      focal.input.value = plain(camera.focal);
      view.input.value = fixed(degrees, 1);
      slider.value = String(degrees);
      slider.setAttribute("aria-valuetext", words.degrees(fixed(degrees, 1)));
      cx.input.value = plain(camera.cx ?? (width - 1) / 2);
      cy.input.value = plain(camera.cy ?? (height - 1) / 2);
    },
  );
  store.watch(
    ({ focalFinding, focalFrom }) => [focalFinding, focalFrom],
    ({ focalFinding, focalFrom }) => {
      note.textContent = focalFinding ?? `${focalFrom} ${words.bends}`.trim();
    },
  );
  store.watch(
    ({ frames, busy, running }) => [frames, busy, running],
    ({ frames, busy, running }) => {
      byId<HTMLButtonElement>("find-focal").disabled = !frames || busy !== null || running;
    },
  );
}

/** Takes the focal length that the frames tell, if they do. */
async function findFocal(): Promise<void> {
  const { camera } = store.state;
  // In an array, since nothing found is an answer, too.
  const answer = await ask(words.finding, async (service) => [await service.findFocal(camera)]);
  // A camera that was set meanwhile is what is wanted.
  if (!answer || store.state.camera !== camera) return;
  const [found = null] = answer;
  const focalFinding = focalFindingOf(found);
  announce(focalFinding);
  if (found) change({ camera: { ...camera, focal: Math.round(found.focal) }, focalFinding });
  else store.update({ focalFinding });
}

/** An empty field is no number: without f the core says what it wants, without centre it takes its own. */
function asNumber(input: HTMLInputElement): number | undefined {
  return input.value.trim() === "" ? undefined : Number(input.value);
}

const plain = (value: number) =>
  Number.isFinite(value) ? String(Math.round(value * 100) / 100) : "";

function numberField(id: string, label: string, step: string) {
  const input = make("input", { type: "number", id, step, inputmode: "decimal" });
  const field = make("label", { class: "stacked", for: id }, make("span", {}, label), input);
  return { input, field };
}
