/** Shots of a camera as a film. */

import { later } from "../text/later";
import { clock, fitted, pngOf, type Film } from "./film";

const words = later.camera;

export interface Shot {
  picture: ImageBitmap;
  /** Seconds, from any moment. */
  at: number;
}

export function shotsFilm(shots: Shot[]): Film {
  const label = (index: number) =>
    index === 0 ? words.firstShot : words.laterShot(clock(shots[index]!.at - shots[0]!.at));
  const picture = async (index: number, longest: number) => fitted(shots[index]!.picture, longest);
  return {
    name: words.film,
    count: shots.length,
    label,
    picture,
    file: async (index) => pngOf(words.file(label(index)), await picture(index, Infinity)),
    close: () => shots.forEach((shot) => shot.picture.close()),
  };
}
