/**
 * Two views at once: which there are, what each asks of the core, and whose it is.
 *
 * A side is a word for whose picture it is and one for its kind: `frame first`, `found depth`, `truth flow`.
 */

import type { State } from "../store";
import type { Whose } from "../worker/protocol";

export interface Side {
  id: string;
  label: string;
  /** Whose it is, as a heading. */
  whose: string;
  /** The picture to ask for; none where it is a frame itself. */
  picture: [Whose, string] | null;
}

const KINDS = {
  depth: "depth",
  flow: "motion",
  labels: "labels",
  occlusion: "occlusion",
  confidence: "confidence",
  arrows: "arrows",
} as const;

type Kind = keyof typeof KINDS;

const side = (of: Whose, whose: string, kind: Kind): Side => ({
  id: `${of} ${kind}`,
  label: `${whose}: ${KINDS[kind]}`,
  whose,
  picture: [of, kind],
});

const frame = (which: string, label: string): Side => ({
  id: `frame ${which}`,
  label,
  whose: "Frames",
  picture: null,
});

export const SIDES: Side[] = [
  frame("first", "First frame"),
  frame("second", "Second frame"),
  ...(Object.keys(KINDS) as Kind[]).map((kind) => side("found", "Found", kind)),
  ...(["depth", "flow", "labels", "occlusion"] as const).map((kind) =>
    side("truth", "Truth", kind),
  ),
  ...(["flow", "arrows"] as const).map((kind) => side("horn-schunck", "Horn–Schunck", kind)),
];

export const sideOf = (id: string): Side => SIDES.find((one) => one.id === id) ?? SIDES[0]!;

/** Those that make sense for what is open. */
export const sidesFor = ({ truth }: Readonly<State>): Side[] =>
  SIDES.filter(({ picture }) => truth || picture?.[0] !== "truth");

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
      return `found ${view}`;
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
