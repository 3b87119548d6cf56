/** What is taken away, from whoever shows it: files and pictures at the frame's size. */

import { askShown } from "../session";
import { store, type State } from "../store";
import { later } from "../text/later";
import { wantedParams } from "../views";
import type { Whose } from "../worker/protocol";

const { exporting } = later;

export type Bytes = Uint8Array<ArrayBuffer>;

/** A picture that can be taken. */
export interface Shot {
  of: Whose;
  kind: string;
  title: string;
}

/** Before the solver has been at work there are the frames, and the curves as drawn. */
const AT_ONCE = ["frame", "second", "segmentation"];
/** Of the truth, and of Horn–Schunck. */
const TRUE = ["flow", "depth", "labels", "occlusion"];

/** All that there are at present. */
export function shots({ catalogues, truth, started }: Readonly<State>): Shot[] {
  const all = catalogues?.views ?? [];
  const found = all
    .filter(({ kind }) => started || AT_ONCE.includes(kind))
    .map(({ kind, title }): Shot => ({ of: "found", kind, title }));
  if (!truth) return found;
  const known = all.filter(({ kind }) => TRUE.includes(kind));
  return [
    ...found,
    ...known.map(({ kind, title }): Shot => ({
      of: "truth",
      kind,
      title: exporting.ofTruth(title),
    })),
    { of: "horn-schunck", kind: "flow", title: exporting.baseline },
  ];
}

export const nameOf = ({ of, kind }: Shot) => (of === "found" ? kind : `${of}-${kind}`) + ".png";

/** One picture as PNG; `null` where that failed, which has been said. */
export function pictureOf({ of, kind }: Shot): Promise<Bytes | null> {
  const { state } = store;
  const compared = of !== "found";
  const most = state.ranges.most[kind] ?? null;
  const params = { ...wantedParams(state, compared), most, magnify: 1, legend: true };
  return askShown(null, (service) => service.png({ of, kind, params, compared }));
}

/** One of the core's files. */
export function fileOf(name: string): Promise<Bytes | null> {
  return askShown(null, (service) => service.file(name, wantedParams(store.state, false)));
}

/** Why there is no result to take away at present; empty where there is one. */
export function missing({
  catalogues,
  playing,
  frames,
  started,
  running,
}: Readonly<State>): string {
  if (!frames) return exporting.noFrames;
  if (!catalogues || playing) return exporting.recording;
  if (running) return exporting.atWork;
  return started ? "" : exporting.notRun;
}

/** A name for files of what is open. */
export function stem({ source }: Readonly<State>): string {
  return `relievo-${source?.kind === "scene" ? source.name : "frames"}`;
}
