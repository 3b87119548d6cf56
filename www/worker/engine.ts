/**
 * The core's objects behind the page: one pair of frames, one solver on it.
 *
 * Nothing here knows the page or the run loop, and nothing computes: it passes on. Whatever is
 * opened or configured is built anew before the old is let go, so an error leaves things as they were.
 */

import { text } from "../text/worker";
import { decode, findCurves, findFocal, Kept, type Solver } from "./core";
import { carriedOn } from "./carried";
import { drawn, legendOf } from "./drawing";
import { squeeze, unsqueeze } from "./keeping";
import {
  build,
  focalFrom,
  framesOf,
  free,
  known,
  ownSetup,
  scoresOf,
  setTruth,
  take,
  type Owned,
  interlacedOf,
} from "./owned";
import { bitmap } from "./pictures";
import { FILE_PIXELS, MESH_PIXELS, sizeOf } from "./size";
import { goOnFrom } from "./standing";
import type {
  Begun,
  Camera,
  Contour,
  FocalLength,
  Found,
  Followed,
  FrameFile,
  KnownParts,
  Legend,
  MeshData,
  Opened,
  Origin,
  Part,
  PictureRequest,
  Probe,
  Report,
  ScoreTable,
  Setup,
  Shape,
  Source,
  Status,
  Standing,
} from "./protocol";

interface Drawing {
  picture: ImageBitmap;
  legend: Legend | null;
  blunt: boolean;
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
  /** Another number for every solve that begins, and where it went on from, if it did. */
  solve = 0;
  origin: Origin | null = null;

  async open(source: Source, keep: Partial<Setup>, found: Found | null): Promise<Opened> {
    const owned = await take(source);
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
        title: scene?.title ?? text.own,
        lesson: scene?.lesson ?? "",
        width: owned.first.width,
        height: owned.first.height,
        frames,
        names: source.kind === "files" ? [source.first.name, source.second.name] : ["", ""],
        interlaced: source.kind === "files" ? interlacedOf(owned) : [false, false],
        setup,
        restored: this.restored !== null,
        focalFrom: focalFrom(owned),
        truth: known(owned),
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
      if (this.report().iterations < passes) {
        this.started = false;
        this.solve += 1;
        this.origin = null;
      }
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
    const next = await decode(file);
    try {
      // A result that was put away has no solver behind it: its curves go on where they are.
      const kept = this.restored && carriedOn(setup.shapes, this.contours());
      solver.next(next);
      this.forget();
      this.revision += 1;
      this.solve += 1;
      this.origin = null;
      const shapes = kept ?? carriedOn(setup.shapes, this.contours());
      if (kept) solver.setCurves(JSON.stringify(kept));
      owned.first.free();
      owned.scene?.free();
      owned.truth?.free();
      owned.baseline?.free();
      const none = { scene: null, truth: null, baseline: null };
      this.owned = { first: owned.second, second: next, ...none };
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

  /** Where the solver stands, to be put away. */
  standing(): { setup: Setup; plain: Uint8Array<ArrayBuffer> } {
    const { solver, setup } = this.present();
    return { setup, plain: solver.state() as Uint8Array<ArrayBuffer> };
  }

  /** Stands where another solver on these frames stood. */
  async visit({ setup, bytes }: Standing): Promise<void> {
    const plain = bytes.length > 0 ? await unsqueeze(bytes) : null;
    this.configure(setup);
    if (!plain) return this.reset();
    this.forget();
    this.present().solver.setState(plain);
    this.started = true;
    this.revision += 1;
  }

  /** Goes on under `setup` from where a solver stood after pass `at`. */
  async goOn(standing: Standing, at: number, setup: Setup): Promise<Begun> {
    const { solver, whole, shapes } = await goOnFrom(this.present().owned, standing, setup);
    this.present().solver.free();
    this.solver = solver;
    this.setup = { ...setup, shapes };
    this.begin();
    this.origin = { at, whole };
    this.started = true;
    return { whole, shapes };
  }

  /** The share of pixels that have other labels where two solvers stood; it stands where the second did. */
  async apart(one: Standing, other: Standing): Promise<number> {
    await this.visit(one);
    const labels = this.present().solver.labels();
    await this.visit(other);
    return this.present().solver.labelsApart(labels);
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
    this.solve += 1;
    this.origin = null;
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

  /** A picture with its legend, and whether it is a `quick` one that a screen could show sharper. */
  async picture(request: PictureRequest, longest: number, quick: boolean): Promise<Drawing> {
    const { owned } = this.present();
    const { pixels, blunt } = sizeOf(owned.first, request.kind, longest, quick);
    const picture = drawn(owned, this.shown(), request, pixels);
    try {
      const legend = legendOf(owned, this.shown(), request, pixels);
      return { picture: await bitmap(picture, longest), legend, blunt };
    } finally {
      picture.free();
    }
  }

  /** Takes what is true of the frames from files; on an error all stays. */
  setTruth(files: FrameFile[]): KnownParts {
    const { owned } = this.present();
    setTruth(owned, files);
    return known(owned)!;
  }

  /** What is found at a pixel, if anything is. */
  probe(x: number, y: number, params: Record<string, unknown>): Probe | null {
    const { solver } = this.present();
    if (!this.started) return null;
    return JSON.parse(
      (this.restored?.kept ?? solver).probe(x, y, JSON.stringify(params)),
    ) as Probe | null;
  }

  /** What is shown: the solver's, or what was put away. */
  private shown(): Solver | Kept {
    return this.restored?.kept ?? this.present().solver;
  }

  mesh(params: Record<string, unknown>): MeshData {
    const { solver } = this.present();
    const given = JSON.stringify({ ...params, pixels: MESH_PIXELS });
    const mesh = (this.restored?.kept ?? solver).mesh(given);
    try {
      const { positions, normals, uvs, colours, indices, parts, deepened } = mesh;
      return { positions, normals, uvs, colours, indices, parts, deepened };
    } finally {
      mesh.free();
    }
  }

  /** `null` when there is no truth to compare with. */
  scores(): ScoreTable | null {
    return scoresOf(this.present().owned, this.shown());
  }

  file(name: string, params: Record<string, unknown>): Uint8Array<ArrayBuffer> {
    const { solver } = this.present();
    const given = JSON.stringify({ ...params, pixels: FILE_PIXELS });
    return (this.restored?.kept ?? solver).file(name, given);
  }

  /** A picture at the frame's size. */
  png(request: PictureRequest): Uint8Array<ArrayBuffer> {
    const picture = drawn(this.present().owned, this.shown(), request, null);
    try {
      return picture.png();
    } finally {
      picture.free();
    }
  }

  private present(): { owned: Owned; solver: Solver; setup: Setup } {
    const { owned, solver, setup } = this;
    if (!owned || !solver || !setup) {
      throw new Error(text.noFrames);
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
