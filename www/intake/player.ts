/**
 * A clip as the browser plays it: a hidden player is sent to the middle of each frame.
 *
 * Where nobody knows when frames are shown, they are taken to be evenly spaced, as far apart as the shortest time
 * between two while a moment of the clip is played.
 */

import { make } from "../dom";
import { clock, drawn, pngOf, queue, type Film } from "./film";

/** Until a clip that does not answer counts as one that is not played. */
const PATIENCE_MS = 8000;
/** Frames watched to learn how far apart they are. */
const WATCHED = 12;
/** Seconds between frames of a film where nothing tells. */
const USUAL = 1 / 25;

export class Player implements Film {
  private readonly inTurn = queue();

  private constructor(
    readonly name: string,
    private readonly video: HTMLVideoElement,
    private readonly times: number[],
  ) {}

  /** Opens a clip; `times` in seconds, if they are known. Rejects when the browser does not play it. */
  static async open(file: File, times?: number[]): Promise<Player> {
    const video = make("video", { muted: true, playsinline: true, preload: "auto" });
    video.muted = true;
    video.src = URL.createObjectURL(file);
    try {
      await happens(video, "loadeddata");
      if (video.videoWidth === 0) throw new Error("no picture");
      return new Player(file.name, video, times ?? (await evenly(video)));
    } catch (error) {
      letGo(video);
      throw error;
    }
  }

  get count(): number {
    return this.times.length;
  }

  label(index: number): string {
    return clock(this.times[index]! - this.times[0]!);
  }

  picture(index: number, longest: number): Promise<ImageBitmap> {
    return this.inTurn(async () => {
      const { video, times } = this;
      const next = times[index + 1] ?? times[index]! + USUAL / 2;
      await seek(video, (times[index]! + next) / 2);
      return drawn(video.videoWidth, video.videoHeight, longest, (context, width, height) =>
        context.drawImage(video, 0, 0, width, height),
      );
    });
  }

  async file(index: number) {
    return pngOf(`${this.name}, ${this.label(index)}`, await this.picture(index, Infinity));
  }

  close(): void {
    letGo(this.video);
  }
}

function letGo(video: HTMLVideoElement): void {
  URL.revokeObjectURL(video.src);
  video.removeAttribute("src");
  video.load();
}

async function seek(video: HTMLVideoElement, time: number): Promise<void> {
  const there = happens(video, "seeked");
  video.currentTime = time;
  await there;
}

function happens(video: HTMLVideoElement, event: string): Promise<void> {
  return new Promise((resolve, reject) => {
    const timer = setTimeout(() => reject(new Error("no answer")), PATIENCE_MS);
    const settle = (how: () => void) => () => {
      clearTimeout(timer);
      how();
    };
    video.addEventListener(event, settle(resolve), { once: true });
    video.addEventListener(
      "error",
      settle(() => reject(new Error("not played"))),
      { once: true },
    );
  });
}

async function evenly(video: HTMLVideoElement): Promise<number[]> {
  const gap = await shortestGap(video);
  // Clips that were recorded in one go do not say how long they are until someone looks for the end.
  if (!Number.isFinite(video.duration)) await seek(video, 1e9);
  const length = Number.isFinite(video.duration) ? video.duration : video.currentTime;
  const count = Math.max(1, Math.round(length / gap));
  return Array.from({ length: count }, (_, i) => i * gap);
}

async function shortestGap(video: HTMLVideoElement): Promise<number> {
  if (!("requestVideoFrameCallback" in video)) return USUAL;
  const shown: number[] = [];
  const watched = new Promise<void>((resolve) => {
    const note = (_: number, { mediaTime }: VideoFrameCallbackMetadata) => {
      shown.push(mediaTime);
      if (shown.length < WATCHED) video.requestVideoFrameCallback(note);
      else resolve();
    };
    video.requestVideoFrameCallback(note);
    video.addEventListener("ended", () => resolve(), { once: true });
    setTimeout(resolve, 2000);
  });
  await video.play().catch(() => {});
  await watched;
  video.pause();
  const gaps = shown.slice(1).map((time, i) => time - shown[i]!);
  const real = gaps.filter((gap) => gap > 1e-3);
  return real.length > 0 ? Math.min(...real) : USUAL;
}
