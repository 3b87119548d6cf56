/**
 * Pictures and their legends: of what was found, of the truth, of the baseline, and of how far one is from another.
 *
 * A kind `error-…` is a map of errors against the truth.
 */

import type { Kept, Picture, Solver } from "./core";
import { baselineOf, type Owned } from "./owned";
import { ERROR } from "./size";
import { text } from "../text/worker";
import type { Legend, PictureRequest } from "./protocol";

type Found = Solver | Kept;

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
