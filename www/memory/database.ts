/**
 * What this device keeps of the pairs worked on: IndexedDB, in four tables so that a moved curve does not write frames
 * anew.
 *
 * `sessions` has settings and views, `frames` the files of one's own pairs, `results` what was found, `timelines` the passes
 * on the way there. Together they take at most `MOST_BYTES`; what was used longest ago goes first.
 */

import { openDB, type DBSchema, type IDBPDatabase } from "idb";

import type { Timeline } from "../timeline/line";
import type { Found, Source } from "../worker/protocol";
import type { Setting } from "./setting";

/** Bytes kept at most. */
export const MOST_BYTES = 256 * 1024 * 1024;

/** One pair as it was left. */
export interface Session {
  id: string;
  title: string;
  /** Milliseconds since 1970. */
  used: number;
  /** Of frames and result, as far as they are kept. */
  frameBytes: number;
  resultBytes: number;
  /** None where the session was kept before there were timelines. */
  timelineBytes?: number;
  setting: Setting;
  /** A small picture of one's own first frame. */
  thumbnail: Blob | null;
}

interface Tables extends DBSchema {
  sessions: { key: string; value: Session };
  frames: { key: string; value: Source };
  results: { key: string; value: { settings: string; found: Found } };
  timelines: { key: string; value: Timeline };
}

const EVERY = ["sessions", "frames", "results", "timelines"] as const;

let opened: Promise<IDBPDatabase<Tables>> | null = null;

/** Rejects where the browser keeps nothing, as in some private windows. */
function database(): Promise<IDBPDatabase<Tables>> {
  opened ??= openDB<Tables>("relievo", 2, {
    upgrade(db, before) {
      if (before < 1) {
        db.createObjectStore("sessions", { keyPath: "id" });
        db.createObjectStore("frames");
        db.createObjectStore("results");
      }
      db.createObjectStore("timelines");
    },
    // Another window with a later version asks for it.
    blocking() {
      void opened?.then((db) => db.close());
      opened = null;
    },
  });
  return opened;
}

/** All sessions, the one used last first. */
export async function sessions(): Promise<Session[]> {
  const all = await (await database()).getAll("sessions");
  return all.sort((a, b) => b.used - a.used);
}

export interface Recalled {
  session: Session;
  source: Source;
  result: { settings: string; found: Found } | null;
  timeline: Timeline | null;
}

export async function recall(id: string): Promise<Recalled | null> {
  const db = await database();
  const [session, source, result, timeline] = await Promise.all([
    db.get("sessions", id),
    db.get("frames", id),
    db.get("results", id),
    db.get("timelines", id),
  ]);
  if (!session || !source) return null;
  return { session, source, result: result ?? null, timeline: timeline ?? null };
}

/** Keeps a session; the rest only where it is not kept already. */
export async function keep(
  session: Session,
  source: Source | null,
  found: { settings: string; found: Found } | null | "drop",
  timeline: Timeline | null | "drop",
): Promise<void> {
  await makeRoom(session);
  const transaction = (await database()).transaction(EVERY, "readwrite");
  const [pairs, frames, results, timelines] = EVERY.map((name) => transaction.objectStore(name));
  await Promise.all([
    pairs!.put(session as never),
    source ? frames!.put(source as never, session.id) : null,
    found === "drop"
      ? results!.delete(session.id)
      : found
        ? results!.put(found as never, session.id)
        : null,
    timeline === "drop"
      ? timelines!.delete(session.id)
      : timeline
        ? timelines!.put(timeline as never, session.id)
        : null,
    transaction.done,
  ]);
}

async function makeRoom(session: Session): Promise<void> {
  const others = (await sessions()).filter(({ id }) => id !== session.id);
  let room = MOST_BYTES - sizeOf(session);
  for (const other of others) {
    room -= sizeOf(other);
    if (room < 0) await forget(other.id);
  }
}

export const sizeOf = ({ frameBytes, resultBytes, timelineBytes = 0 }: Session) =>
  frameBytes + resultBytes + timelineBytes;

export async function forget(id: string): Promise<void> {
  const transaction = (await database()).transaction(EVERY, "readwrite");
  await Promise.all([
    ...EVERY.map((name) => transaction.objectStore(name).delete(id)),
    transaction.done,
  ]);
}

export async function forgetAll(): Promise<void> {
  const transaction = (await database()).transaction(EVERY, "readwrite");
  await Promise.all([
    ...EVERY.map((name) => transaction.objectStore(name).clear()),
    transaction.done,
  ]);
}
