/**
 * The views: what each shows, asks of the core, and lets one choose, as data.
 */

import { byId } from "./dom";
import { sidesAsk, tells, TOLD } from "./stage/sides";
import { store, type State, type ViewParams } from "./store";
import { text } from "./text";
import type { Choice, Wanted, Whose } from "./worker/protocol";

/** Something that a view lets one set. */
export interface Setting {
  key: keyof ViewParams;
  label: string;
  /** One of several; a slider's range; neither for a yes or no. */
  choices?: Choice[];
  range?: { min: number; max: number; step: number };
  /** Whether a range is of shares, to be read in percent. */
  percent?: boolean;
  /** What setting it sets as well. */
  also?: Partial<ViewParams>;
}

export interface View {
  id: string;
  label: string;
  /** One line on how to read it. */
  hint: string;
  /** Pictures to ask for; none means the frame itself. */
  kinds: (params: ViewParams) => string[];
  settings: (state: Readonly<State>) => Setting[];
  /** Pixels stand for classes and must not be blended. */
  crisp?: boolean;
  /** Curves may lie over it. */
  curves?: boolean;
}

/** What stands in the row of views: one view, or several that belong together. */
export interface Group {
  id: string;
  label: string;
  views: string[];
}

const group = (id: keyof typeof text.groups, ...views: (keyof typeof text.views)[]): Group => ({
  ...{ id, label: text.groups[id], views },
});

export const GROUPS: Group[] = [
  group("curves", "curves"),
  group("depth", "depth"),
  group("motion", "motion"),
  group("space", "relief", "anaglyph"),
  group("diagnostics", "labels", "confidence", "occlusion", "residual", "compare", "error"),
];

export const groupOf = (view: string): Group =>
  GROUPS.find(({ views }) => views.includes(view)) ?? GROUPS[0]!;

const { settings, kinds } = text;
const NONE = () => [];
const palette = ({ catalogues }: Readonly<State>): Setting => ({
  ...{ key: "palette", label: settings.palette, choices: catalogues?.palettes ?? [] },
});
const ON_TOP: Setting = { key: "curvesOnTop", label: settings.curvesOnTop };

export const VIEWS: View[] = [
  {
    id: "curves",
    ...text.views.curves,
    kinds: NONE,
    settings: NONE,
    curves: true,
  },
  {
    id: "depth",
    ...text.views.depth,
    kinds: () => ["depth"],
    settings: (state) => [palette(state), ON_TOP],
    curves: true,
  },
  {
    id: "motion",
    ...text.views.motion,
    kinds: ({ motion }) => [motion],
    settings: () => [
      {
        key: "motion",
        label: settings.motion,
        choices: [
          { value: "flow", label: settings.flow },
          { value: "arrows", label: settings.arrows },
        ],
      },
      ON_TOP,
    ],
    curves: true,
  },
  {
    id: "anaglyph",
    ...text.views.anaglyph,
    kinds: ({ presentation }) => [presentation === "anaglyph" ? "anaglyph" : "stereo"],
    settings: ({ catalogues }) => [
      {
        key: "presentation",
        label: settings.presentation,
        choices: [
          { value: "anaglyph", label: settings.anaglyph },
          ...(catalogues?.layouts ?? []),
          { value: "wiggle", label: settings.wiggle },
        ],
      },
      { key: "glasses", label: settings.glasses, choices: catalogues?.glasses ?? [] },
      { key: "swap", label: settings.swap },
      {
        key: "baseline",
        label: settings.parallax,
        range: { min: 0, max: 0.08, step: 0.0025 },
        percent: true,
      },
      {
        key: "convergence",
        label: settings.convergence,
        range: { min: 0, max: 1, step: 0.02 },
        percent: true,
        also: { converge: false },
      },
      { key: "converge", label: settings.converge },
    ],
  },
  {
    id: "relief",
    ...text.views.relief,
    kinds: NONE,
    settings: () => [
      {
        key: "material",
        label: settings.material,
        choices: [
          { value: "textured", label: settings.textured },
          { value: "plaster", label: settings.plaster },
          { value: "wireframe", label: settings.wireframe },
          { value: "normals", label: settings.normals },
        ],
      },
      { key: "ghosts", label: settings.ghosts },
    ],
  },
  {
    id: "labels",
    ...text.views.labels,
    kinds: () => ["labels"],
    settings: NONE,
    crisp: true,
  },
  {
    id: "confidence",
    ...text.views.confidence,
    kinds: () => ["confidence"],
    settings: (state) => [palette(state), ON_TOP],
    curves: true,
  },
  {
    id: "occlusion",
    ...text.views.occlusion,
    kinds: () => ["occlusion"],
    settings: () => [ON_TOP],
    crisp: true,
    curves: true,
  },
  {
    id: "residual",
    ...text.views.residual,
    kinds: () => ["residual"],
    settings: (state) => [palette(state), ON_TOP],
    curves: true,
  },
  {
    id: "compare",
    ...text.views.compare,
    kinds: ({ compare }) => [compare],
    settings: ({ truth }) => [
      {
        key: "compare",
        label: settings.compare,
        choices: [
          { value: "flow", label: kinds.flow },
          { value: "depth", label: kinds.depth },
          { value: "labels", label: kinds.labels },
          { value: "occlusion", label: kinds.occlusion },
        ].filter(({ value }) => tells(truth, value)),
      },
    ],
  },
  {
    id: "error",
    ...text.views.error,
    kinds: ({ error }) => [error],
    settings: (state) => [
      {
        key: "error",
        label: settings.error,
        choices: [
          { value: "error-flow", label: kinds.flow },
          { value: "error-depth", label: kinds.depth },
          { value: "error-labels", label: kinds.labels },
        ].filter(({ value }) => tells(state.truth, value.slice(6))),
      },
      palette(state),
      ON_TOP,
    ],
    crisp: true,
    curves: true,
  },
];

