/**
 * Tells the page where the solver stands and what it looks at: pictures, legends, relief, scores and passes.
 *
 * Progress is sent only when the page has drawn the last one, so however fast the solver or slow the screen, there is never
 * more than one on its way. Pictures come quickly first and, when nothing happens any more, as sharp as the screen.
 */

import * as Comlink from "comlink";

import type { Engine } from "./engine";
import { takePasses } from "./passes";
import type { MeshData, PictureRequest, Progress, Wanted } from "./protocol";

/** Least time between two reliefs: a new triangulation is work for the page, milliseconds. */
const MESH_INTERVAL_MS = 400;
/** So long the page is left in peace before it gets pictures as sharp as its screen in the place of quick ones. */
const SHARPEN_MS = 250;

/** What the page looks at, with what it has of that already. */
interface Look {
  wanted: Wanted;
  /** Requests for pictures that no step changes (truth, baseline) and that were sent. */
  settled: Set<PictureRequest>;
  mesh: { iterations: number; at: number };
  /** The revision of which quick pictures were sent, and whether sharper ones are to come. */
  quick: { revision: number; blunt: boolean };
}

function begun(wanted: Wanted): Look {
  const quick = { revision: -1, blunt: false };
  return { wanted, settled: new Set(), mesh: { iterations: -1, at: -Infinity }, quick };
}

/** Whether the solver runs, and whether its passes are long. */
export interface Run {
  running: boolean;
  slow: boolean;
}

export class Teller {
  /** How the page is told. */
  send: (progress: Progress) => Promise<void> = async () => {};

  private look = begun({ id: 0, view: "", pictures: [], longest: 1, mesh: null });
  private inFlight = false;
  private stale = false;
  private sharpening: ReturnType<typeof setTimeout> | undefined;
  /** The message that is being made, and the same until the page has taken it. */
  private composed: Promise<unknown> = Promise.resolve();
  private taken: Promise<unknown> = Promise.resolve();

  constructor(
    private readonly engine: Engine,
    private readonly run: () => Run,
    private readonly failed: (error: unknown) => void,
  ) {}

  /** Where only the zoom is another, what is there is good until the sharper is. */
  lookAt(wanted: Wanted): void {
    const { look } = this;
    const same = (key: "view" | "pictures") =>
      JSON.stringify(wanted[key]) === JSON.stringify(look.wanted[key]);
    const next = begun(wanted);
    this.look = same("view") && same("pictures") ? { ...next, quick: look.quick } : next;
  }

  /** The relief is another, whatever the number of passes. */
  forgetMesh(): void {
    this.look.mesh.iterations = -1;
  }

  publish(): void {
    clearTimeout(this.sharpening);
    if (this.inFlight) {
      this.stale = true;
      return;
    }
    this.inFlight = true;
    this.stale = false;
    const made = this.progress(this.look);
    this.composed = made.catch(() => {});
    this.taken = made
      .then(({ message, transfer }) => this.send(Comlink.transfer(message, transfer)))
      .catch(this.failed)
      .finally(() => {
        this.inFlight = false;
        if (this.stale) this.publish();
        else if (this.look.quick.blunt) {
          this.sharpening = setTimeout(() => this.sharpen(), SHARPEN_MS);
        }
      });
  }

  /** Until the latest is on its way; a page that is busy is waited for `most` milliseconds. */
  async told(most: number): Promise<void> {
    const late = new Promise((resolve) => setTimeout(resolve, most));
    if (this.stale) await Promise.race([this.taken, late]);
    await this.composed;
  }

  /** Quick pictures are followed by sharp ones once there is nothing else to do. */
  private sharpen(): void {
    if (!this.run().running && !this.inFlight && this.look.quick.blunt) this.publish();
  }

  private async progress(to: Look): Promise<{ message: Progress; transfer: Transferable[] }> {
    const { engine } = this;
    const { wanted, settled } = to;
    const { revision } = engine;
    const report = engine.report();
    const contours = engine.contours();
    const quick = this.run().running || to.quick.revision !== revision;
    const transfer: Transferable[] = [];
    let mesh: Progress["mesh"] = null;
    if (wanted.mesh && this.meshIsDue(to, report.iterations)) {
      mesh = engine.mesh(wanted.mesh);
      transfer.push(...buffersOf(mesh));
      to.mesh = { iterations: report.iterations, at: performance.now() };
    }
    const scores = engine.scores();
    const pictures: (ImageBitmap | null)[] = [];
    const legends: Progress["legends"] = [];
    let blunt = false;
    for (const request of wanted.pictures) {
      const drawn = settled.has(request)
        ? null
        : await engine.picture(request, wanted.longest, quick);
      if (drawn) transfer.push(drawn.picture);
      if (drawn?.blunt) blunt = true;
      else if (request.of !== "found") settled.add(request);
      pictures.push(drawn && drawn.picture);
      legends.push(drawn && drawn.legend);
    }
    to.quick = { revision, blunt };
    const passes = await takePasses();
    transfer.push(...passes.map(({ bytes }) => bytes.buffer));
    const { running, slow } = this.run();
    return {
      message: {
        id: wanted.id,
        view: wanted.view,
        running,
        started: running || engine.started,
        revision,
        report,
        contours,
        pictures,
        legends,
        mesh,
        scores,
        passes,
        slow: running && slow,
      },
      transfer,
    };
  }

  private meshIsDue({ mesh }: Look, iterations: number): boolean {
    const rested = !this.run().running || performance.now() - mesh.at > MESH_INTERVAL_MS;
    return rested && mesh.iterations !== iterations;
  }
}

/** What a relief gives up as it goes to the page. */
export const buffersOf = (mesh: MeshData) =>
  Object.values(mesh).flatMap((list) => (typeof list === "number" ? [] : [list.buffer]));
