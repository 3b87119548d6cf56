/**
 * The core's objects behind the page: one pair of frames, one solver on it.
 *
 * Nothing here knows the page or the run loop, and nothing computes: it passes on. Whatever is
 * opened or configured is built anew before the old is let go, so an error leaves things as they were.
 */

import {
  displacement,
  findCurves,
  findFocal,
  Frame,
  hornSchunck,
  Kept,
  Scene,
  Solver,
  type Baseline,
  type Picture,
} from "./core";
import type {
  Camera,
  Contour,
  Displacement,
  FocalLength,
  Found,
  Followed,
  FrameFile,
  MeshData,
  Opened,
  Part,
  PictureRequest,
  Report,
  ResultFile,
  ScoreTable,
  Setup,
  Shape,
  Source,
  Status,
  Whose,
} from "./protocol";
import { squeeze, unsqueeze } from "./keeping";

/** Longest side of a frame sent to the page; more than a screen shows only costs memory. */
const LONGEST_SIDE = 2048;
/** Shortest side of frames between which motion is measured. */
const MEASURABLE = 16;

/** Frames with more pixels are not copied while a solver is at work on them. */
const MOST_PIXELS = 4e6;

interface Owned {
  first: Frame;
  second: Frame;
  scene: Scene | null;
  /** Made when first asked for. */
  baseline: Baseline | null;
}

export class Engine {
  private owned: Owned | null = null;
  private solver: Solver | null = null;
  private setup: Setup | null = null;
  /** What was put away and is shown, until the solver gets to work. */
  private restored: { kept: Kept; found: Found } | null = null;
  /** Curves that were carried on to the next pair, where the solver still has those of the pair before to go back to. */
  private carried: Shape[] | null = null;
  /** Whether there is a result: the solver has been at work since it was made or reset, or one was restored. */
  started = false;
  /** Another number wherever what is found may be another. */
  revision = 0;

  async open(source: Source, keep: Partial<Setup>, found: Found | null): Promise<Opened> {
    const owned = take(source);
    try {
      const setup = { ...ownSetup(owned), ...keep };
      const solver = build(owned, setup);
      const frames: [ImageBitmap, ImageBitmap] = [
        await bitmap(owned.first),
        await bitmap(owned.second),
      ];
      this.letGo();
      this.owned = owned;
      this.solver = solver;
      this.setup = setup;
      this.begin();
      // Frames and settings are good without.
      if (found) await this.restore(setup, found).catch(() => {});
      const { scene } = owned;
      return {
        title: scene?.title ?? "Your own frames",
        lesson: scene?.lesson ?? "",
        width: owned.first.width,
        height: owned.first.height,
        frames,
        names: source.kind === "files" ? [source.first.name, source.second.name] : ["", ""],
        setup,
        restored: this.restored !== null,
        focalFrom: scene ? "f is the sequence's own." : "f is a guess: the frame's width.",
        truth: scene !== null,
      };
    } catch (error) {
      free(owned);
      throw error;
    }
  }

  /**
   * Brings the solver to `setup`, keeping as much of what it has found as the change allows; whether
   * anything changed at all.
   */
  configure(setup: Setup): boolean {
    const { owned, solver, setup: last } = this.present();
    const differs = (key: keyof Setup) => JSON.stringify(setup[key]) !== JSON.stringify(last[key]);
    if (differs("camera")) {
      const replacement = build(owned, setup);
      solver.free();
      this.solver = replacement;
      this.setup = setup;
      this.begin();
      return true;
    }
    const options = differs("options");
    if (options) {
      this.forget();
      const passes = this.report().iterations;
      solver.setOptions(JSON.stringify(setup.options));
      // With another way of solving all starts anew.
      if (this.report().iterations < passes) this.started = false;
      this.setup = { ...last, options: setup.options };
    }
    const shapes = differs("shapes");
    if (shapes) {
      const over = this.atEnd();
      solver.setCurves(JSON.stringify(setup.shapes));
      this.setup = setup;
      // A result is one of the curves that it was found from.
      if (over) this.reset();
      this.carried = null;
    }
    if (options || shapes) this.revision += 1;
    return options || shapes;
  }

  /** The following frame of the film: the second becomes the first. */
  async follow(file: FrameFile): Promise<Followed> {
    const { owned, solver, setup } = this.present();
    const next = Frame.decode(file.bytes, file.name);
    try {
      const frames: [ImageBitmap, ImageBitmap] = [await bitmap(owned.second), await bitmap(next)];
      // A result that was put away has no solver behind it: its curves go on where they are.
      const kept = this.restored && carriedOn(setup.shapes, this.contours());
      solver.next(next);
      this.forget();
      this.revision += 1;
      const shapes = kept ?? carriedOn(setup.shapes, this.contours());
      if (kept) solver.setCurves(JSON.stringify(kept));
      owned.first.free();
      owned.baseline?.free();
      this.owned = { first: owned.second, second: next, scene: null, baseline: null };
      this.setup = { ...setup, shapes };
      this.carried = shapes;
      return { frames, shapes };
    } catch (error) {
      next.free();
      throw error;
    }
  }

