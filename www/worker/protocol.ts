/**
 * What page and worker say to each other, typed once.
 *
 * Coordinates are pixels, (0, 0) the centre of the top-left pixel. The words are the core's own, and so are the
 * types of what it takes and gives: they are made from its source.
 */

import type {
  Camera,
  Choice,
  Contour,
  Displacement,
  KnownParts,
  Legend,
  Limits,
  OptionEntry,
  Options,
  PresetEntry,
  Probe,
  Report,
  SceneEntry,
  ScoreTable,
  Shape,
  View,
} from "../../pkg/relievo.js";

export type {
  Camera,
  Choice,
  Contour,
  Displacement,
  Expected,
  KnownParts,
  Legend,
  OptionEntry,
  PresetEntry,
  PartScores,
  Probe,
  RegionReport,
  Report,
  ScoreTable,
  Shape,
  Status,
} from "../../pkg/relievo.js";

export type Point = [number, number];

/** A focal length that was found, and the ends of its range, in pixels. */
export interface FocalLength {
  focal: number;
  least: number;
  greatest: number;
}

/** Only what differs from the preset; `null` means "chosen from the data". */
export type OptionValues = Partial<Options>;

/** Everything a solver is made from, apart from the frames. */
export interface Setup {
  camera: Camera;
  shapes: Shape[];
  options: OptionValues;
}

/** What was found, put away: enough to show it again without the solver that found it. */
export interface Found {
  /** The core's own, as a rule compressed (`keeping.ts`). */
  bytes: Uint8Array<ArrayBuffer>;
  report: Report;
  contours: Contour[];
}

/** Where a solver stood after a pass: enough to look at it again, and to go on from there. */
export interface Standing {
  setup: Setup;
  /** The core's own, compressed; none at the start. */
  bytes: Uint8Array<ArrayBuffer>;
}

/** Where a solve went on from. */
export interface Origin {
  /** The pass, as the timeline counts. */
  at: number;
  /** Whether with all that was found, or with the curves alone. */
  whole: boolean;
}

/** How a solve went on, and the curves that it goes back to. */
export interface Begun {
  whole: boolean;
  shapes: Shape[];
}

/** A pass that was made. */
export interface Pass extends Standing {
  /** Of which solve: unlike that of any other, in whichever worker. */
  solve: string;
  origin: Origin | null;
  /** What the solver told, but for its history. */
  report: Report;
  /** Total energy after it, and after how many passes energy became another sum. */
  energy: number;
  breaks: number[];
}

/** A file as it came from disk, drop or clipboard. */
export interface FrameFile {
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
}

/** A frame that is only looked at. */
export interface Preview {
  width: number;
  height: number;
  picture: ImageBitmap;
  /** Even and odd rows seem to show different moments. */
  interlaced: boolean;
}

/** Where two frames come from; enough to open them again after the worker was restarted. */
export type Source =
  | { kind: "scene"; name: string; width: number; height: number }
  | {
      kind: "files";
      first: FrameFile;
      second: FrameFile;
      /** A sentence that says what they are, where that is not plain from their names. */
      note?: string;
      /** What is true of them, as far as somebody knows. */
      truth?: FrameFile[];
    };

/** A pair that has been opened and found good. */
export interface Opened {
  title: string;
  /** What the sequence teaches; empty for frames of the user's own. */
  lesson: string;
  width: number;
  height: number;
  frames: [ImageBitmap, ImageBitmap];
  names: [string, string];
  /** Even and odd rows of a frame seem to show different moments. */
  interlaced: [boolean, boolean];
  setup: Setup;
  /** Whether a result that came with it is shown. */
  restored: boolean;
  /** A sentence: where the setup's focal length comes from. */
  focalFrom: string;
  /** What is known to be true of them, if anything is, so that scores can be given. */
  truth: KnownParts | null;
}

export type Part = "all" | "motion" | "depth" | "curves";

/** The following pair of a film, as it was taken up. */
export interface Followed {
  frames: [ImageBitmap, ImageBitmap];
  /** The curves where they were carried to: those that the solver goes back to. */
  shapes: Shape[];
}

/** Whose picture: the solver's, the truth's, or the baseline's. */
export type Whose = "found" | "truth" | "horn-schunck";

export interface PictureRequest {
  of: Whose;
  /** In the truth's colours, and each region's depth in the truth's unit. */
  compared: boolean;
  kind: string;
  params: Record<string, unknown>;
}

/** What the page is looking at, and so what progress carries. */
export interface Wanted {
  /** Comes back with the progress that answers it, so that late answers to old questions are known. */
  id: number;
  /** The page's name for it, sent back likewise. */
  view: string;
  pictures: PictureRequest[];
  /** Longest side of a picture that the screen can use, in pixels; larger ones are made smaller. */
  longest: number;
  mesh: Record<string, unknown> | null;
}

/** A triangulated relief: x right, y up, z towards the viewer, in a box of about unit size. */
export interface MeshData {
  positions: Float32Array<ArrayBuffer>;
  normals: Float32Array<ArrayBuffer>;
  uvs: Float32Array<ArrayBuffer>;
  /** sRGB, three bytes. */
  colours: Uint8Array<ArrayBuffer>;
  indices: Uint32Array<ArrayBuffer>;
  /** How many indices are of what is seen, of what goes on hidden behind it, and of what is of unknown depth. */
  parts: Uint32Array<ArrayBuffer>;
  /** The factor that depth is multiplied by. */
  deepened: number;
}

