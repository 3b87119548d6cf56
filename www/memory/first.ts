/** What is there when the page opens: what its address asks for, else what was left last, else a recorded result. */

import { handOver, play } from "../recording/play";
import { fetchRecording } from "../recording/recording";
import { load, openScene } from "../session";
import { store } from "../store";
import { follow } from "./address";
import { sessions } from "./database";
import { namesPair } from "./link";
import { resume } from "./remember";

/** A sequence that has depth everywhere. */
const FIRST = "columns";

export async function begin(): Promise<void> {
  const asks = namesPair(location.hash);
  const [last] = asks ? [] : await sessions().catch(() => []);
  // The picture comes before the core, which is more to load.
  const recording = asks || last ? null : await fetchRecording(FIRST).catch(() => null);
  const played = recording && play(recording);
  if (!(await load())) return;
  if (asks && (await follow())) return;
  const { message } = store.state;
  if (last && (await resume(last.id))) return;
  const { source, opening } = store.state;
  // Somebody was faster.
  if (opening || (source && !store.state.playing)) return;
  await played;
  if (recording && store.state.playing) await handOver(recording, store.state.source!);
  else if (!store.state.source && !store.state.opening) await openScene(FIRST);
  // What is wrong with the address is still to be said.
  if (message) store.update({ message });
}