  /** Curves to start from, where something moves by itself. */
  find(camera: Camera): Shape[] {
    const { first, second } = this.present().owned;
    return JSON.parse(findCurves(first, second, JSON.stringify(camera))) as Shape[];
  }

  /** The focal length, where the frames tell it. */
  findFocal(camera: Camera): FocalLength | null {
    const { first, second } = this.present().owned;
    return JSON.parse(findFocal(first, second, JSON.stringify(camera))) as FocalLength | null;
  }

  step(part: Part): Status {
    const { solver } = this.present();
    this.forget();
    this.started = true;
    this.revision += 1;
    switch (part) {
      case "all":
        return solver.step();
      case "motion":
        solver.stepMotion();
        break;
      case "depth":
        solver.stepDepth();
        break;
      case "curves":
        solver.stepCurves();
        break;
    }
    return solver.status;
  }

  reset(): void {
    const { solver } = this.present();
    if (this.carried) solver.setCurves(JSON.stringify(this.carried));
    solver.reset();
    this.begin();
  }

  /** Whether the next step would be of a new solve. */
  atEnd(): boolean {
    return this.restored !== null || this.present().solver.status !== "running";
  }

  async keep(): Promise<Found | null> {
    const { solver } = this.present();
    if (!this.started) return null;
    if (this.restored) return this.restored.found;
    const [report, contours] = [this.report(), this.contours()];
    return {
      bytes: await squeeze(solver.keep(false) as Uint8Array<ArrayBuffer>),
      report,
      contours,
    };
  }

  /** What is found so far, for others to draw; `null` for frames so large that a copy would cost too much. */
  snapshot(): Uint8Array<ArrayBuffer> | null {
    const { owned, solver } = this.present();
    if (owned.first.width * owned.first.height > MOST_PIXELS) return null;
    return solver.keep(false) as Uint8Array<ArrayBuffer>;
  }

  async restore(setup: Setup, found: Found): Promise<void> {
    const { bytes, report, contours } = found;
    const plain = await unsqueeze(bytes);
    const { first, second } = this.present().owned;
    const kept = new Kept(first, second, plain, contours, report);
    try {
      this.configure(setup);
    } catch (error) {
      kept.free();
      throw error;
    }
    this.reset();
    this.restored = { kept, found };
    this.started = true;
  }

  /** Nothing has been found yet. */
  private begin(): void {
    this.forget();
    this.carried = null;
    this.started = false;
    this.revision += 1;
  }

  private forget(): void {
    if (!this.restored) return;
    this.restored.kept.free();
    this.restored = null;
    this.started = false;
  }

  report(): Report {
    if (this.restored) return this.restored.found.report;
    return JSON.parse(this.present().solver.report()) as Report;
  }

  contours(): Contour[] {
    if (this.restored) return this.restored.found.contours;
    return JSON.parse(this.present().solver.contours()) as Contour[];
  }

  async picture(request: PictureRequest, longest: number): Promise<ImageBitmap> {
    const picture = this.drawn(request);
    try {
      return await bitmap(picture, longest);
    } finally {
      picture.free();
    }
  }

  private drawn({ of, kind, params, compared }: PictureRequest): Picture {
    const { owned, solver } = this.present();
    const { scene } = owned;
    const given = JSON.stringify(params);
    const colours = compared && scene ? scene.sameColours(given) : given;
    if (of === "found" && compared && scene) {
      return (this.restored?.kept ?? solver).viewAligned(kind, colours, scene);
    }
    return this.drawer(of).view(kind, colours);
  }

  private drawer(of: Whose): { view(kind: string, params: string): Picture } {
    const { owned, solver } = this.present();
    switch (of) {
      case "found":
        return this.restored?.kept ?? solver;
      case "truth":
        if (!owned.scene) throw new Error("the truth of these frames is not known");
        return owned.scene;
      case "horn-schunck":
        owned.baseline ??= hornSchunck(owned.first, owned.second);
        return owned.baseline;
    }
  }

  mesh(params: Record<string, unknown>): MeshData {
    const { solver } = this.present();
    const mesh = (this.restored?.kept ?? solver).mesh(JSON.stringify(params));
    try {
      const { positions, normals, uvs, indices } = mesh;
      return { positions, normals, uvs, indices };
    } finally {
      mesh.free();
    }
  }