/** What the worker sends; the next is sent only once the page has drawn this one. */
export interface Progress {
  /** Of the `Wanted` it answers. */
  id: number;
  view: string;
  running: boolean;
  /** Whether the solver has been at work since it was made or reset. */
  started: boolean;
  /** Another number wherever what is found may be another. */
  revision: number;
  report: Report;
  contours: Contour[];
  /** One per requested picture; `null` where the last one sent is still right. */
  pictures: (ImageBitmap | null)[];
  /** What the colours of each stand for; `null` where they are no measure, or the last one sent is still right. */
  legends: (Legend | null)[];
  mesh: MeshData | null;
  scores: ScoreTable | null;
  /** Passes made since the last progress. */
  passes: Pass[];
  /** Whether passes take so long that a view should not wait for the next. */
  slow: boolean;
}

/** Something went wrong while nobody was waiting for an answer. */
export interface Failure {
  message: string;
  /** The core is broken and the worker must be restarted. */
  panic: boolean;
}

/** What the core offers, read once at the start. */
export interface Catalogues {
  options: OptionEntry[];
  presets: PresetEntry[];
  scenes: SceneEntry[];
  /** What the core can draw. */
  views: View[];
  /** Colours of depth. */
  palettes: Choice[];
  /** Glasses for the anaglyph. */
  glasses: Choice[];
  /** By what each of them is served, with its source. */
  methods: string[];
  /** Ways to lay out a stereo pair. */
  layouts: Choice[];
  limits: Limits;
  /** One CSS colour per label. */
  colours: string[];
}

/** The worker's side, as the page calls it. */
export interface Service {
  catalogues(): Promise<Catalogues>;
  subscribe(
    progress: (progress: Progress) => Promise<void>,
    failure: (failure: Failure) => void,
  ): Promise<void>;
  /** Decodes one file; throws a sentence when it is no image. The picture's longer side is `longest` at most. */
  preview(file: FrameFile, longest: number): Promise<Preview>;
  /** The two fields of an interlaced frame, even rows first, as PNG files half as wide and high. */
  fields(file: FrameFile): Promise<Uint8Array<ArrayBuffer>[]>;
  /** What these files have of a truth, as somebody `said` or not; `null` for one that has nothing, as a frame. */
  truthKinds(files: FrameFile[], said: boolean): Promise<(string | null)[]>;
  /** Takes what is true of the open pair; throws a sentence, and all stays, where it is not of that. */
  setTruth(files: FrameFile[]): Promise<KnownParts>;
  /** The views that a JPEG or MPO file holds, each as a file of its own; a photo is the only one. */
  views(bytes: Uint8Array): Promise<Uint8Array<ArrayBuffer>[]>;
  /** How far things move between two frames, shown small; `null` when they differ in size or are too small. */
  displacement(first: ImageBitmap, second: ImageBitmap): Promise<Displacement | null>;
  /** Opens a pair; on any error the one open before stays. `keep` overrides the source's own setup, as far as it goes; `found` is shown with it. */
  open(source: Source, keep: Partial<Setup>, found: Found | null): Promise<Opened>;
  /** What has been found, to be put away; `null` when nothing has. */
  keep(): Promise<Found | null>;
  /** Shows what was put away. The solver is set up likewise, and starts afresh when it is told to work. */
  restore(setup: Setup, found: Found, wanted: Wanted): Promise<void>;
  /** Shows where a solver stood. */
  visit(standing: Standing, wanted: Wanted): Promise<void>;
  /** The share of pixels that have other labels. */
  apart(one: Standing, other: Standing): Promise<number>;
  /** Runs on from where a solver stood after pass `at`, under `setup`; the curves alone go along where that needs it. */
  goOn(standing: Standing, at: number, setup: Setup, wanted: Wanted, pace: number): Promise<Begun>;
  /**
   * Takes the following frame of a film: the second becomes the first, and what was found is the first guess. On any
   * error all stays.
   */
  follow(next: FrameFile): Promise<Followed>;
  /** Curves to start from; none where one motion explains both frames. The solver stays as it is. */
  find(camera: Camera): Promise<Shape[]>;
  /** The focal length, where the frames tell that it is not `camera`'s. The solver stays as it is. */
  findFocal(camera: Camera): Promise<FocalLength | null>;
  configure(setup: Setup): Promise<void>;
  look(wanted: Wanted): Promise<void>;
  /**
   * Runs on, or afresh when it had come to an end; a pass takes at least `pace` milliseconds. Like `step` and
   * `reset` it takes a `look` along.
   */
  run(setup: Setup, wanted: Wanted, pace: number): Promise<void>;
  /** What is found at a pixel; `null` outside the frame, and until there is something. */
  probe(x: number, y: number, params: Record<string, unknown>): Promise<Probe | null>;
  /** The relief of what is found, with the parameters of a view. */
  mesh(params: Record<string, unknown>): Promise<MeshData>;
  /** Another least time for a pass, while it runs. */
  pace(milliseconds: number): Promise<void>;
  pause(): Promise<void>;
  step(setup: Setup, part: Part, wanted: Wanted): Promise<void>;
  /** Back to the drawn curves; without a setup, to those it has. */
  reset(setup: Setup | null, wanted: Wanted): Promise<void>;
  /** One file of what was found, by the core's name. */
  file(name: string, params: Record<string, unknown>): Promise<Uint8Array<ArrayBuffer>>;
  /** A picture at the frame's size, as PNG. */
  png(request: PictureRequest): Promise<Uint8Array<ArrayBuffer>>;
}
