/**
 * What page and worker say to each other, typed once.
 *
 * Coordinates are pixels, (0, 0) the centre of the top-left pixel. The words are the core's own:
 * what crosses here is what the core takes and gives, plus pictures ready to draw.
 */

/** A curve as drawn. */
export type Shape =
  { kind: "circle"; x: number; y: number; r: number } | { kind: "polygon"; points: Point[] };

export type Point = [number, number];

export interface Camera {
  /** Focal length in pixels. */
  focal: number;
  /** Principal point; absent means the centre of the frame. */
  cx?: number;
  cy?: number;
}

/** A focal length that was found, and the ends of its range, in pixels. */
export interface FocalLength {
  focal: number;
  least: number;
  greatest: number;
}

/** Only what differs from the preset; `null` means "chosen from the data". */
export type OptionValues = Record<string, number | string | boolean | null>;

/** Everything a solver is made from, apart from the frames. */
export interface Setup {
  camera: Camera;
  shapes: Shape[];
  options: OptionValues;
}

/** A file as it came from disk, drop or clipboard. */
export interface FrameFile {
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
}

/** Where two frames come from; enough to open them again after the worker was restarted. */
export type Source =
  | { kind: "scene"; name: string; width: number; height: number }
  | { kind: "files"; first: FrameFile; second: FrameFile };

/** A pair that has been opened and found good. */
export interface Opened {
  title: string;
  /** What the sequence teaches; empty for frames of the user's own. */
  lesson: string;
  width: number;
  height: number;
  frames: [ImageBitmap, ImageBitmap];
  names: [string, string];
  setup: Setup;
  /** Whether labels, depth and motion are known, so that scores can be given. */
  truth: boolean;
}

export type Status = "running" | "converged" | "exhausted" | "diverged";
export type Part = "all" | "motion" | "depth" | "curves";

export interface Region {
  label: number;
  pixels: number;
  share: number;
  translation: [number, number, number];
  rotation: [number, number, number];
  /** Which of still, rotation, translation, full explains the region. */
  kind: string;
  /** Labels of the regions that it hides a part of. */
  in_front_of: number[];
}

export interface Report {
  iterations: number;
  status: Status;
  level: number;
  levels: number;
  /** Depth is not looked for yet. */
  flat: boolean;
  energy: { data: number; smoothness: number; length: number; total: number };
  history: number[];
  /** Passes that had been made when each finer scale was reached. */
  refined: number[];
  /** Passes that had been made each time that curves had settled. */
  settled: number[];
  /** Passes that had been made each time that motions had come to rest. */
  rested: number[];
  regions: Region[];
  /** The weights in use, those chosen from the data included. */
  weights: Record<string, number>;
  warnings: string[];
  seconds: { total: number; motion: number; depth: number; curves: number };
}

export interface Contour {
  label: number;
  closed: boolean;
  /** x, y, x, y, … */
  points: number[];
}

/** Whose picture: the solver's, the truth's, or the baseline's. */
export type Whose = "found" | "truth" | "horn-schunck";

export interface PictureRequest {
  of: Whose;
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
  indices: Uint32Array<ArrayBuffer>;
}

/** Distances from the truth; lists have an entry for each true region, `null` where nothing compares. */
export interface Scores {
  /** Mean error of the flow, px. */
  aee: number | null;
  /** Mean angular error of the flow, degrees. */
  aae: number | null;
  labels_wrong: number;
  iou: (number | null)[];
  /** Relative, in the region's own scale. */
  depth_error: (number | null)[];
  /** What a constant depth would score. */
  flat_depth_error: (number | null)[];
  /** Degrees. */
  translation_angle: (number | null)[];
  /** Radians per frame. */
  rotation_error: (number | null)[];
}

/** The baseline knows the flow only. */
export type BaselineScores = Pick<Scores, "aee" | "aae">;

export interface ScoreTable {
  found: Scores;
  baseline: BaselineScores;
}

/** What the worker sends; the next is sent only once the page has drawn this one. */
export interface Progress {
  /** Of the `Wanted` it answers. */
  id: number;
  view: string;
  running: boolean;
  /** Whether the solver has been at work since it was made or reset. */
  started: boolean;
  report: Report;
  contours: Contour[];
  /** One per requested picture; `null` where the last one sent is still right. */
  pictures: (ImageBitmap | null)[];
  mesh: MeshData | null;
  scores: ScoreTable | null;
}

/** Something went wrong while nobody was waiting for an answer. */
export interface Failure {
  message: string;
  /** The core is broken and the worker must be restarted. */
  panic: boolean;
}

export interface OptionDescriptor {
  key: string;
  label: string;
  meaning: string;
  /** The term of the functional (7) it scales; may be empty. */
  term: string;
  unit: string;
  kind: "number" | "integer" | "choice" | "toggle";
  /** Numbers and integers: their range. */
  min?: number;
  max?: number;
  /** `null` stands for "chosen from the data". */
  automatic?: boolean;
  logarithmic?: boolean;
  choices?: Choice[];
  /** By preset. */
  defaults: Record<string, number | string | boolean | null>;
}

/** One of several things to choose from. */
export interface Choice {
  value: string;
  label: string;
}

export interface SceneDescriptor {
  name: string;
  title: string;
  lesson: string;
}

/** What the core offers, read once at the start. */
export interface Catalogues {
  options: OptionDescriptor[];
  presets: Choice[];
  scenes: SceneDescriptor[];
  /** What the core can draw. */
  views: { kind: string; title: string; meaning: string }[];
  /** Colours of depth. */
  palettes: Choice[];
  /** Glasses for the anaglyph. */
  glasses: Choice[];
  limits: { minSide: number; maxSide: number; maxCurves: number };
  /** One CSS colour per label. */
  colours: string[];
}

export interface ResultFile {
  name: string;
  bytes: Uint8Array<ArrayBuffer>;
}

/** The worker's side, as the page calls it. */
export interface Service {
  catalogues(): Promise<Catalogues>;
  subscribe(
    progress: (progress: Progress) => Promise<void>,
    failure: (failure: Failure) => void,
  ): Promise<void>;
  /** Decodes one file; throws a sentence when it is no image. */
  preview(file: FrameFile): Promise<{ width: number; height: number; picture: ImageBitmap }>;
  /** Opens a pair; on any error the one open before stays. `keep` overrides the source's own setup. */
  open(source: Source, keep: Setup | null): Promise<Opened>;
  /** Curves to start from; none where one motion explains both frames. The solver stays as it is. */
  find(camera: Camera): Promise<Shape[]>;
  /** The focal length, where the frames tell that it is not `camera`'s. The solver stays as it is. */
  findFocal(camera: Camera): Promise<FocalLength | null>;
  configure(setup: Setup): Promise<void>;
  look(wanted: Wanted): Promise<void>;
  /** Runs on, or afresh when it had come to an end. Like `step` and `reset` it takes a `look` along. */
  run(setup: Setup, wanted: Wanted): Promise<void>;
  pause(): Promise<void>;
  step(setup: Setup, part: Part, wanted: Wanted): Promise<void>;
  /** Back to the drawn curves; without a setup, to those it has. */
  reset(setup: Setup | null, wanted: Wanted): Promise<void>;
  files(params: Record<string, unknown>): Promise<ResultFile[]>;
}
