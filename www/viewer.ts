/**
 * A second worker that draws what the first has found so far, while that is in a long pass and hears nothing.
 *
 * It is there only where passes are long, opens the same frames, and is ended with the run.
 */

import { Client } from "./worker/client";
import type { Found, Progress, Setup, Source, Wanted } from "./worker/protocol";

export class Viewer {
  private readonly client: Client;
  private source: Source | null = null;
  private latest: { setup: Setup; found: Found } | null = null;
  /** What it shows at present. */
  private shown: Found | null = null;
  private asked = 0;

  /** `show` gets pictures and mesh; the rest of a progress is the solver's to tell. */
  constructor(show: (progress: Progress) => void) {
    this.client = new Client("viewer", {
      progress: async (progress) => {
        if (progress.id === this.asked && this.latest) show(progress);
        else progress.pictures.forEach((picture) => picture?.close());
      },
      // The solver draws it all the same, only later.
      failure: () => this.end(),
    });
  }

  /** Takes what was found up to now. */
  follow(source: Source, setup: Setup, found: Found): void {
    this.latest = { setup, found };
    if (this.source === source) return;
    this.source = source;
    void this.client.inTurn((service) => service.open(source, setup, null)).catch(() => this.end());
  }

  /** Draws what is looked at, if there is something to draw. */
  look(wanted: Omit<Wanted, "id">): void {
    if (!this.latest) return;
    this.asked += 1;
    const id = this.asked;
    void this.client
      .inTurn(async (service) => {
        // Only the last is wanted.
        if (id !== this.asked || !this.latest) return;
        const { setup, found } = this.latest;
        if (found === this.shown) await service.look({ ...wanted, id });
        else await service.restore(setup, found, { ...wanted, id });
        this.shown = found;
      })
      .catch(() => {});
  }

  end(): void {
    if (!this.latest) return;
    this.client.end();
    this.source = null;
    this.latest = null;
    this.shown = null;
  }
}
