/**
 * A link to a pair as it is: `#columns/depth` names the sequence and the view, and after a `?` stand curves, camera,
 * options and what the view was set to, as far as they are not the usual ones.
 *
 * How it is looked at beyond that (`sight.ts`) stands there, too, and may stand there alone.
 *
 *     #blocks/anaglyph?c=c107,80,27~p10,10,90,12,50,70&f=320,159.5,119.5&o=preset:paper~mu:0.1&p=glasses:amber-blue&z=1,2
 *
 * Curves are given to a tenth of a pixel. Whatever a link says is checked against what the core offers; what cannot be
 * used is named, and the rest holds.
 */

import { store, type State, type ViewParams } from "../store";
import { text } from "../text";
import { VIEWS } from "../views";
import type {
  Camera,
  Catalogues,
  OptionEntry,
  OptionValues,
  Point,
  Shape,
} from "../worker/protocol";
import type { Setting } from "./setting";
import { KEYS, partsOf, sightOf, type Sight } from "./sight";

/** What a link asks for. */
export interface Target {
  name: string;
  view: string | null;
  /** Everything that is set, where the link tells; `null` where it only names the pair. */
  setting: Partial<Setting> | null;
  /** How it is looked at; `null` where the link does not tell. */
  sight: Sight | null;
  /** Parts that cannot be used, in words. */
  useless: string[];
}

const DEFAULT_PARAMS = store.state.viewParams;
/** Corners of a freehand line: more than this is no curve that the page has drawn. */
const MOST_POINTS = 4000;

/** The part of an address after `#` that names a pair and how it is looked at. */
export function addressOf(name: string, state: Readonly<State>): string {
  const parts = partsOf(state);
  const place = `#${encodeURIComponent(name)}/${state.view}`;
  return parts.length > 0 ? `${place}?${parts.join("&")}` : place;
}

/** The same with all that is set. */
export function linkOf(name: string, state: Readonly<State>): string {
  const { shapes, camera, options, viewParams, scales, view } = state;
  const parts = {
    c: shapes.map(written).join("~"),
    f: [camera.focal, camera.cx, camera.cy]
      .filter((x) => x !== undefined)
      .map(short)
      .join(","),
    o: pairs(options),
    p: pairs(
      Object.fromEntries(
        Object.entries(viewParams).filter(
          ([key, value]) => key !== "palette" && DEFAULT_PARAMS[key as keyof ViewParams] !== value,
        ),
      ),
    ),
    z: scales.some((scale) => scale !== 1) ? scales.map(short).join(",") : "",
  };
  // `c` without a value says that there is no curve.
  const given = Object.entries(parts).filter(([key, text]) => text !== "" || key === "c");
  const all = [...given.map(([key, text]) => `${key}=${text}`), ...partsOf(state)];
  return `#${encodeURIComponent(name)}/${view}?${all.join("&")}`;
}

const short = (value: number) => String(Number(value.toPrecision(7)));
const tenth = (value: number) => String(Math.round(value * 10) / 10);

function written(shape: Shape): string {
  return shape.kind === "circle"
    ? `c${[shape.x, shape.y, shape.r].map(tenth).join(",")}`
    : `p${shape.points.flat().map(tenth).join(",")}`;
}

const pairs = (values: object) =>
  Object.entries(values)
    .map(([key, value]) => `${key}:${typeof value === "number" ? short(value) : value}`)
    .join("~");

/** Whether the part of an address after `#` is more than a place on the page. */
export function namesPair(hash: string): boolean {
  const [place = ""] = hash.slice(1).split("?");
  return place !== "" && !document.getElementById(place);
}

/** What the part of an address after `#` asks for; `null` when it asks for nothing. */
export function targetOf(hash: string, catalogues: Catalogues): Target | null {
  if (!namesPair(hash)) return null;
  const [place = "", ...rest] = hash.slice(1).split("?");
  const [name = "", viewId] = place.split("/").map(decoded);
  const useless: string[] = [];
  const view = VIEWS.find(({ id }) => id === viewId)?.id ?? null;
  if (viewId && !view) useless.push(text.links.view(viewId.slice(0, 40)));
  if (rest.length === 0) return { name, view, setting: null, sight: null, useless };

  const query = new Map(
    rest
      .join("?")
      .split("&")
      .map((part) => {
        const [key = "", ...value] = part.split("=");
        return [key, decoded(value.join("="))] as const;
      }),
  );
  const looked = KEYS.some((key) => query.has(key));
  const sight = looked ? sightOf(query, catalogues, useless) : null;
  if (looked && [...query.keys()].every((key) => KEYS.includes(key))) {
    return { name, view, setting: null, sight, useless };
  }
  const setting: Partial<Setting> = { scales: [], viewParams: DEFAULT_PARAMS, options: {} };
  const use = <K extends keyof Setting>(
    key: string,
    words: string,
    of: K,
    read: (text: string) => Setting[K] | null,
  ) => {
    const text = query.get(key);
    if (text === undefined) return;
    const value = read(text);
    if (value === null) useless.push(words);
    else setting[of] = value;
  };
  use("c", text.links.curves, "shapes", (text) => shapesOf(text, catalogues.limits.maxCurves));
  use("f", text.links.camera, "camera", cameraOf);
  use("o", text.links.options, "options", (text) => optionsOf(text, catalogues));
  use("p", text.links.params, "viewParams", (text) => paramsOf(text, catalogues));
  use("z", text.links.scales, "scales", scalesOf);
  // Older links have the palette among the settings of the view.
  const palette = query.has("l") ? sight?.palette : setting.viewParams?.palette;
  return { name, view, setting, sight: sight && { ...sight, palette: palette! }, useless };
}

