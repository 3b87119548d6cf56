/**
 * The core's objects behind the page: one pair of frames, one solver on it.
 *
 * Nothing here knows the page or the run loop, and nothing computes: it passes on. Whatever is
 * opened or configured is built anew before the old is let go, so an error leaves things as they were.
 */

import {
  findCurves,
  findFocal,
  Frame,
  hornSchunck,
  Kept,
  Scene,
  Solver,
  type Baseline,
  type LensEntry,
  type Picture,
} from "./core";
import type {
  Camera,
  Contour,
  FocalLength,
  Found,
  Followed,
  FrameFile,
  Legend,
  MeshData,
  Opened,
  Part,
  PictureRequest,
  Probe,
  Report,
  ResultFile,
  ScoreTable,
  Setup,
  Shape,
  Source,
  Status,
  Whose,
} from "./protocol";
import { carriedOn } from "./carried";
import { squeeze, unsqueeze } from "./keeping";
import { bitmap } from "./pictures";

/** Frames with more pixels are drawn smaller, and are not copied while a solver is at work on them. */
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
      const frames = await framesOf(solver);
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
        focalFrom: focalFrom(owned),
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
      return { frames: await framesOf(solver), shapes };
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

  legend({ of, kind, params, compared }: PictureRequest): Legend | null {
    const { scene } = this.present().owned;
    const given = JSON.stringify(params);
    const colours = compared && scene ? scene.sameColours(given) : given;
    return JSON.parse(this.drawer(of).legend(kind, colours)) as Legend | null;
  }

  /** What is found at a pixel, if anything is. */
  probe(x: number, y: number, params: Record<string, unknown>): Probe | null {
    const { solver } = this.present();
    if (!this.started) return null;
    return JSON.parse(
      (this.restored?.kept ?? solver).probe(x, y, JSON.stringify(params)),
    ) as Probe | null;
  }

  private drawn({ of, kind, params, compared }: PictureRequest): Picture {
    const { owned, solver } = this.present();
    const { scene } = owned;
    const given = JSON.stringify({ ...params, pixels: MOST_PIXELS });
    const colours = compared && scene ? scene.sameColours(given) : given;
    if (of === "found" && compared && scene) {
      return (this.restored?.kept ?? solver).viewAligned(kind, colours, scene);
    }
    return this.drawer(of).view(kind, colours);
  }

  private drawer(of: Whose): {
    view(kind: string, params: string): Picture;
    legend(kind: string, params: string): string;
  } {
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
    const given = JSON.stringify({ ...params, pixels: MOST_PIXELS });
    const mesh = (this.restored?.kept ?? solver).mesh(given);
    try {
      const { positions, normals, uvs, colours, indices, parts } = mesh;
      return { positions, normals, uvs, colours, indices, parts };
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

/** What the photos say of their lens. */
function lensOf({ first, second }: Owned): LensEntry | null {
  return JSON.parse(first.lens()) ?? JSON.parse(second.lens());
}

function focalFrom(owned: Owned): string {
  if (owned.scene) return "f is the sequence's own.";
  const lens = lensOf(owned);
  return lens ? `f is from ${lens.text}.` : "f is a guess: the frame's width.";
}

/** The frames as they are solved and shown: stretched alike where they use few levels. */
async function framesOf(solver: Solver): Promise<[ImageBitmap, ImageBitmap]> {
  const frames = [solver.first(), solver.second()] as const;
  try {
    return [await bitmap(frames[0]), await bitmap(frames[1])];
  } finally {
    frames.forEach((frame) => frame.free());
  }
}

/** A sequence brings camera and curves; other frames get f from their EXIF data or else their width, and no curve. */
function ownSetup(owned: Owned): Setup {
  const { first, scene } = owned;
  return {
    camera: scene
      ? JSON.parse(scene.cameraJson)
      : {
          focal: lensOf(owned)?.focal ?? first.width,
          cx: (first.width - 1) / 2,
          cy: (first.height - 1) / 2,
        },
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
