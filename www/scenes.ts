/** Built-in sequences as what can be opened. */

import type { Source } from "./worker/protocol";

/** Size at which they are ray-cast, and were recorded. */
const SIZE = { width: 320, height: 240 };

export const sceneOf = (name: string): Source => ({ kind: "scene", name, ...SIZE });
