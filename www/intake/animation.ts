/** An animated GIF, PNG, WebP or AVIF, taken apart by the browser. */

import { text } from "../text";
import { fitted, pngOf, queue, type Film } from "./film";
import type { Format } from "./formats";

/** Opens an animation; `null` when it has but one frame. Rejects with a sentence when the browser takes none apart. */
export async function openAnimation(file: File, { name, type }: Format): Promise<Film | null> {
  if (typeof ImageDecoder === "undefined" || !(await ImageDecoder.isTypeSupported(type))) {
    // Most GIFs do move, but this one may not.
    if (name === "GIF") return null;
    throw new Error(text.files.notTakenApart(file.name, name));
  }
  const decoder = new ImageDecoder({ data: await file.arrayBuffer(), type });
  // Only then is the number of frames known, and grows no more.
  await Promise.all([decoder.tracks.ready, decoder.completed]);
  const { selectedTrack } = decoder.tracks;
  if (!selectedTrack || selectedTrack.frameCount < 2) {
    decoder.close();
    return null;
  }
  return new Animation(file.name, decoder, selectedTrack.frameCount);
}

class Animation implements Film {
  private readonly inTurn = queue();

  constructor(
    readonly name: string,
    private readonly decoder: ImageDecoder,
    readonly count: number,
  ) {}

  label(index: number): string {
    return text.files.frame(index + 1);
  }

  picture(index: number, longest: number): Promise<ImageBitmap> {
    return this.inTurn(async () => {
      const { image } = await this.decoder.decode({ frameIndex: index });
      try {
        return fitted(image, longest);
      } finally {
        image.close();
      }
    });
  }

  async file(index: number) {
    return pngOf(`${this.name}, ${this.label(index)}`, await this.picture(index, Infinity));
  }

  close(): void {
    this.decoder.close();
  }
}
