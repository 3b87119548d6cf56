/** Two frames of the core, where they come from, and the solver that is built on them. */

import {
  hornSchunck,
  Scene,
  Solver,
  Truth,
  type Baseline,
  type Frame,
  type LensEntry,
} from "./core";
import { takeDecoded } from "./decoded";
import { bitmap } from "./pictures";
import { text } from "../text/worker";
import type { FrameFile, KnownParts, ScoreTable, Setup, Source } from "./protocol";

export interface Owned {
  first: Frame;
  second: Frame;
  scene: Scene | null;
  /** The scene's, or that of files. */
  truth: Truth | null;
  /** Made when first asked for. */
  baseline: Baseline | null;
}

export async function take(source: Source): Promise<Owned> {
  if (source.kind === "scene") {
    const scene = new Scene(source.name, source.width, source.height);
    const truth = Truth.ofScene(scene);
    return { first: scene.first(), second: scene.second(), scene, truth, baseline: null };
  }
  const first = await takeDecoded(source.first);
  try {
    const second = await takeDecoded(source.second);
    const owned = { first, second, scene: null, truth: null, baseline: null };
    if (source.truth) setTruth(owned, source.truth);
    return owned;
  } catch (error) {
    first.free();
    throw error;
  }
}

/** What the photos say of their lens. */
function lensOf({ first, second }: Owned): LensEntry | null {
  return JSON.parse(first.lens()) ?? JSON.parse(second.lens());
}

export const interlacedOf = ({ first, second }: Owned): [boolean, boolean] => [
  first.interlaced,
  second.interlaced,
];

export function focalFrom(owned: Owned): string {
  if (owned.scene) return text.focalOfSequence;
  const lens = lensOf(owned);
  return lens ? text.focalOfLens(lens.text) : text.focalGuessed;
}

/** The frames as they are solved and shown: stretched alike where they use few levels. */
export async function framesOf(solver: Solver): Promise<[ImageBitmap, ImageBitmap]> {
  const frames = [solver.first(), solver.second()] as const;
  try {
    return [await bitmap(frames[0]), await bitmap(frames[1])];
  } finally {
    frames.forEach((frame) => frame.free());
  }
}

/** A sequence brings camera and curves; other frames get f from their EXIF data or else their width, and no curve. */
export function ownSetup(owned: Owned): Setup {
  const { first, scene } = owned;
  return {
    camera: scene
      ? JSON.parse(scene.cameraJson)
      : {
          focal: lensOf(owned)?.focal ?? first.width,
          cx: (first.width - 1) / 2,
          cy: (first.height - 1) / 2,
        },
    shapes: scene ? JSON.parse(scene.shapesJson) : [],
    options: {},
  };
}

export function build({ first, second }: Owned, { camera, shapes, options }: Setup): Solver {
  return new Solver(
    first,
    second,
    JSON.stringify(camera),
    JSON.stringify(shapes),
    JSON.stringify(options),
  );
}

/** Takes what is true of the frames from files; what is no truth of theirs changes nothing. */
export function setTruth(owned: Owned, files: FrameFile[]): void {
  const truth = new Truth(owned.first, owned.second, files);
  owned.truth?.free();
  owned.truth = truth;
}

export const known = ({ truth }: Owned): KnownParts | null =>
  truth && (JSON.parse(truth.known()) as KnownParts);

export function baselineOf(owned: Owned): Baseline {
  owned.baseline ??= hornSchunck(owned.first, owned.second);
  return owned.baseline;
}

/** `null` when there is no truth to compare with. */
export function scoresOf(
  owned: Owned,
  found: { scores(truth: Truth, baseline: Baseline): string },
): ScoreTable | null {
  const { truth } = owned;
  return truth && (JSON.parse(found.scores(truth, baselineOf(owned))) as ScoreTable | null);
}

export function free({ first, second, scene, truth, baseline }: Owned): void {
  first.free();
  second.free();
  scene?.free();
  truth?.free();
  baseline?.free();
}
