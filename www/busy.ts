/** What the page is waiting for. Several things may be under way: the latest is named, and each ends by itself. */

import { store } from "./store";

const waits: { phrase: string }[] = [];

const name = () => store.update({ busy: waits.at(-1)?.phrase ?? null });

/** Names what the page waits for while `work` is under way. */
export async function during<T>(phrase: string | null, work: () => Promise<T>): Promise<T> {
  if (phrase === null) return work();
  const mine = { phrase };
  waits.push(mine);
  name();
  try {
    return await work();
  } finally {
    waits.splice(waits.indexOf(mine), 1);
    name();
  }
}
