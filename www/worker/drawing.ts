/**
 * Pictures and their legends: of what was found, of the truth, of the baseline, and of how far one is from another.
 *
 * A kind `error-…` is a map of errors against the truth.
 */

import type { Kept, Picture, Solver } from "./core";
import { baselineOf, type Owned } from "./owned";
import { text } from "../text/worker";
import type { Legend, PictureRequest } from "./protocol";

/** Frames with more pixels are drawn smaller. */
const MOST_PIXELS = 4e6;
/** A first picture has no more, so that it is there in a blink; less where both eyes or a relief are made of it. */
const QUICK_PIXELS = 1.2e6;
const QUICK_SURFACE = 6e5;
const SURFACES = ["anaglyph", "stereo"];
/** A picture may be by an eighth smaller than the screen, or less. */
const SMALLER = 0.25;
const ERROR = "error-";

type Found = Solver | Kept;

/** How large something is drawn, as the core's `pixels`. */
export interface Size {
  pixels: number;
  /** Whether a screen could show more. */
  blunt: boolean;
}

/**
 * The size of a picture of frames with those sides: as large as a screen can use that shows it `longest` pixels long, or as
 * one that must be quick may be.
 */
export function sizeOf(
  { width, height }: { width: number; height: number },
  kind: string,
  longest: number,
  quick: boolean,
): Size {
  // By a whole number, as the core shrinks them, and hardly smaller than the screen.
  const factor = Math.max(1, Math.floor(Math.max(width, height) / longest + SMALLER));
  const pixels = Math.min(MOST_PIXELS, Math.ceil((width * height) / factor ** 2));
  const least = SURFACES.includes(kind) ? QUICK_SURFACE : QUICK_PIXELS;
  const blunt = quick && !kind.startsWith(ERROR) && Math.min(pixels, width * height) > least;
  return { pixels: blunt ? least : pixels, blunt };
}

/** The relief's size: its vertices are fewer still. */
export const MESH_PIXELS = QUICK_SURFACE;
/** The same to be taken away. */
export const FILE_PIXELS = MOST_PIXELS;

/** At the frame's size where `pixels` is null. */
export function drawn(
  owned: Owned,
  found: Found,
  request: PictureRequest,
  pixels: number | null,
): Picture {
  const { of, kind, compared } = request;
  const { truth } = owned;
  if (kind.startsWith(ERROR)) {
    const params = JSON.stringify(request.params);
    return measured(owned, found, of).viewErrors(kind.slice(ERROR.length), params, known(owned));
  }
  const params = colours(owned, request, { ...request.params, pixels });
  if (of === "found" && compared && truth) return found.viewAligned(kind, params, truth);
  return of === "truth"
    ? known(owned).view(kind, params)
    : measured(owned, found, of).view(kind, params);
}

/** What the colours of such a picture stand for. */
export function legendOf(
  owned: Owned,
  found: Found,
  request: PictureRequest,
  pixels: number,
): Legend | null {
  const { of, kind } = request;
  if (kind.startsWith(ERROR)) {
    const params = JSON.stringify(request.params);
    const drawer = measured(owned, found, of);
    return JSON.parse(drawer.errorLegend(kind.slice(ERROR.length), params, known(owned)));
  }
  const params = colours(owned, request, { ...request.params, pixels });
  const drawer = of === "truth" ? known(owned) : measured(owned, found, of);
  return JSON.parse(drawer.legend(kind, params)) as Legend | null;
}

/** Parameters as JSON, with the truth's colours where they are to be compared. */
function colours({ truth }: Owned, { compared }: PictureRequest, params: object): string {
  const given = JSON.stringify(params);
  return compared && truth ? truth.sameColours(given) : given;
}

const measured = (owned: Owned, found: Found, of: PictureRequest["of"]) =>
  of === "horn-schunck" ? baselineOf(owned) : found;

function known({ truth }: Owned) {
  if (!truth) throw new Error(text.noTruth);
  return truth;
}
