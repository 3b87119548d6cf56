/**
 * Depth as a surface to turn in one's hands.
 *
 * three.js is fetched the first time the view is opened; nothing is drawn while it is hidden, and only
 * when something has changed. The surface turns about its middle by drag, pinch, or arrow keys; the light is dragged
 * by its handle, or with Shift anywhere. A finger turns it only after a tap, so that the page can be scrolled.
 */

import { announce, byId } from "../dom";
import { onMesh } from "../looking";
import { takePicture } from "../stage/snapshot";
import { store } from "../store";
import type { MeshData } from "../worker/protocol";
import { mountLamp, type Lamp } from "./lamp";
import type { Scenery, Surface } from "./scenery";
import { mountTouch } from "./touch";

let scenery: Scenery | null = null;
let lamp: Lamp | null = null;
let pending: MeshData | null = null;

export function mountRelief(): void {
  onMesh((mesh) => {
    if (scenery) scenery.setMesh(mesh);
    else pending = mesh;
  });
  takePicture("relief", async () => scenery?.picture() ?? null);
  store.watch(
    ({ view }) => [view],
    ({ view }) => {
      if (view === "relief") void open();
    },
  );
  store.watch(({ frames, viewParams }) => [frames, viewParams.material, viewParams.ghosts], dress);
}

let opening: Promise<void> | null = null;

async function open(): Promise<void> {
  opening ??= (async () => {
    const { Scenery } = await import("./scenery");
    const made = new Scenery(byId("relief"), () => lamp?.follow());
    scenery = made;
    lamp = mountLamp(byId("relief"), made);
    mountTouch(byId("relief"), made.canvas);
    dress();
    if (pending) made.setMesh(pending);
    pending = null;
    mountKeys(made);
  })();
  try {
    await opening;
    scenery?.resize();
  } catch (error) {
    opening = null;
    store.update({
      message: `The relief cannot be shown: ${(error as Error).message}. It needs WebGL; the other views do not.`,
      view: "depth",
    });
  }
}

function dress(): void {
  const { frames, viewParams } = store.state;
  if (!scenery || !frames) return;
  scenery.setTexture(frames[0]);
  scenery.setMaterial(viewParams.material as Surface, viewParams.ghosts);
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
      announce("Relief seen from the front.");
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