function decoded(text: string): string {
  try {
    return decodeURIComponent(text);
  } catch {
    return text;
  }
}

/** All numbers, or none. */
function numbers(text: string): number[] | null {
  const all = text.split(",").map((part) => (part.trim() === "" ? Number.NaN : Number(part)));
  return all.every((value) => Number.isFinite(value) && Math.abs(value) < 1e7) ? all : null;
}

function shapesOf(text: string, most: number): Shape[] | null {
  if (text === "") return [];
  const shapes = text.split("~").map(shapeOf);
  return shapes.length <= most && shapes.every((shape) => shape !== null) ? shapes : null;
}

function shapeOf(text: string): Shape | null {
  const all = numbers(text.slice(1));
  if (!all) return null;
  if (text[0] === "c" && all.length === 3 && all[2]! > 0) {
    return { kind: "circle", x: all[0]!, y: all[1]!, r: all[2]! };
  }
  if (text[0] !== "p" || all.length % 2 || all.length < 6 || all.length > 2 * MOST_POINTS) {
    return null;
  }
  const points = Array.from({ length: all.length / 2 }, (_, i): Point => [
    all[2 * i]!,
    all[2 * i + 1]!,
  ]);
  return { kind: "polygon", points };
}

function cameraOf(text: string): Camera | null {
  const all = numbers(text);
  if (!all || (all.length !== 1 && all.length !== 3) || all[0]! <= 0) return null;
  const [focal, cx, cy] = all;
  return { focal: focal!, ...(cx === undefined ? {} : { cx, cy: cy! }) };
}

function scalesOf(text: string): number[] | null {
  const all = numbers(text);
  return all && all.length <= 16 && all.every((scale) => scale > 0 && scale <= 16) ? all : null;
}

/** `key:value` pairs, or nothing where one is not such a pair. */
function split(text: string): [string, string][] | null {
  const all = text.split("~").map((part) => part.split(":"));
  return all.every((pair) => pair.length === 2) ? (all as [string, string][]) : null;
}

function optionsOf(text: string, { options, presets }: Catalogues): OptionValues | null {
  const values: Record<string, unknown> = {};
  for (const [key, word] of split(text) ?? [["", ""]]) {
    const entry = options.find((option) => option.key === key);
    const preset = key === "preset" && presets.some(({ value }) => value === word);
    const value = preset ? word : entry && optionOf(entry, word);
    if (value === undefined) return null;
    values[key] = value;
  }
  return values as OptionValues;
}

function optionOf(entry: OptionEntry, word: string): unknown {
  switch (entry.kind) {
    case "choice":
      return entry.choices.some(({ value }) => value === word) ? word : undefined;
    case "toggle":
      return word === "true" ? true : word === "false" ? false : undefined;
    default: {
      if (word === "null") return entry.kind === "number" && entry.automatic ? null : undefined;
      const value = numbers(word)?.[0];
      const fits = value !== undefined && value >= entry.min && value <= entry.max;
      return fits && (entry.kind === "number" || Number.isInteger(value)) ? value : undefined;
    }
  }
}

function paramsOf(text: string, catalogues: Catalogues): ViewParams | null {
  const params: Record<string, unknown> = { ...DEFAULT_PARAMS };
  for (const [key, word] of split(text) ?? [["", ""]]) {
    const usual = params[key];
    if (usual === undefined) return null;
    const setting = VIEWS.flatMap(({ settings }) => settings({ ...store.state, catalogues })).find(
      (one) => one.key === key,
    );
    if (typeof usual === "boolean" && (word === "true" || word === "false")) {
      params[key] = word === "true";
    } else if (setting?.choices?.some(({ value }) => value === word)) {
      params[key] = word;
    } else if (setting?.range) {
      const value = Number(word);
      if (!(value >= setting.range.min && value <= setting.range.max)) return null;
      params[key] = value;
    } else return null;
  }
  return params as unknown as ViewParams;
}
