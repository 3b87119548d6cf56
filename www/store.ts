/**
 * All of the page's state, in one place.
 *
 * Anything may read it and watch a part of it; commands in `session.ts` and `curves.ts` change it.
 */

import type { Film } from "./intake/film";
import type { Session } from "./memory/database";
import { FITTING, type Zoom } from "./stage/place";
import { text } from "./text";
import type { Timeline, Visit } from "./timeline/line";
import type {
  Camera,
  Catalogues,
  Contour,
  Found,
  FrameFile,
  KnownParts,
  Legend,
  OptionValues,
  Preview,
  Report,
  ScoreTable,
  Shape,
  Source,
} from "./worker/protocol";

export type Tool = "select" | "circle" | "freehand" | "polygon";
export type Showing = "first" | "second" | "flicker";

/** A film, and the pair of its frames that was taken last. */
export interface Reel {
  film: Film;
  /** Which frames, and their files; `null` until a pair was taken. */
  pair: { at: [number, number]; files: [FrameFile, FrameFile] } | null;
}

/** A frame of the user's own that waits for its partner. */
export type Slot = FrameFile & Preview;

/** A result that has been put away, or is being. */
export interface Held {
  /** The solver's when it was. */
  revision: number;
  /** What it was found with (`memory/held.ts`). */
  settings: string;
  ready: Promise<Found | null>;
  /** What `ready` comes to. */
  found: Found | null;
}

/** What undo goes back to. */
export interface Moment {
  shapes: Shape[];
  camera: Camera;
  options: OptionValues;
  scales: number[];
  held: Held | null;
  timeline: Timeline | null;
}

export interface ViewParams {
  palette: string;
  /** "flow" as colours or "arrows". */
  motion: string;
  /** "anaglyph", one of the core's layouts of a pair, or "wiggle". */
  presentation: string;
  glasses: string;
  /** Shares of the picture's width and of the depth shown. */
  baseline: number;
  convergence: number;
  /** Whether the core chooses the convergence. */
  converge: boolean;
  swap: boolean;
  material: string;
  /** Whether what is of unknown depth is shown, as a ghost. */
  ghosts: boolean;
  compare: string;
  /** Of what the map of errors is. */
  error: string;
  curvesOnTop: boolean;
}

/** Two views with a divider between them; the sides are of `stage/sides.ts`. */
export interface Split {
  left: string;
  right: string;
  /** Where the divider is, 0 left to 1 right. */
  at: number;
}

/** Ranges of colours that are held whatever is found; `null` where the core chooses. */
export interface Ranges {
  /** Least and greatest 1/Z, in units of the regions' means, */
  span: [number, number] | null;
  /** and in the truth's unit, for depth that is compared with it. */
  trueSpan: [number, number] | null;
  /** Pixels per frame at full colour. */
  speed: number | null;
  /** The end of the palette of a residual or of errors, by kind and in its unit. */
  most: Record<string, number>;
}

export interface State {
  /** What the core offers; `null` until it has loaded. */
  catalogues: Catalogues | null;
  /** The pair being worked on. */
  source: Source | null;
  /** The pair asked for last, until it is open or refused. */
  opening: Source | null;
  title: string;
  lesson: string;
  width: number;
  height: number;
  frames: [ImageBitmap, ImageBitmap] | null;
  names: [string, string];
  interlaced: [boolean, boolean];
  /** What is known to be true of the pair, if anything is. */
  truth: KnownParts | null;
  /** Frames of the user's own, waiting until both are there and fit. */
  slots: [Slot | null, Slot | null];
  /** The clip, animation or pile of photos that was opened last. */
  reel: Reel | null;

  /** Initial curves; `shapes[k]` starts region k + 1. */
  shapes: Shape[];
  selected: number | null;
  past: Moment[];
  future: Moment[];
  /** What the last look for curves came to, until they change. */
  finding: string | null;
  camera: Camera;
  /** A sentence: where the pair's focal length came from when it was opened. */
  focalFrom: string;
  /** What the last look for the focal length came to, until it changes. */
  focalFinding: string | null;
  options: OptionValues;

  /** Least time of a pass in milliseconds, where it was chosen (`pace.ts`). */
  pace: number | null;

