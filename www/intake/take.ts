/**
 * What becomes of files that were chosen, dropped or pasted: those of a truth wait until the frames are open; of the rest, a clip, an animation or three and more pictures go to the
 * filmstrip, a file with two views is a pair, and one or two pictures go to the places of the two frames.
 */

import { ask, overtaken } from "../session";
import { store, type Slot } from "../store";
import { text } from "../text";
import { admit, bytesOf } from "./admit";
import { openAnimation } from "./animation";
import type { Film } from "./film";
import { formatOf, headOf } from "./formats";
import { photos } from "./photos";
import { chooseFrom, keep } from "./reel";
import { openBoth, put, slotOf, takePair } from "./slots";
import { attach, partTruth } from "./truth";

/** What was on the stage, or about to be, when files were chosen. */
type Before = Parameters<typeof overtaken>[0];

let taking: Promise<void> = Promise.resolve();

/** One picture goes to `side` or the first empty place, two to both by name. One lot after another. */
export function takeAll(files: File[], side: 0 | 1 | null): Promise<void> {
  const { source, opening } = store.state;
  taking = taking.then(() => takeLot(files, side, { source, opening }));
  return taking;
}

async function takeLot(files: File[], side: 0 | 1 | null, then: Before): Promise<void> {
  const parted = await partTruth(files);
  if (!parted) return;
  const { truth, rest } = parted;
  const before = store.state.source;
  if (rest.length > 0) await takeFrames(rest, side, then);
  // With frames, it is the truth of those, and not of a pair that stayed.
  if (truth.length === 0 || (rest.length > 0 && store.state.source === before)) return;
  await attach(truth);
}

async function takeFrames(files: File[], side: 0 | 1 | null, then: Before): Promise<void> {
  const sorted = files.toSorted((a, b) => a.name.localeCompare(b.name, "en", { numeric: true }));
  if (sorted.length === 0) return;
  const film = await filmOf(sorted);
  // What it is could not be told, and the message bar says so.
  if (film === undefined) return;
  if (film) {
    keep(film);
    if (!overtaken(then)) await chooseFrom(film);
  } else {
    await takeStills(sorted, side, then);
  }
}

/** The film that the files make; `null` when they are one or two still pictures. */
async function filmOf(files: File[]): Promise<Film | null | undefined> {
  const { reading, readingAll, unnamed } = text.files;
  const phrase = files.length === 1 ? reading(files[0]!.name || unnamed) : readingAll;
  const answer = await ask(phrase, async () => {
    const films: Film[] = [];
    for (const file of files) {
      const film = await momentsOf(file);
      if (film) films.push(film);
    }
    if (files.length === 1 || films.length === 0) return [films[0] ?? null];
    const { name } = films[0]!;
    films.forEach((film) => film.close());
    throw new Error(text.files.alone(name));
  });
  if (!answer) return undefined;
  if (answer[0] || files.length < 3) return answer[0]!;
  return photos(files);
}

/** A file as a film, where it holds several moments. */
async function momentsOf(file: File): Promise<Film | null> {
  const head = await headOf(file).catch(() => bytesOf(file));
  const format = formatOf(head);
  switch (format?.reader) {
    case "animation":
      return openAnimation(file, format);
    case "video": {
      const { openVideo } = await import("./video");
      return openVideo(file, format.name);
    }
    default:
      return null;
  }
}

async function takeStills(files: File[], side: 0 | 1 | null, then: Before): Promise<void> {
  const [only] = files;
  if (files.length === 1 && only && (await takeViews(only, then))) return;
  const { slots } = store.state;
  const full = slots[0] !== null && slots[1] !== null;
  // With both places taken and none named, another pair begins.
  if (files.length === 1 && side === null && full) store.update({ slots: [null, null] });
  const at = files.length === 2 ? 0 : (side ?? (store.state.slots[0] ? 1 : 0));
  // All are read before any takes its place: beside one that is no image, its partner would be
  // paired with an older frame.
  const taken: Slot[] = [];
  for (const [i, file] of files.entries()) {
    const unnamed = text.files.unnamedFrames[at + i === 0 ? 0 : 1];
    const phrase = text.files.reading(file.name || unnamed);
    const slot = await slotOf(() => admit(file, unnamed), phrase);
    if (!slot) return;
    taken.push(slot);
  }
  put(taken, at);
  // A sequence chosen while files were read is what is wanted.
  if (!overtaken(then)) await openBoth();
}

/** Opens a file with two views as a pair; whether it was one. */
async function takeViews(file: File, then: Before): Promise<boolean> {
  const head = await headOf(file).catch(() => null);
  if (!head || formatOf(head)?.name !== "JPEG") return false;
  const bytes = await bytesOf(file);
  const [first, second] = (await ask(null, (service) => service.views(bytes))) ?? [];
  if (!first || !second || overtaken(then)) return false;
  const { view, twoViews } = text.files;
  const pair = [first, second].map((bytes, i) => ({
    name: view(file.name, i === 0 ? 0 : 1),
    bytes,
  }));
  await takePair([pair[0]!, pair[1]!], twoViews(file.name));
  return true;
}
