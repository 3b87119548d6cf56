/**
 * How long a pass takes at least, in milliseconds, so that an eye can follow.
 *
 * Until someone chooses, a built-in sequence takes about four seconds, a dozen long passes with one preset or forty
 * short ones with the other, and frames of one's own as long as they must.
 */

import type { State } from "./store";
import { text } from "./text";

export const PACES = [
  { value: 0, label: text.run.paces.fast },
  { value: 100, label: text.run.paces.brisk },
  { value: 400, label: text.run.paces.slow },
] as const;

export function paceOf({ pace, source, options }: Readonly<State>): number {
  if (pace !== null) return pace;
  if (source?.kind !== "scene") return 0;
  return options.preset === "paper" ? 100 : 400;
}