  /** `null` when there is no truth to compare with. */
  scores(): ScoreTable | null {
    const { owned, solver } = this.present();
    if (!owned.scene) return null;
    return JSON.parse((this.restored?.kept ?? solver).scores(owned.scene)) as ScoreTable;
  }

  files(params: Record<string, unknown>): ResultFile[] {
    const { solver } = this.present();
    return (this.restored?.kept ?? solver).files(JSON.stringify(params));
  }

  private present(): { owned: Owned; solver: Solver; setup: Setup } {
    const { owned, solver, setup } = this;
    if (!owned || !solver || !setup) {
      throw new Error("no frames are open; pick a sequence or open two frames");
    }
    return { owned, solver, setup };
  }

  private letGo(): void {
    this.forget();
    this.solver?.free();
    if (this.owned) free(this.owned);
    this.solver = null;
    this.owned = null;
  }
}

/** Decodes a file only to look at it. */
export async function preview(
  file: FrameFile,
  longest: number,
): Promise<{ width: number; height: number; picture: ImageBitmap }> {
  const frame = Frame.decode(file.bytes, file.name);
  try {
    return { width: frame.width, height: frame.height, picture: await bitmap(frame, longest) };
  } finally {
    frame.free();
  }
}

/** How far things move between two pictures; `null` when they differ in size or are too small to tell. */
export function measure(first: ImageBitmap, second: ImageBitmap): Displacement | null {
  const { width, height } = first;
  if (width !== second.width || height !== second.height) return null;
  if (Math.min(width, height) < MEASURABLE) return null;
  const canvas = new OffscreenCanvas(width, height);
  const context = canvas.getContext("2d", { willReadFrequently: true })!;
  const frame = (picture: ImageBitmap) => {
    context.drawImage(picture, 0, 0);
    const { data } = context.getImageData(0, 0, width, height);
    return Frame.fromRgba(width, height, new Uint8Array(data.buffer));
  };
  const frames = [frame(first), frame(second)] as const;
  try {
    return JSON.parse(displacement(...frames)) as Displacement;
  } finally {
    frames.forEach((one) => one.free());
  }
}

/** Each curve where its region is now, by the longest outline of that; where a region is lost, the curve stays. */
function carriedOn(shapes: Shape[], contours: Contour[]): Shape[] {
  return shapes.map((shape, k) => {
    const own = contours.filter(({ label, closed }) => label === k + 1 && closed);
    const longest = own.toSorted((a, b) => b.points.length - a.points.length)[0];
    if (!longest || longest.points.length < 6) return shape;
    const points: [number, number][] = [];
    for (let i = 0; i + 1 < longest.points.length; i += 2) {
      points.push([longest.points[i]!, longest.points[i + 1]!]);
    }
    return { kind: "polygon", points: thinned(points) };
  });
}

/** No more points than a person would care to move. */
function thinned(points: [number, number][]): [number, number][] {
  const every = Math.ceil(points.length / 64);
  const thin = points.filter((_, i) => i % every === 0);
  return thin.length < 3 ? points : thin;
}

function take(source: Source): Owned {
  if (source.kind === "scene") {
    const scene = new Scene(source.name, source.width, source.height);
    return { first: scene.first(), second: scene.second(), scene, baseline: null };
  }
  const first = Frame.decode(source.first.bytes, source.first.name);
  try {
    const second = Frame.decode(source.second.bytes, source.second.name);
    return { first, second, scene: null, baseline: null };
  } catch (error) {
    first.free();
    throw error;
  }
}

/** A sequence brings camera and curves; other frames get f = width and no curve. */
function ownSetup({ first, scene }: Owned): Setup {
  return {
    camera: scene
      ? JSON.parse(scene.cameraJson)
      : { focal: first.width, cx: (first.width - 1) / 2, cy: (first.height - 1) / 2 },
    shapes: scene ? JSON.parse(scene.shapesJson) : [],
    options: {},
  };
}

function build({ first, second }: Owned, { camera, shapes, options }: Setup): Solver {
  return new Solver(
    first,
    second,
    JSON.stringify(camera),
    JSON.stringify(shapes),
    JSON.stringify(options),
  );
}

function free({ first, second, scene, baseline }: Owned): void {
  first.free();
  second.free();
  scene?.free();
  baseline?.free();
}

/** A picture made ready to draw off the main thread, no larger than a screen can use. */
async function bitmap(picture: Picture | Frame, longest = LONGEST_SIDE): Promise<ImageBitmap> {
  const { width, height } = picture;
  const factor = Math.min(1, longest / Math.max(width, height));
  return createImageBitmap(picture.imageData(), {
    resizeWidth: Math.max(1, Math.round(width * factor)),
    resizeHeight: Math.max(1, Math.round(height * factor)),
    resizeQuality: "medium",
  });
}
