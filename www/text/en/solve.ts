/** A solve: how to run it, how far it is, how it ended, and its passes on the timeline. */

const passes = (count: number) => (count === 1 ? "1 pass" : `${count} passes`);

export const run = {
  run: "Run",
  again: "Run again",
  pause: "Pause",
  running: "Running.",
  backAtCurves: "Reset to the drawn curves.",
  cancelled: "Cancelled. Frames and curves are kept.",
  nextPair: (from: string, to: string) =>
    `Continue with ${from} and ${to}, from the present result`,
  paces: {
    fast: "as fast as possible",
    brisk: "fast, but visible",
    slow: "slow enough to watch",
  },
};

/** The line that says where the computation stands. */
export const status = {
  waiting: (phrase: string) => `${phrase}…`,
  ready: "Ready",
  recorded: "Recorded",
  running: "Running",
  ended: {
    running: "Paused",
    converged: "Converged",
    exhausted: "Pass limit reached",
    diverged: "Diverged",
  },
  passes,
  scale: (scale: number, of: number) => `scale ${scale}/${of}`,
};

export const progress = {
  paper: "One step each of motion, depth and curves in every pass.",
  whole: "outlines, motion and depth",
  noCurves: "motion and depth",
  coarse: (what: string, scale: number, of: number) =>
    `Estimating ${what} on reduced frames, scale ${scale} of ${of}.`,
  starting: "Starting.",
  full: (what: string) => `Refining ${what} at full size.`,
  aSecondLeft: "About a second left.",
  secondsLeft: (seconds: number) => `About ${seconds}\u00a0s left.`,
  minutesLeft: (minutes: number) => `About ${minutes}\u00a0min left.`,
};

/** How a run ended, for those who listen. */
export const ending = {
  converged: (count: number) => `Converged after ${passes(count)}.`,
  exhausted: (count: number) => `Pass limit reached after ${passes(count)}.`,
  diverged: (count: number) => `Diverged after ${passes(count)}.`,
  running: (count: number) => `Paused after ${passes(count)}.`,
};

/** How good the result is expected to be. */
export const expected = {
  flow: (pixels: string) => `Expected error of the image motion: about ${pixels}\u00a0px.`,
  flowAndLabels: (pixels: string, share: string) =>
    `Expected errors: image motion about ${pixels}\u00a0px, labels about ${share}.`,
};

/** What a pass did, and where that comes from. */
const stages = {
  planes: {
    did: "a plane was fitted to each region",
    from: "the data term of (7), by Gauss–Newton and graph cuts",
  },
  search: {
    did: "motions in many directions were tried, and the best was kept",
    from: "(7) with (1), by Gauss–Newton and graph cuts",
  },
  selection: {
    did: "motion and depth were refined, and motion models were compared",
    from: "(7) and a price per model, by Gauss–Newton and graph cuts",
  },
  surfaces: {
    did: "motion and depth were refined",
    from: "(7), by Gauss–Newton and graph cuts",
  },
  steps: {
    did: "depth was estimated pixel by pixel where a surface does not fit",
    from: "ψ, by a plane sweep and semi-global matching",
  },
  descent: {
    did: "one step each of motions, depth and curves",
    from: "(7): least squares for T and ω, (9) for depth, (17) for curves",
  },
};
type Stage = keyof typeof stages;

export const timeline = {
  back: "Previous pass",
  forth: "Next pass",
  play: "Play the passes",
  stop: "Stop playing",
  pass: "Pass",
  /** What is drawn along the timeline. */
  line: "The energy (7), pass by pass. Where the line is dashed, the energy becomes another sum: a finer scale or new weights. There the line goes on at the same height.",
  beat: "Time for each pass when playing",
  beats: (seconds: number) => `${seconds} s per pass`,
  goOn: "Go on",
  fromHere: "from here",
  goBackFirst: "Choose an earlier pass first",
  goOnTitle: "Continue from the pass shown, with the present settings, as a second line",
  goingOn: (pass: number) => `Continuing from pass ${pass}.`,
  flicker: "Flicker",
  beside: "Side by side",
  besideTitle: "Show the reliefs of both lines side by side, under the same light",
  lineShown: "Line shown",
  scale: "scale",
  /** Lines by their names. */
  first: "First",
  second: "Second",
  from: (pass: number) => `From ${pass}`,
  setting: (label: string, value: string) => `${label.toLowerCase()} ${value}`,
  on: "on",
  off: "off",
  automatic: "automatic",

  start: "Start: the curves as drawn, constant depth, no motion.",
  startShort: "Start",
  place: (pass: number, of: number, energy: string) => `Pass ${pass} of ${of}. ${energy}`,
  bare: (pass: number) => `Pass ${pass}.`,
  /** The beginning of what a pass did. */
  passDid: (pass: number) => `Pass ${pass}`,
  whole: "All on this pass",
  /** Of which scale a pass was, within a sentence on it. */
  scaleOf: (scale: number, of: number) => `, scale ${scale} of ${of}`,
  did: (stage: Stage) => `: ${stages[stage].did}.`,
  cameFrom: (stage: Stage) => `From ${stages[stage].from}.`,
  takenBack: (stage: Stage) => `: ${stages[stage].did}. This raised (7), so it was undone.`,
  finished: "The scale is finished.",
  noSteps: ": depth was estimated pixel by pixel, but explained no region better.",
  nothingChanged: "Nothing changed.",
  adopted: (regions: number) =>
    regions === 1 ? "It was adopted in 1 region." : `It was adopted in ${regions} regions.`,
  /** `pixels` is the number as it is written. */
  changed(count: number, pixels: string): string {
    if (count === 0) return "No pixel changed region.";
    return count === 1 ? "1 pixel changed region." : `${pixels} pixels changed region.`;
  },
  goneOn: (pass: number) => `Continued from pass ${pass}.`,
  goneOnFromCurves: (pass: number) =>
    `Continued from the curves of pass ${pass} only. With these settings, depth and motion start again.`,
  notKept: (pass: number) => `(Pass ${pass} is no longer kept.)`,

  energy: (energy: string) => `E ${energy}.`,
  newSum: (energy: string) => `E ${energy}, a new sum.`,
  asBefore: (energy: string) => `E ${energy}, unchanged.`,
  less: (energy: string, share: string) => `E ${energy}, ${share} lower than before.`,
  more: (energy: string, share: string) => `E ${energy}, ${share} higher than before.`,

  /** Two lines at a pass. */
  energies: (one: string, other: string) =>
    `E is ${one} on the first line, ${other} on the second.`,
  apart: (share: string) => `Labels differ in ${share} of all pixels.`,
  differ: (options: string) => `Different settings: ${options}.`,
  same: "The settings are the same.",
};
