/** All that a person has set for a pair: what a memory or a link brings back. */

import type { State } from "../store";

export type Setting = Pick<
  State,
  "shapes" | "camera" | "options" | "view" | "viewParams" | "ranges" | "scales" | "pace"
>;

export function settingOf(state: Readonly<State>): Setting {
  const { shapes, camera, options, view, viewParams, ranges, scales, pace } = state;
  return { shapes, camera, options, view, viewParams, ranges, scales, pace };
}