  /** What the page is waiting for, as a phrase (`busy.ts`); `null` when it waits for nothing. */
  busy: string | null;
  /** Whether what is shown is a recording (`recording/`), and not yet the solver's. */
  playing: boolean;
  /** What this device keeps (`memory/database.ts`), used last first; `null` where it keeps nothing. */
  memory: Session[] | null;
  running: boolean;
  /** Whether the solver has been at work; until then the drawn curves are the contours. */
  started: boolean;
  /** Another number wherever what is found may be another. */
  revision: number;
  report: Report | null;
  contours: Contour[];
  /** Pictures, and the name of what they show (`views.ts`): it may lag behind what was chosen. */
  pictures: (ImageBitmap | null)[];
  pictured: string;
  /** What the colours of the pictures stand for; `null` where they are no measure. */
  legends: (Legend | null)[];
  scores: ScoreTable | null;
  /** The passes of the solve, as they are kept, and which is shown where it is not the solver's last (`looking.ts`). */
  timeline: Timeline | null;
  visit: Visit | null;
  /** The solver's own report, while `report` is that of a pass it has left behind. */
  working: Report | null;
  /** The result as it was last put away, and what that came to. */
  held: Held | null;
  heldFound: Found | null;
  /** Depth factor of each region: two frames do not tell it. */
  scales: number[];

  tool: Tool;
  view: string;
  viewParams: ViewParams;
  split: Split | null;
  ranges: Ranges;
  zoom: Zoom;
  /** Whether the reliefs of both lines of the timeline stand side by side. */
  beside: boolean;
  showing: Showing;
  /** The address of the step of a lesson that is open. */
  lessonStep: string | null;
  /** A sentence for the message bar. */
  message: string | null;
}

type Reaction = () => void;

/** After the next frame is drawn; a page that is not seen draws none. */
function inNextFrame(work: () => void): void {
  if (document.hidden) setTimeout(work);
  else requestAnimationFrame(() => setTimeout(work));
}

function catchUp(queue: Set<Reaction>): void {
  const [next] = queue;
  if (!next) return;
  queue.delete(next);
  if (queue.size > 0) inNextFrame(() => catchUp(queue));
  next();
}

/** State with subscriptions. */
export class Store {
  private reactions: Reaction[] = [];
  private later = new Set<Reaction>();

  constructor(private current: State) {}

  get state(): Readonly<State> {
    return this.current;
  }

  update(patch: Partial<State>): void {
    this.current = { ...this.current, ...patch };
    for (const react of this.reactions) react();
  }

  /** Calls `react` now, and again whenever one of the selected values is another than before; gives what ends that. */
  watch(select: (state: State) => readonly unknown[], react: (state: State) => void): () => void {
    let last: readonly unknown[] | null = null;
    const check = () => {
      const next = select(this.current);
      if (last && next.every((value, i) => Object.is(value, last![i]))) return;
      last = next;
      react(this.current);
    };
    this.reactions.push(check);
    check();
    return () => {
      this.reactions = this.reactions.filter((one) => one !== check);
    };
  }

  /**
   * The same, but later, with what the state is by then: for panels beside what is looked at. Each has a frame of its own
   * after the picture's, so that all that a progress changes is no single long task; one that must not wait for the others
   * is `prompt`.
   */
  watchAfter(
    select: (state: State) => readonly unknown[],
    react: (state: State) => void,
    prompt = false,
  ): void {
    const queue = prompt ? new Set<Reaction>() : this.later;
    const later = () => react(this.current);
    this.watch(select, () => {
      if (queue.size === 0) inNextFrame(() => catchUp(queue));
      queue.add(later);
    });
  }
}

/** Nothing is held. */
export const FREE: Ranges = { span: null, trueSpan: null, speed: null, most: {} };

export const store = new Store({
  catalogues: null,
  source: null,
  opening: null,
  title: "",
  lesson: "",
  width: 0,
  height: 0,
  frames: null,
  names: ["", ""],
  interlaced: [false, false],
  truth: null,
  slots: [null, null],
  reel: null,
  shapes: [],
  selected: null,
  past: [],
  future: [],
  finding: null,
  camera: { focal: 320 },
  focalFrom: "",
  focalFinding: null,
  options: {},
  pace: null,
  busy: text.waits.loading,
  playing: false,
  memory: [],
  running: false,
  started: false,
  revision: 0,
  report: null,
  contours: [],
  pictures: [],
  pictured: "",
  legends: [],
  scores: null,
  timeline: null,
  visit: null,
  working: null,
  held: null,
  heldFound: null,
  scales: [],
  tool: "select",
  view: "curves",
  viewParams: {
    palette: "ember",
    motion: "flow",
    presentation: "anaglyph",
    glasses: "red-cyan",
    baseline: 0.025,
    convergence: 0.5,
    converge: true,
    swap: false,
    material: "textured",
    ghosts: true,
    compare: "flow",
    error: "error-flow",
    curvesOnTop: true,
  },
  split: null,
  ranges: FREE,
  zoom: FITTING,
  beside: false,
  showing: "first",
  lessonStep: null,
  message: null,
});
