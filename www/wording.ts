/** What the page says in whole sentences. */

import { number, percent } from "./format";
import type { Expected, FocalLength, Report } from "./worker/protocol";

/**
 * The core's sentences begin small and end bare, so that they fit into others. One that begins with
 * a file's name keeps it as it is.
 */
export function sentence(text: string): string {
  const whole = text.trim().replace(/^[a-z](?=[a-z]*[\s,:])/, (letter) => letter.toUpperCase());
  return /[.!?]$/.test(whole) ? whole : `${whole}.`;
}

/** How a run ended, for those who listen. */
export function ending(report: Report): string {
  const after = `after ${report.iterations} passes`;
  switch (report.status) {
    case "converged":
      return `Converged ${after}.`;
    case "exhausted":
      return `Out of iterations ${after}.`;
    case "diverged":
      return `Diverged ${after}.`;
    case "running":
      return `Paused ${after}.`;
  }
}

/** How long a run will take, coarse enough to hold; empty where it is not known. */
export function remaining(seconds: number | null): string {
  if (seconds === null) return "";
  if (seconds < 1.5) return "About a second left.";
  if (seconds < 90)
    return `About ${seconds < 10 ? Math.round(seconds) : 5 * Math.round(seconds / 5)}\u00a0s left.`;
  return `About ${Math.round(seconds / 60)}\u00a0min left.`;
}

/** How good the result is expected to be, at the scale at work. */
export function expectation({ flow, labels }: Expected): string {
  const right = `Flow is expected to be right to about ${number(flow, 1)}\u00a0px`;
  return labels > 0 ? `${right}, labels but for about ${percent(labels)}.` : `${right}.`;
}

/** What a look for the focal length came to. */
export function focalFindingOf(found: FocalLength | null): string {
  if (!found) return "These frames do not tell f: it stays.";
  const [f, least, greatest] = [found.focal, found.least, found.greatest].map(Math.round);
  return `f is about ${f}\u00a0px (${least} to ${greatest}), as far as these frames tell.`;
}

/** What a look for curves came to. */
export function findingOf(curves: number): string {
  if (curves === 0) return "One motion explains both frames: no curve is needed.";
  return curves === 1 ? "1 curve found." : `${curves} curves found.`;
}
