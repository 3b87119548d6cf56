/** What is there when the page opens: what its address asks for, else what was left last, else a recorded result. */

import { handOver, play } from "../recording/play";
import { load, openScene } from "../session";
import { store } from "../store";
import { follow } from "./address";
import { sessions } from "./database";
import { resume } from "./remember";

/** A sequence that has depth everywhere. */
const FIRST = "columns";

export async function begin(): Promise<void> {
  const asks = location.hash.length > 1;
  const [last] = asks ? [] : await sessions().catch(() => []);
  const played = asks || last ? null : play(FIRST).catch((e) => (console.error(e.stack), null));
  if (!(await load())) return;
  if (await follow()) return;
  const { message } = store.state;
  if (last && (await resume(last.id))) return;
  const { source, opening } = store.state;
  // Somebody was faster.
  if (opening || (source && !store.state.playing)) return;
  const recording = await (played ?? null);
  if (recording && store.state.playing) await handOver(recording, store.state.source!);
  else if (!store.state.source && !store.state.opening) await openScene(FIRST);
  // What is wrong with the address is still to be said.
  if (message) store.update({ message });
}
