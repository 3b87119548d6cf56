/**
 * The two places for frames of one's own.
 *
 * A frame waits in its place until its partner is there; only then are both opened together, and until they prove good
 * the stage keeps what it shows.
 */

import { ask, open } from "../session";
import { store, type Slot, type State } from "../store";
import { text } from "../text";
import type { FrameFile } from "../worker/protocol";

/** Longest side of the small picture of a frame, pixels. */
const SMALL = 256;

/** Looks at a file; `null` when it is no good, which the message bar then explains. */
export async function slotOf(read: () => Promise<FrameFile>, phrase: string): Promise<Slot | null> {
  return ask(phrase, async (service) => {
    const file = await read();
    return { ...file, ...(await service.preview(file, SMALL)) };
  });
}

/** Opens what is in both places, with a sentence on what they are where there is one to say. */
export async function openBoth(note?: string): Promise<boolean> {
  const [first, second] = store.state.slots;
  if (!first || !second) return false;
  // Copies, since the worker may be restarted and need them again.
  const file = ({ name, bytes }: Slot) => ({ name, bytes });
  const pair = { kind: "files" as const, first: file(first), second: file(second) };
  return open(note ? { ...pair, note } : pair, text.frames.opening);
}

/** Takes a pair at once. */
export async function takePair(files: [FrameFile, FrameFile], note: string): Promise<boolean> {
  const slots: Slot[] = [];
  for (const file of files) {
    const slot = await slotOf(async () => file, text.files.reading(file.name));
    if (!slot) return false;
    slots.push(slot);
  }
  store.update({ slots: [slots[0]!, slots[1]!] });
  return openBoth(note);
}

/** Opens the two moments that an interlaced frame shows, in place of what is open. */
export async function takeFields(frame: Slot): Promise<void> {
  const { name, bytes } = frame;
  const files = { name, bytes };
  const [even, odd] =
    (await ask(text.files.reading(name), (service) => service.fields(files))) ?? [];
  if (!even || !odd) return;
  const { field, twoFields } = text.files;
  const pair = [even, odd] as const;
  const [first, second] = pair.map((bytes, i) => ({
    name: field(name, i === 0 ? 0 : 1),
    bytes,
  }));
  await takePair([first!, second!], twoFields(name));
}

/** Puts `taken` in from place `at` on; a frame that cannot be its partner any more leaves. */
export function put(taken: Slot[], at: number): void {
  const slots = store.state.slots.toSpliced(at, taken.length, ...taken) as State["slots"];
  const [first, second] = slots;
  const differ =
    first && second && (first.width !== second.width || first.height !== second.height);
  // Of a pair that is replaced one by one, the first must not be paired with what is on its way out.
  if (taken.length === 1 && differ && inUse(store.state)) slots[1 - at] = null;
  store.update({ slots });
}

export async function swap(): Promise<void> {
  const { slots, source } = store.state;
  store.update({ slots: [slots[1], slots[0]] });
  await openBoth(source?.kind === "files" ? source.note : undefined);
}

/** Whether the pair on the stage is the one in the places. */
export function inUse({ source, slots }: Readonly<State>): boolean {
  return (
    source?.kind === "files" &&
    source.first.bytes === slots[0]?.bytes &&
    source.second.bytes === slots[1]?.bytes
  );
}
