/** Curves of one pair, carried on to the next. */

import type { Contour, Shape } from "./protocol";

/** Each curve where its region is now, by the longest outline of that; where a region is lost, the curve stays. */
export function carriedOn(shapes: Shape[], contours: Contour[]): Shape[] {
  return shapes.map((shape, k) => {
    const own = contours.filter(({ label, closed }) => label === k + 1 && closed);
    const longest = own.toSorted((a, b) => b.points.length - a.points.length)[0];
    if (!longest || longest.points.length < 6) return shape;
    const points: [number, number][] = [];
    for (let i = 0; i + 1 < longest.points.length; i += 2) {
      points.push([longest.points[i]!, longest.points[i + 1]!]);
    }
    return { kind: "polygon", points: thinned(points) };
  });
}

/** No more points than a person would care to move. */
function thinned(points: [number, number][]): [number, number][] {
  const every = Math.ceil(points.length / 64);
  const thin = points.filter((_, i) => i % every === 0);
  return thin.length < 3 ? points : thin;
}
