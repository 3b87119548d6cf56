/** What dialogs say that are fetched when they are opened (`index.ts` says how languages are kept). */

import { later as en } from "./en/later";

export type Later = typeof en;

export const later: Later = en;
