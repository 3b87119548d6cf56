/**
 * What this device keeps of the pairs worked on: IndexedDB, in three tables so that a moved curve does not write frames
 * anew.
 *
 * `sessions` has settings and views, `frames` the files of one's own pairs, `results` what was found. Together they take
 * at most `MOST_BYTES`; what was used longest ago goes first.
 */

import { openDB, type DBSchema, type IDBPDatabase } from "idb";

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
  setting: Setting;
  /** A small picture of one's own first frame. */
  thumbnail: Blob | null;
}

interface Tables extends DBSchema {
  sessions: { key: string; value: Session };
  frames: { key: string; value: Source };
  results: { key: string; value: { settings: string; found: Found } };
}

const EVERY = ["sessions", "frames", "results"] as const;

let opened: Promise<IDBPDatabase<Tables>> | null = null;

/** Rejects where the browser keeps nothing, as in some private windows. */
function database(): Promise<IDBPDatabase<Tables>> {
  opened ??= openDB<Tables>("relievo", 1, {
    upgrade(db) {
      db.createObjectStore("sessions", { keyPath: "id" });
      db.createObjectStore("frames");
      db.createObjectStore("results");
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
}

export async function recall(id: string): Promise<Recalled | null> {
  const db = await database();
  const [session, source, result] = await Promise.all([
    db.get("sessions", id),
    db.get("frames", id),
    db.get("results", id),
  ]);
  return session && source ? { session, source, result: result ?? null } : null;
}

/** Keeps a session; `source` and `found` only where they are not kept already. */
export async function keep(
  session: Session,
  source: Source | null,
  found: { settings: string; found: Found } | null | "drop",
): Promise<void> {
  await makeRoom(session);
  const transaction = (await database()).transaction(EVERY, "readwrite");
  const [pairs, frames, results] = EVERY.map((name) => transaction.objectStore(name));
  await Promise.all([
    pairs!.put(session as never),
    source ? frames!.put(source as never, session.id) : null,
    found === "drop"
      ? results!.delete(session.id)
      : found
        ? results!.put(found as never, session.id)
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

export const sizeOf = ({ frameBytes, resultBytes }: Session) => frameBytes + resultBytes;

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
