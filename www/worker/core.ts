/** The core, loaded once, with what it offers read from its own lists. */

import init from "../../cli/web.js";
import {
  limits,
  optionCatalogue,
  presetCatalogue,
  sceneCatalogue,
  viewCatalogue,
  type ViewCatalogue,
} from "../../pkg/relievo.js";
import type { Catalogues } from "./protocol";

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
