/**
 * Keeps the open pair on this device as it changes, and opens kept pairs again.
 *
 * What is kept is what is seen: a change is written a moment after it was made, and at once when the page goes away.
 */

import { make } from "../dom";
import { open } from "../session";
import { store, type Slot, type State } from "../store";
import { text } from "../text";
import type { Found, Source } from "../worker/protocol";
import { sizeOf as bytesOf, type Timeline } from "../timeline/line";
import { forgetAll, keep, recall, sessions, type Session } from "./database";
import { presentFound, settingsOf } from "./held";
import { nameOf } from "./names";
import { settingOf } from "./setting";

const PAUSE_MS = 400;
const THUMBNAIL = 160;

let timer: ReturnType<typeof setTimeout> | undefined;
/** What is written already. */
let written: { source: Source; found: Found | null; timeline: Timeline | null } | null = null;
/** Writes one after another. */
let writing: Promise<void> = Promise.resolve();

export function mountRemember(): void {
  store.watch(
    (state) => [
      ...[state.source, state.frames, state.heldFound, state.running || state.timeline],
      ...Object.values(settingOf(state)),
    ],
    () => {
      clearTimeout(timer);
      timer = setTimeout(flush, PAUSE_MS);
    },
  );
  document.addEventListener("visibilitychange", () => document.hidden && void flush());
  addEventListener("pagehide", () => void flush());
  void list();
}

/** Writes what has changed, and waits for it. */
export function flush(): Promise<void> {
  clearTimeout(timer);
  writing = writing.then(() => writeNow(store.state)).catch(cannot);
  return writing;
}

/** Some private windows keep nothing, and a device may be full: the page works all the same. */
function cannot(): void {
  store.update({ memory: null });
}

async function writeNow(state: Readonly<State>): Promise<void> {
  const { source, frames, title, started } = state;
  if (!source || !frames || state.playing) return;
  const fresh = written?.source !== source;
  const before = fresh ? null : written;
  const id = await nameOf(source);
  const found = started ? presentFound(state) : null;
  // While it runs it changes with every pass.
  const timeline = state.running ? (before?.timeline ?? null) : state.timeline;
  const own = source.kind === "files" ? source : null;
  const session: Session = {
    id,
    title: own ? `${own.first.name}, ${own.second.name}` : title,
    used: Date.now(),
    frameBytes: own ? own.first.bytes.length + own.second.bytes.length : 0,
    resultBytes: found?.bytes.length ?? 0,
    timelineBytes: timeline ? bytesOf(timeline) : 0,
    setting: settingOf(state),
    thumbnail: own ? await thumbnail(frames[0]) : null,
  };
  const result = found && found !== before?.found && { settings: settingsOf(state), found };
  const passes = timeline !== before?.timeline && timeline;
  await keep(
    ...([session, fresh ? source : null, found ? result || null : "drop"] as const),
    timeline ? passes || null : "drop",
  );
  written = { source, found, timeline };
  await list();
}

/** Told to whoever lists what is kept. */
async function list(): Promise<void> {
  store.update({ memory: await sessions().catch(() => null) });
}

async function thumbnail(frame: ImageBitmap): Promise<Blob | null> {
  if (frame.width === 0) return null;
  const factor = THUMBNAIL / Math.max(frame.width, frame.height);
  const [width, height] = [frame.width, frame.height].map((side) => Math.ceil(side * factor));
  const canvas = make("canvas", { width, height });
  canvas.getContext("2d")!.drawImage(frame, 0, 0, width!, height!);
  return new Promise((done) => canvas.toBlob(done, "image/webp", 0.8));
}

/** Opens a pair as it was left; `false` when it is not kept, or cannot be opened. */
export async function resume(id: string, view?: string): Promise<boolean> {
  await flush();
  const kept = await recall(id).catch(() => null);
  if (!kept) return false;
  const { source, result, timeline } = kept;
  const setting = { ...kept.session.setting, ...(view ? { view } : {}) };
  const found = result && result.settings === settingsOf(setting) ? result.found : null;
  const done = await open(source, text.waits.kept, setting, found);
  if (done && store.state.source === source) {
    written = { source, found: null, timeline };
    store.update({ timeline });
    await fillSlots(source);
  }
  return done;
}

/** Frames of one's own lie in their slots. */
async function fillSlots(source: Source): Promise<void> {
  const { frames, width, height, interlaced } = store.state;
  if (source.kind !== "files" || !frames) return;
  const slots = [source.first, source.second].map(async (file, i): Promise<Slot> => {
    const picture = await createImageBitmap(frames[i]!, { resizeWidth: 256 });
    return { ...file, width, height, picture, interlaced: interlaced[i]! };
  });
  store.update({ slots: (await Promise.all(slots)) as [Slot, Slot] });
}

/** Forgets every pair; the one that is open stays open, and is kept again once something in it changes. */
export async function empty(): Promise<void> {
  clearTimeout(timer);
  await writing;
  await forgetAll().catch(() => {});
  written = null;
  await list();
}
