/** Shots of a camera as a film. */

import { clock, fitted, pngOf, type Film } from "./film";

export interface Shot {
  picture: ImageBitmap;
  /** Seconds, from any moment. */
  at: number;
}

export function shotsFilm(shots: Shot[]): Film {
  const label = (index: number) =>
    index === 0 ? "first shot" : `${clock(shots[index]!.at - shots[0]!.at)} later`;
  const picture = async (index: number, longest: number) => fitted(shots[index]!.picture, longest);
  return {
    name: "the camera's shots",
    count: shots.length,
    label,
    picture,
    file: async (index) => pngOf(`camera, ${label(index)}`, await picture(index, Infinity)),
    close: () => shots.forEach((shot) => shot.picture.close()),
  };
}
