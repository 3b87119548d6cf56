/**
 * How a pair is looked at beyond the view, as parts of an address: what Back and Forward step through, and a link carries.
 *
 *     s=found.depth~truth.depth~0.42    both sides of the divider, and where that is
 *     r=span:0.4,1.2~error-flow:2       ranges of colours that are held, of depth as 1/Z; in the truth's unit `true`
 *     m=4,0.25,0.6                      magnified so many times about a point, in shares of the frame
 *     l=viridis                         the palette
 *
 * What is as usual has no part.
 */

import { FITTING, within, type Zoom } from "../stage/place";
import { SIDES, sidesFor } from "../stage/sides";
import { FREE, store, type Ranges, type Split, type State } from "../store";
import { text } from "../text";
import type { Catalogues } from "../worker/protocol";

export interface Sight {
  split: Split | null;
  ranges: Ranges;
  zoom: Zoom;
  palette: string;
}

const USUAL = store.state.viewParams.palette;
/** Larger than any that a stage allows. */
const MOST_ZOOM = 1000;

export const KEYS = ["s", "r", "m", "l"];

const short = (value: number) => String(Number(value.toPrecision(4)));
/** So that what was typed as Z, and is kept as 1/Z, comes back as it was typed. */
const exact = (value: number) => String(Number(value.toPrecision(7)));

export const USUAL_SIGHT: Sight = { split: null, ranges: FREE, zoom: FITTING, palette: USUAL };

/** The parts of an address, in their order. */
export function partsOf({ split, ranges, zoom, viewParams }: Readonly<State>): string[] {
  const { span, trueSpan, speed, most } = ranges;
  const held = [
    span && `span:${span.map(exact).join(",")}`,
    trueSpan && `true:${trueSpan.map(exact).join(",")}`,
    speed !== null && `speed:${short(speed)}`,
    ...Object.entries(most).map(([kind, value]) => `${kind}:${short(value)}`),
  ].filter(Boolean);
  const sides = split && [split.left, split.right].map((id) => id.replace(" ", "."));
  return [
    sides && `s=${[...sides, short(split.at)].join("~")}`,
    held.length > 0 && `r=${held.join("~")}`,
    zoom.factor > 1 && `m=${[zoom.factor, ...zoom.middle].map(short).join(",")}`,
    viewParams.palette !== USUAL && `l=${viewParams.palette}`,
  ].filter((part): part is string => Boolean(part));
}

/** What the parts tell, the usual where there is none; each that cannot be used is named. */
export function sightOf(
  query: Map<string, string>,
  { palettes }: Catalogues,
  useless: string[],
): Sight {
  const use = <T>(key: string, words: string, usual: T, read: (text: string) => T | null): T => {
    const text = query.get(key);
    if (text === undefined) return usual;
    const value = read(text);
    if (value === null) useless.push(words);
    return value ?? usual;
  };
  const known = (name: string) => (palettes.some(({ value }) => value === name) ? name : null);
  return {
    split: use<Split | null>("s", text.links.split, null, splitOf),
    ranges: use("r", text.links.ranges, FREE, rangesOf),
    zoom: use("m", text.links.zoom, FITTING, zoomOf),
    palette: use("l", text.links.palette, USUAL, known),
  };
}

/** Looks at the open pair like that; sides that need what is not known of it give way. */
export function lookLike({ split, ranges, zoom, palette }: Sight): void {
  const { state } = store;
  store.update({ ranges, zoom, viewParams: { ...state.viewParams, palette } });
  const there = new Set(sidesFor(store.state).map(({ id }) => id));
  // After the view, which takes the right side when it changes.
  store.update({ split: split && there.has(split.left) && there.has(split.right) ? split : null });
}

function numbersOf(text: string): number[] | null {
  const all = text.split(",").map((part) => (part.trim() === "" ? NaN : Number(part)));
  return all.every((value) => Number.isFinite(value) && Math.abs(value) <= 1e6) ? all : null;
}

function splitOf(text: string): Split | null {
  const [left, right, place] = text.split("~").map((part) => part.replace(".", " "));
  const at = Number(text.split("~")[2]);
  const is = (id: string | undefined) => SIDES.some((side) => side.id === id);
  if (!place || !is(left) || !is(right) || !(at >= 0 && at <= 1)) return null;
  return { left: left!, right: right!, at };
}

function rangesOf(text: string): Ranges | null {
  const ranges: Ranges = { ...FREE, most: {} };
  for (const part of text.split("~")) {
    const [key = "", value = ""] = part.split(":");
    const [one, other] = numbersOf(value) ?? [];
    if (one === undefined || one < 0) return null;
    const span = other !== undefined && other > one + 1e-9;
    if (key === "span" && span) ranges.span = [one, other];
    else if (key === "true" && span) ranges.trueSpan = [one, other];
    else if (key === "speed" && one >= 1e-6) ranges.speed = one;
    else if (/^(residual|error-(flow|depth))$/.test(key) && one >= 1e-6) ranges.most[key] = one;
    else return null;
  }
  return ranges;
}

function zoomOf(text: string): Zoom | null {
  const [factor, x, y] = numbersOf(text) ?? [];
  if (y === undefined || !(factor! >= 1 && factor! <= MOST_ZOOM)) return null;
  return within({ factor: factor!, middle: [x!, y] });
}
