/**
 * Two views at once: which there are, what each asks of the core, and whose it is.
 *
 * A side is a word for whose picture it is and one for its kind: `frame first`, `found depth`, `truth flow`.
 */

import type { State } from "../store";
import { text } from "../text";
import type { KnownParts, Whose } from "../worker/protocol";

export interface Side {
  id: string;
  label: string;
  /** Whose it is, as a heading. */
  whose: string;
  /** The picture to ask for; none where it is a frame itself. */
  picture: [Whose, string] | null;
}

const { split: words, whose: WHOSE } = text;
const KINDS = words.kinds;

type Kind = keyof typeof KINDS;

const side = (of: Whose, kind: Kind): Side => ({
  id: `${of} ${kind}`,
  label: words.side(WHOSE[of], KINDS[kind]),
  whose: WHOSE[of],
  picture: [of, kind],
});

const frame = (which: string, label: string): Side => ({
  id: `frame ${which}`,
  label,
  whose: WHOSE.frames,
  picture: null,
});

export const SIDES: Side[] = [
  frame("first", words.first),
  frame("second", words.second),
  ...(Object.keys(KINDS) as Kind[]).map((kind) => side("found", kind)),
  ...(["depth", "flow", "labels", "occlusion"] as const).map((kind) => side("truth", kind)),
  ...(["flow", "arrows"] as const).map((kind) => side("horn-schunck", kind)),
  ...(["flow", "depth", "labels"] as const).map((kind) => ({
    id: `found error-${kind}`,
    ...{ label: words.side(WHOSE.error, KINDS[kind]), whose: WHOSE.error },
    picture: ["found", `error-${kind}`] as [Whose, string],
  })),
  {
    ...{ id: "horn-schunck error-flow", label: words.errorOfBaseline, whose: WHOSE.error },
    picture: ["horn-schunck", "error-flow"],
  },
];

export const sideOf = (id: string): Side => SIDES.find((one) => one.id === id) ?? SIDES[0]!;

/** Those that make sense for what is open. */
export const sidesFor = ({ truth }: Readonly<State>): Side[] =>
  SIDES.filter(({ picture }) => {
    if (!picture) return true;
    const [of, kind] = picture;
    const error = kind.startsWith("error-");
    return (of !== "truth" && !error) || tells(truth, error ? kind.slice(6) : kind);
  });

/** Kinds of which there are maps of errors. */
export const TOLD = ["flow", "depth", "labels"];

/** Whether the truth has what such a picture shows. */
export function tells(truth: KnownParts | null, kind: string): boolean {
  return truth !== null && truth[kind === "arrows" ? "flow" : (kind as keyof KnownParts)];
}

/** The side that shows what a view shows; `null` for one that is no flat picture of the frame's size. */
export function sideOfView({ view, viewParams }: Readonly<State>): string | null {
  switch (view) {
    case "curves":
      return "frame first";
    case "motion":
      return `found ${viewParams.motion}`;
    case "depth":
    case "labels":
    case "confidence":
    case "occlusion":
    case "residual":
      return `found ${view}`;
    case "error":
      return `found ${viewParams.error}`;
    default:
      return null;
  }
}

/** The pictures of both sides, in order. */
export function sidesAsk({ split }: Readonly<State>): [Whose, string][] {
  if (!split) return [];
  return [split.left, split.right].flatMap((id) => {
    const { picture } = sideOf(id);
    return picture ? [picture] : [];
  });
}
