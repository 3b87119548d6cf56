/** Sentences made of the core's words and of numbers; the words themselves are in `text/`. */

import { number, percent } from "./format";
import { text } from "./text";
import type { Expected, FocalLength } from "./worker/protocol";

/**
 * The core's sentences begin small and end bare, so that they fit into others. One that begins with
 * a file's name keeps it as it is.
 */
export function sentence(text: string): string {
  const whole = text.trim().replace(/^[a-z](?=[a-z]*[\s,:])/, (letter) => letter.toUpperCase());
  return /[.!?]$/.test(whole) ? whole : `${whole}.`;
}

/** How long a run will take, coarse enough to hold; empty where it is not known. */
export function remaining(seconds: number | null): string {
  const { progress } = text;
  if (seconds === null) return "";
  if (seconds < 1.5) return progress.aSecondLeft;
  if (seconds >= 90) return progress.minutesLeft(Math.round(seconds / 60));
  return progress.secondsLeft(seconds < 10 ? Math.round(seconds) : 5 * Math.round(seconds / 5));
}

/** How good the result is expected to be, at the scale at work. */
export function expectation({ flow, labels }: Expected): string {
  const pixels = number(flow, 1);
  return labels > 0
    ? text.expected.flowAndLabels(pixels, percent(labels))
    : text.expected.flow(pixels);
}

/** What a look for the focal length came to. */
export function focalFindingOf(found: FocalLength | null): string {
  if (!found) return text.camera.notFound;
  const { focal, least, greatest } = found;
  return text.camera.found(Math.round(focal), Math.round(least), Math.round(greatest));
}
