/** The stage as a picture to take away: all that is on it, from the frame's first pixel to its last. */

import { byId, make } from "../dom";
import { store } from "../store";
import { captionsOf } from "../views";
import { CAPTION_HEIGHT, presentPanes } from "./place";

/** How pictures are taken of views that draw themselves; `null` where at present the stage draws. */
const takes = new Map<string, () => Promise<Blob | null> | null>();

/** A view that draws itself leaves here how to take its picture. */
export function takePicture(view: string, take: () => Promise<Blob | null> | null): void {
  takes.set(view, take);
}

/** The present view as a PNG, at the resolution of the screen. */
export async function stagePicture(): Promise<Blob | null> {
  return takes.get(store.state.view)?.() ?? canvasPicture();
}

async function canvasPicture(): Promise<Blob | null> {
  const { state } = store;
  const layout = presentPanes();
  if (layout.length === 0) return null;
  const captions = captionsOf(state);
  const above = captions.length > 0 ? CAPTION_HEIGHT : 0;
  const { clientWidth, clientHeight } = byId("stage");
  // As far as it is seen, where the picture is magnified.
  const left = Math.max(0, Math.min(...layout.map((pane) => pane.left)));
  const top = Math.max(0, Math.min(...layout.map((pane) => pane.top)) - above);
  const right = Math.min(
    clientWidth,
    Math.max(...layout.map((pane) => pane.left + state.width * pane.scale)),
  );
  const bottom = Math.min(
    clientHeight,
    Math.max(...layout.map((pane) => pane.top + state.height * pane.scale)),
  );

  const layers = ["picture", "overlay"].map((id) => byId<HTMLCanvasElement>(id));
  const dense = layers[0]!.width / layers[0]!.clientWidth;
  const width = Math.round((right - left) * dense);
  const height = Math.round((bottom - top) * dense);
  const copy = make("canvas", { width, height });
  const context = copy.getContext("2d")!;
  const { backgroundColor, color } = getComputedStyle(byId("stage"));
  context.fillStyle = backgroundColor;
  context.fillRect(0, 0, width, height);
  for (const layer of layers) {
    // The other views have nothing on it but a crosshair.
    if (layer.id === "picture" || state.view === "curves")
      context.drawImage(layer, -left * dense, -top * dense);
  }

  context.setTransform(dense, 0, 0, dense, -left * dense, -top * dense);
  context.fillStyle = color;
  context.font = getComputedStyle(byId("captions")).font;
  context.textBaseline = "middle";
  for (const [i, text] of captions.entries()) {
    const pane = layout[i]!;
    const { left, top, width } = pane.cell;
    context.fillText(text, left, top - CAPTION_HEIGHT / 2, width);
  }
  return new Promise((done) => copy.toBlob(done));
}
