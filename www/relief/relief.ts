/**
 * Depth as a surface to turn in one's hands, or two of them, of the timeline's two lines, under one light.
 *
 * three.js is fetched the first time the view is opened; nothing is drawn while it is hidden, and only
 * when something has changed. The surface turns about its middle by drag, pinch, or arrow keys; the light is dragged
 * by its handle, or with Shift anywhere. A finger turns it only after a tap, so that the page can be scrolled. Of two
 * surfaces each turns with the other.
 */

import { announce, byId, make } from "../dom";
import { onMesh } from "../looking";
import { takePicture } from "../stage/snapshot";
import { store } from "../store";
import { text } from "../text";
import { namesOf } from "../timeline/sentences";
import { placeOf } from "../timeline/going";
import type { MeshData } from "../worker/protocol";
import { mountBeside } from "./beside";
import { mountLamp, type Lamp } from "./lamp";
import type { Scenery, Surface } from "./scenery";
import { mountTouch } from "./touch";

/** A surface in its place. */
interface Pane {
  place: HTMLElement;
  name: HTMLElement;
  scenery: Scenery;
}

/** The first is of what is shown, or of the first line; the second of the second line. */
let panes: Pane[] = [];
let lamp: Lamp | null = null;
/** What came last, of the line shown and of the other, whether or not there is a pane for it yet. */
let own: MeshData | null = null;
let other: { mesh: MeshData; line: number } | null = null;

export function mountRelief(): void {
  const beside = mountBeside((mesh, line) => {
    other = { mesh, line };
    showOther();
  });
  onMesh((mesh) => {
    own = mesh;
    showOwn();
    beside(mesh.deepened);
  });
  takePicture("relief", () => picture());
  store.watch(
    ({ view, beside }) => [view, beside],
    ({ view }) => {
      if (view === "relief") void open();
    },
  );
  store.watch(({ frames, viewParams }) => [frames, viewParams.material, viewParams.ghosts], dress);
  store.watch(({ beside, timeline }) => [beside, timeline], arrange);
  store.watch(
    ({ beside }) => [beside],
    ({ beside }) => {
      if (!beside) other = null;
      showOwn();
    },
  );
}

function showOwn(): void {
  const { state } = store;
  if (own) panes[state.beside ? placeOf(state).line : 0]?.scenery.setMesh(own);
}

function showOther(): void {
  if (other && store.state.beside) panes[other.line]?.scenery.setMesh(other.mesh);
}

let opening: Promise<void> | null = null;
/** Makes another pane, once three.js is there. */
let add = () => {};

async function open(): Promise<void> {
  opening ??= (async () => {
    const { Scenery } = await import("./scenery");
    const root = byId("relief");
    const pane = (): Pane => {
      const name = make("p", { class: "relief-name" });
      const place = make("div", { class: "relief-pane" }, name);
      root.append(place);
      // It turns to its first place while it is being made.
      let made: Scenery | null = null;
      const turned = () => {
        for (const { scenery } of panes) if (made && scenery !== made) scenery.follow(made);
      };
      const scenery = new Scenery(place, () => lamp?.follow(), turned);
      made = scenery;
      return { place, name, scenery };
    };
    add = () => {
      const made = pane();
      panes.push(made);
      mountKeys(made.scenery);
      if (panes[0] !== made) made.scenery.lamp = panes[0]!.scenery.lamp;
    };
    add();
    lamp = mountLamp(root, {
      has: (target) => panes.some(({ scenery }) => scenery.canvas === target),
      get lamp() {
        return panes[0]!.scenery.lamp;
      },
      set lamp(from) {
        for (const { scenery } of panes) scenery.lamp = from;
      },
    });
    mountTouch(root);
    arrange();
    dress();
    showOwn();
  })();
  try {
    await opening;
    if (store.state.beside && panes.length < 2) {
      add();
      arrange();
      dress();
      showOwn();
      showOther();
      panes[1]!.scenery.follow(panes[0]!.scenery);
    }
    panes.forEach(({ scenery }) => scenery.resize());
  } catch (error) {
    opening = null;
    store.update({
      message: text.relief.broken((error as Error).message),
      view: "depth",
    });
  }
}

/** One pane or both, each with the name of what it shows. */
function arrange(): void {
  const { beside, timeline, catalogues } = store.state;
  const names = beside && timeline ? namesOf(timeline, catalogues?.options ?? []) : [];
  byId("relief").classList.toggle("beside", beside);
  for (const [i, { place, name, scenery }] of panes.entries()) {
    place.hidden = i > 0 && !beside;
    name.textContent = names[i] ?? "";
    scenery.resize();
  }
}

function dress(): void {
  const { frames, viewParams } = store.state;
  if (!frames) return;
  for (const { scenery } of panes) {
    scenery.setTexture(frames[0]);
    scenery.setMaterial(viewParams.material as Surface, viewParams.ghosts);
  }
}

/** The surface, or both side by side. */
async function picture(): Promise<Blob | null> {
  const [first, second] = panes;
  if (!first) return null;
  if (!second || second.place.hidden) return first.scenery.picture();
  const canvases = [first, second].map(({ scenery }) => scenery.drawnCanvas());
  const wide = canvases[0]!.width;
  const both = make("canvas", { width: 2 * wide, height: canvases[0]!.height });
  const context = both.getContext("2d")!;
  canvases.forEach((canvas, i) => context.drawImage(canvas, i * wide, 0));
  return new Promise((done) => both.toBlob(done, "image/png"));
}

const TURN = Math.PI / 36;

function mountKeys(scenery: Scenery): void {
  const actions: Record<string, () => void> = {
    ArrowLeft: () => scenery.turn(-TURN, 0),
    ArrowRight: () => scenery.turn(TURN, 0),
    ArrowUp: () => scenery.turn(0, -TURN),
    ArrowDown: () => scenery.turn(0, TURN),
    "+": () => scenery.approach(1 / 1.1),
    "=": () => scenery.approach(1 / 1.1),
    "-": () => scenery.approach(1.1),
    Home: () => {
      scenery.home();
      announce(text.relief.front);
    },
  };
  scenery.canvas.addEventListener("keydown", (event) => {
    if (event.shiftKey && lamp?.key(event.key)) return event.preventDefault();
    const action = event.ctrlKey || event.metaKey ? undefined : actions[event.key];
    if (!action) return;
    event.preventDefault();
    action();
  });
}
