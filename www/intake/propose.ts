/**
 * A second frame for a first: so far on that things have moved far enough to see, and not too far to follow.
 *
 * The distance is doubled until motion fits or is too large, and halved in between from there on.
 */

import type { Displacement } from "../worker/protocol";

/** The frame that goes with `first` among `count`; where none fits, the one that shows most motion before it is lost. */
export async function propose(
  first: number,
  count: number,
  measured: (second: number) => Promise<Displacement | null>,
): Promise<number> {
  const way = first < count - 1 ? 1 : -1;
  const farthest = way > 0 ? count - 1 - first : first;
  const at = (distance: number) => first + way * distance;
  let small = { distance: 1, share: 0 };
  let large = farthest + 1;
  for (let distance = 1; distance < large;) {
    const motion = await measured(at(distance));
    if (motion?.verdict === "fit") return at(distance);
    if (motion?.verdict === "small") {
      if (motion.share >= small.share) small = { distance, share: motion.share };
      if (distance === farthest) break;
      distance = large > farthest ? Math.min(2 * distance, farthest) : between(distance, large);
    } else {
      large = distance;
      distance = between(small.distance, large);
      if (distance === small.distance) break;
    }
  }
  return at(small.distance);
}

const between = (small: number, large: number) => {
  const middle = Math.floor((small + large) / 2);
  return middle === small ? large : middle;
};
