/** What the worker says by itself (`index.ts` says how languages are kept). */

import { worker as en } from "./en/worker";

export type WorkerText = typeof en;

export const text: WorkerText = en;
