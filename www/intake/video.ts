/**
 * A clip. Its container tells when each frame is shown and by what it is encoded (mediabunny); the pictures come from
 * the browser's decoder, or from its player where it lends no decoder (`player.ts`).
 */

import type { EncodedPacketSink, Input, InputVideoTrack } from "mediabunny";

import { later } from "../text/later";
import { CODECS } from "./codecs";
import { clock, drawn, pngOf, queue, type Film } from "./film";
import { Player } from "./player";

/** Frames of a clip that are looked through: a quarter of an hour at 120 a second. */
const MOST = 108_000;

/** Opens a clip; rejects with a sentence when the browser does not play it. */
export async function openVideo(file: File, container: string): Promise<Film> {
  const { clip, codec } = await contents(file).catch(() => ({ clip: null, codec: null }));
  if (clip) return clip;
  try {
    return await Player.open(file);
  } catch {
    throw new Error(unplayable(file.name, container, codec));
  }
}

function unplayable(name: string, container: string, codec: string | null): string {
  const { encoded, unknown } = later.clips;
  return codec ? encoded(name, codec) : unknown(name, container);
}

/** The clip, where the browser decodes it, and its codec, where the container is understood. */
async function contents(file: File): Promise<{ clip: Film | null; codec: string | null }> {
  const { BlobSource, EncodedPacketSink, Input, MATROSKA, MP4, QTFF, VideoSampleSink, WEBM } =
    await import("mediabunny");
  const input = new Input({
    source: new BlobSource(file),
    formats: [MP4, QTFF, WEBM, MATROSKA],
  });
  const track = await input.getPrimaryVideoTrack();
  if (!track) return { clip: null, codec: null };
  const codec = await codecOf(track);
  const times = await timesOf(new EncodedPacketSink(track));
  if (times.length < 2) return { clip: null, codec };
  if (typeof VideoDecoder === "undefined" || !(await track.canDecode())) {
    const played = await Player.open(file, times).catch(() => null);
    return { clip: played, codec };
  }
  const sink = new VideoSampleSink(track);
  return { clip: new Clip(file.name, input, times, (time) => sink.getSample(time)), codec };
}

async function codecOf(track: InputVideoTrack): Promise<string | null> {
  const own = await track.getCodec();
  const id = own ?? (await track.getInternalCodecId());
  const name = id instanceof Uint8Array ? String.fromCharCode(...id) : id;
  return name === null ? null : (CODECS[name] ?? String(name));
}

/** When each frame is shown, in seconds from the first, in order. */
async function timesOf(sink: EncodedPacketSink): Promise<number[]> {
  const times: number[] = [];
  for await (const { timestamp } of sink.packets(undefined, undefined, { metadataOnly: true })) {
    times.push(timestamp);
    if (times.length === MOST) break;
  }
  // They are stored in the order in which they are decoded.
  return times.filter((time) => time >= 0).sort((a, b) => a - b);
}

type Sample = NonNullable<
  Awaited<ReturnType<InstanceType<typeof import("mediabunny").VideoSampleSink>["getSample"]>>
>;

/** A clip that the browser's decoder takes. */
class Clip implements Film {
  private readonly inTurn = queue();

  constructor(
    readonly name: string,
    private readonly input: Input,
    private readonly times: number[],
    private readonly sample: (time: number) => Promise<Sample | null>,
  ) {}

  get count(): number {
    return this.times.length;
  }

  label(index: number): string {
    return clock(this.times[index]! - this.times[0]!);
  }

  picture(index: number, longest: number): Promise<ImageBitmap> {
    return this.inTurn(async () => {
      const sample = await this.sample(this.times[index]!);
      if (!sample) throw new Error(later.clips.notDecoded(this.name, this.label(index)));
      const { displayWidth, displayHeight } = sample;
      try {
        return drawn(displayWidth, displayHeight, longest, (context, width, height) =>
          sample.draw(context, 0, 0, width, height),
        );
      } finally {
        sample.close();
      }
    });
  }

  async file(index: number) {
    return pngOf(`${this.name}, ${this.label(index)}`, await this.picture(index, Infinity));
  }

  close(): void {
    this.input.dispose();
  }
}
