/** The film at hand: choosing a pair of its frames, and going on to the next pair from what was found. */

import { announce } from "../dom";
import { ask, follow, run } from "../session";
import { store, type State } from "../store";
import { text } from "../text";
import type { FrameFile } from "../worker/protocol";
import type { Film } from "./film";
import { slotOf, takePair } from "./slots";

/** Keeps a film in place of the one before. */
export function keep(film: Film): void {
  const { reel } = store.state;
  if (reel && reel.film !== film) reel.film.close();
  store.update({ reel: { film, pair: null } });
}

/** Asks for two frames of a film, and opens them. */
export async function chooseFrom(film: Film): Promise<void> {
  const loaded = await ask(text.frames.openingStrip, () => import("./filmstrip"));
  if (!loaded) return;
  const { reel } = store.state;
  const at = reel?.film === film ? reel.pair?.at : undefined;
  loaded.openFilmstrip(film, at ?? null, (pair) => takeFrames(film, pair));
}

/** Opens frames `at` of a film; whether they are any good. */
async function takeFrames(film: Film, at: [number, number]): Promise<boolean> {
  const files: [FrameFile, FrameFile] = [await film.file(at[0]), await film.file(at[1])];
  if (!(await takePair(files, noteOn(film, at)))) return false;
  store.update({ reel: { film, pair: { at, files } } });
  return true;
}

function noteOn(film: Film, [i, j]: [number, number]): string {
  return text.files.fromFilm(film.name, film.label(i), film.label(j));
}

/** The frame after the pair on the stage, as far from its second as that from its first; `null` where there is none. */
export function nextFrame({ reel, source }: Readonly<State>): number | null {
  if (!reel?.pair || source?.kind !== "files") return null;
  const { at, files } = reel.pair;
  const shown = source.first.bytes === files[0].bytes && source.second.bytes === files[1].bytes;
  const next = 2 * at[1] - at[0];
  return shown && next >= 0 && next < reel.film.count ? next : null;
}

/** Goes on to the next pair, from what was found in this one, and runs. */
export async function nextPair(): Promise<void> {
  const { reel } = store.state;
  const next = nextFrame(store.state);
  if (!reel?.pair || next === null) return;
  const { film, pair } = reel;
  const [, second] = pair.files;
  const at: [number, number] = [pair.at[1], next];
  const slot = await slotOf(() => film.file(next), text.files.reading(film.label(next)));
  if (!slot) return;
  const { name, bytes } = slot;
  const file = { name, bytes };
  if (!(await follow(file, noteOn(film, at)))) return;
  store.update({
    reel: { film, pair: { at, files: [second, file] } },
    slots: [store.state.slots[1], slot],
  });
  announce(text.files.areOpen(film.label(at[0]), film.label(at[1])));
  await run();
}