/** Lines of a wireframe along the longer side. */
const WIRES = 100;
/** Frames up to this width are drawn on at twice their resolution. */
const FINE_WIDTH = 800;

/** Pictures are drawn no smaller than that along their longer side. */
const LEAST_SIDE = 512;

export const viewOf = (id: string): View => VIEWS.find((view) => view.id === id) ?? VIEWS[0]!;

/** The views that the core can draw and that make sense for what is open. */
export function available({ catalogues, truth }: Readonly<State>): View[] {
  // Until the core has told what it draws, all there are: a recording is shown by then.
  const known = catalogues && new Set(catalogues.views.map(({ kind }) => kind));
  return VIEWS.filter(({ id, kinds }) => {
    if (id === "compare" || id === "error") return TOLD.some((kind) => tells(truth, kind));
    if (id === "residual") return true;
    return !known || kinds(store.state.viewParams).every((kind) => known.has(kind));
  });
}

/** Parameters that the core's views take, for pictures that are compared with the truth or not. */
export function wantedParams(
  state: Readonly<State>,
  compared = comparing(state),
): Record<string, unknown> {
  const { viewParams, scales, width, ranges } = state;
  const { palette, glasses, baseline, swap, presentation } = viewParams;
  const convergence = viewParams.converge ? null : viewParams.convergence;
  const layout = ["anaglyph", "wiggle"].includes(presentation) ? "parallel" : presentation;
  // Arrows are lines: on a small frame they need finer pixels than the frame's.
  const magnify = width > 0 && width <= FINE_WIDTH ? 2 : 1;
  // The page draws a legend of its own, with numbers.
  const own = { scales, palette, glasses, baseline, convergence, swap, layout, magnify };
  const { span, trueSpan, speed } = ranges;
  return { ...own, legend: false, span: compared ? trueSpan : span, speed };
}

/** What the worker should send for what is shown. */
export function wantedBy(state: Readonly<State>): Omit<Wanted, "id"> {
  const params = wantedParams(state);
  return {
    view: nameOf(state),
    pictures: asks(state).map(([of, kind]) => ({
      of,
      kind,
      params: { ...params, most: state.ranges.most[kind] ?? null },
      compared: comparing(state),
    })),
    longest: screenSide() * zoomStep(state),
    mesh: state.view === "relief" ? { ...params, step: stepOf(state) } : null,
  };
}

/** Pixels between vertices; a mesh of wires must leave gaps to look through. */
function stepOf({ viewParams, width, height }: Readonly<State>): number | null {
  return viewParams.material === "wireframe" ? Math.ceil(Math.max(width, height) / WIRES) : null;
}

/** The stage's longer side in pixels of the screen, in steps so that resizing asks for nothing new. */
function screenSide(): number {
  const { clientWidth, clientHeight } = byId("stage");
  const side = Math.max(clientWidth, clientHeight) * (window.devicePixelRatio || 1);
  return Math.max(LEAST_SIDE, 256 * Math.ceil(side / 256));
}

/** How many times larger than it fits a picture is to be drawn, in steps so that few zooms ask for a new one. */
export function zoomStep({ zoom, width, height }: Readonly<State>): number {
  if (zoom.factor <= 1) return 1;
  const needed = Math.max(width, height) / screenSide();
  return 2 ** Math.ceil(Math.log2(Math.max(1, Math.min(zoom.factor, needed))));
}

/** Whether what is found must have the truth's colours. */
export const comparing = (state: Readonly<State>): boolean =>
  state.view === "compare" || (state.truth !== null && asks(state).some(([of]) => of !== "found"));

/** Whose pictures of which kind are on the stage, in order. */
export function asks(state: Readonly<State>): [Whose, string][] {
  if (state.split) return sidesAsk(state);
  const { view, viewParams } = state;
  const { kinds } = viewOf(view);
  return kinds(viewParams).flatMap((kind) =>
    view === "compare"
      ? compared(kind).map((of): [Whose, string] => [of, kind])
      : [["found", kind]],
  );
}

/** The baseline finds image motion only. */
const compared = (kind: string): Whose[] =>
  kind === "flow" ? ["truth", "found", "horn-schunck"] : ["truth", "found"];

/** A name for what is shown: the view, and the kinds of its pictures where they can be chosen. */
export function nameOf({ view, viewParams, split }: Readonly<State>): string {
  if (split) return [view, split.left, split.right].join(" ");
  return [view, ...viewOf(view).kinds(viewParams)].join(" ");
}

/** Whether what is shown is still to come: a worker that runs answers after the pass it is in. */
export function awaited(state: Readonly<State>): boolean {
  const { source, view, pictured } = state;
  // Curves lie on the frame itself, which is there.
  const there = state.split ? asks(state).length === 0 : view === "curves";
  return source !== null && !there && pictured !== nameOf(state);
}

/** A name above each picture, where there are several. */
export function captionsOf(state: Readonly<State>): string[] {
  return state.view === "compare" && !state.split ? asks(state).map(([of]) => text.whose[of]) : [];
}
