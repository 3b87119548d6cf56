/**
 * A second worker that draws passes which are not where the solver stands, or which that cannot draw because it is in a
 * long pass and hears nothing.
 *
 * It is there only where one is asked for, opens the same frames, and is ended when it has had nothing to do for a while.
 * However many passes are asked for, one is drawn at a time, and next the one that was asked for last.
 */

import { Client } from "./worker/client";
import type { Progress, Setup, Source, Standing, Wanted } from "./worker/protocol";

/** After so long without work it is ended: frames take memory. */
const IDLE_MS = 120_000;

const NOTHING: Wanted = { id: -1, view: "", pictures: [], longest: 1, mesh: null };

interface Sight {
  source: Source;
  standing: Standing;
  wanted: Omit<Wanted, "id">;
  done: (progress: Progress | null) => void;
}

export class Viewer {
  private readonly client: Client;
  private source: Source | null = null;
  private standing: Standing | null = null;
  private next: Sight | null = null;
  private working = false;
  private asked = 0;
  private answered = 0;
  private answer: (progress: Progress | null) => void = () => {};
  private idle: ReturnType<typeof setTimeout> | undefined;

  /** `failed` hears why something could not be drawn, and `sharper` of sharper pictures of what was drawn last. */
  constructor(
    private readonly failed: (message: string) => void,
    private readonly sharper: (progress: Progress) => void,
  ) {
    this.client = new Client("viewer", {
      progress: async (progress) => {
        if (progress.id !== this.asked) progress.pictures.forEach((picture) => picture?.close());
        else if (this.answered === this.asked) this.sharper(progress);
        else {
          this.answered = this.asked;
          this.answer(progress);
        }
      },
      failure: () => this.end(),
    });
  }

  /** What is looked at of a pass; `null` when another was asked for meanwhile, or it cannot be drawn. */
  show(source: Source, standing: Standing, wanted: Omit<Wanted, "id">): Promise<Progress | null> {
    this.next?.done(null);
    return new Promise((done) => {
      this.next = { source, standing, wanted, done };
      if (!this.working) void this.work();
    });
  }

  /** Opens frames of which a pass will be asked for. */
  async warm(source: Source, setup: Setup): Promise<void> {
    // Whoever asks for a pass is told what is wrong.
    await this.alone(() => this.open(source, setup)).catch(() => {});
    if (!this.working) this.rest();
  }

  /** Any other question about a pass; one that `moves` leaves it standing elsewhere. */
  async ask<T>(
    source: Source,
    standing: Standing,
    use: Parameters<typeof this.client.call<T>>[0],
    moves = false,
  ): Promise<T> {
    return this.alone(async () => {
      await this.open(source, standing.setup);
      if (!moves && standing !== this.standing) {
        await this.client.call((service) => service.visit(standing, NOTHING));
      }
      this.standing = moves ? null : standing;
      return this.client.call(use);
    });
  }

  end(): void {
    clearTimeout(this.idle);
    this.client.end();
    this.source = null;
    this.standing = null;
    this.answer(null);
  }

  private async work(): Promise<void> {
    clearTimeout(this.idle);
    this.working = true;
    while (this.next) {
      const sight = this.next;
      this.next = null;
      sight.done(await this.draw(sight).catch((error: Error) => this.refused(error)));
    }
    this.working = false;
    this.rest();
  }

  private rest(): void {
    clearTimeout(this.idle);
    this.idle = setTimeout(() => this.end(), IDLE_MS);
  }

  private async draw({ source, standing, wanted }: Sight): Promise<Progress | null> {
    this.asked += 1;
    const id = this.asked;
    return this.alone(async () => {
      await this.open(source, standing.setup);
      const drawn = new Promise<Progress | null>((answer) => (this.answer = answer));
      await this.client.call((service) =>
        standing === this.standing
          ? service.look({ ...wanted, id })
          : service.visit(standing, { ...wanted, id }),
      );
      this.standing = standing;
      return drawn;
    });
  }

  private turn: Promise<unknown> = Promise.resolve();

  /** One thing at a time: what is drawn must not move meanwhile. */
  private alone<T>(use: () => Promise<T>): Promise<T> {
    const mine = this.turn.then(use);
    this.turn = mine.catch(() => {});
    return mine;
  }

  private async open(source: Source, setup: Setup): Promise<void> {
    if (this.source === source) return;
    await this.client.call((service) => service.open(source, setup, null));
    this.source = source;
    this.standing = null;
  }

  private refused({ name, message }: Error): null {
    // Whoever ended it may have put up another.
    if (name === "Ended") return null;
    this.failed(message);
    this.end();
    return null;
  }
}
