/** The core, loaded once, with what it offers read from its own lists. */

import init, { loadDecoders } from "../../cli/web.js";
import {
  Frame,
  limits,
  needsDecoders,
  optionCatalogue,
  presetCatalogue,
  sceneCatalogue,
  viewCatalogue,
  type ViewCatalogue,
} from "../../pkg/relievo.js";
import type { Catalogues, FrameFile } from "./protocol";

export {
  displacement,
  fileKind,
  findCurves,
  findFocal,
  Frame,
  hornSchunck,
  Kept,
  panicMessage,
  Scene,
  Solver,
  Truth,
  type Baseline,
  type LensEntry,
  type Picture,
} from "../../pkg/relievo.js";

export async function load(): Promise<void> {
  await init();
}

let decoders: Promise<void> | null = null;

/** What opens files that are no PNG comes with the first of them. */
async function loaded(): Promise<void> {
  decoders ??= loadDecoders();
  try {
    await decoders;
  } catch (error) {
    // The network may come back.
    decoders = null;
    throw error;
  }
}

export async function decode({ name, bytes }: FrameFile): Promise<Frame> {
  if (needsDecoders(bytes)) await loaded();
  return Frame.decode(bytes, name);
}

/** The views that a JPEG or MPO file holds, each as a file of its own; a photo is the only one. */
export async function viewsOf(bytes: Uint8Array): Promise<Uint8Array<ArrayBuffer>[]> {
  await loaded();
  const { viewsOf } = await import("../../pkg/relievo_decoders.js");
  const ends = viewsOf(bytes);
  return Array.from({ length: ends.length / 2 }, (_, i) =>
    bytes.slice(ends[2 * i], ends[2 * i + 1]),
  );
}

export function catalogues(): Catalogues {
  const { views, palettes, glasses, methods, layouts, colours } = JSON.parse(
    viewCatalogue(),
  ) as ViewCatalogue;
  return {
    options: JSON.parse(optionCatalogue()),
    presets: JSON.parse(presetCatalogue()),
    scenes: JSON.parse(sceneCatalogue()),
    limits: JSON.parse(limits()),
    views,
    palettes,
    glasses,
    methods,
    layouts,
    colours,
  };
}
