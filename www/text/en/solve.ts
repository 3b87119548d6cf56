/** A solve: how to run it, how far it is, how it ended, and its passes on the timeline. */

const passes = (count: number) => (count === 1 ? "1 pass" : `${count} passes`);

export const run = {
  run: "Run",
  again: "Run again",
  pause: "Pause",
  running: "Running.",
  backAtCurves: "Back at the drawn curves.",
  cancelled: "Cancelled; frames and curves are kept.",
  nextPair: (from: string, to: string) => `Goes on from what was found: ${from} and ${to}`,
  paces: {
    fast: "as fast as it goes",
    brisk: "brisk",
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
    exhausted: "Out of iterations",
    diverged: "Diverged",
  },
  passes,
  scale: (scale: number, of: number) => `scale ${scale}/${of}`,
};

export const progress = {
  paper: "Motion, depth and curves take a step each, in turn.",
  whole: "outlines, motion and depth",
  noCurves: "motion and depth",
  coarse: (what: string, scale: number, of: number) =>
    `Finding ${what} on small copies, scale ${scale} of ${of}.`,
  starting: "Starting.",
  full: (what: string) => `Refining ${what} at full size.`,
  aSecondLeft: "About a second left.",
  secondsLeft: (seconds: number) => `About ${seconds}\u00a0s left.`,
  minutesLeft: (minutes: number) => `About ${minutes}\u00a0min left.`,
};

/** How a run ended, for those who listen. */
export const ending = {
  converged: (count: number) => `Converged after ${count} passes.`,
  exhausted: (count: number) => `Out of iterations after ${count} passes.`,
  diverged: (count: number) => `Diverged after ${count} passes.`,
  running: (count: number) => `Paused after ${count} passes.`,
};

/** How good the result is expected to be. */
export const expected = {
  flow: (pixels: string) => `Flow is expected to be right to about ${pixels}\u00a0px.`,
  flowAndLabels: (pixels: string, share: string) =>
    `Flow is expected to be right to about ${pixels}\u00a0px, labels but for about ${share}.`,
};

/** What a pass did, and where that comes from. */
const stages = {
  planes: {
    did: "every region was taken for a plane, and its image motion fitted",
    from: "the data term of (7), by Gauss–Newton; labels by cheapest cuts",
  },
  search: {
    did: "motions in many directions were tried for each region, and the best was kept with a relief",
    from: "(7) with (1), by Gauss–Newton from each of them; labels by cheapest cuts",
  },
  selection: {
    did: "motion and relief were improved, and it was asked whether a region rests, turns, travels or does both",
    from: "(7), by Gauss–Newton, and a price for each number of a motion; labels by cheapest cuts",
  },
  surfaces: {
    did: "motion and relief of each region were improved",
    from: "(7), by Gauss–Newton; labels by cheapest cuts",
  },
  steps: {
    did: "depth was found pixel by pixel where a smooth relief fails",
    from: "ψ of (7) under every depth, neighbours kept alike",
  },
  descent: {
    did: "motions, depth and curves took a step each",
    from: "(7): T and ω by least squares, depth by (9), curves by (17)",
  },
};
type Stage = keyof typeof stages;

export const timeline = {
  back: "Back a pass",
  forth: "On a pass",
  play: "Play the passes",
  stop: "Stop playing",
  pass: "Pass",
  beat: "Time of a pass when they play",
  beats: (seconds: number) => `${seconds} s a pass`,
  goOn: "Go on",
  fromHere: "from here",
  goBackFirst: "Go back to a pass first",
  goOnTitle: "Runs on from the pass shown, with the settings as they are now, as a second line",
  goingOn: (pass: number) => `Going on from pass ${pass}.`,
  flicker: "Flicker",
  beside: "Side by side",
  besideTitle: "The reliefs of both lines under one light",
  lineShown: "Line shown",
  scale: (name: string) => `scale ${name}`,
  /** Lines by their names. */
  first: "First",
  second: "Second",
  from: (pass: number) => `From ${pass}`,
  setting: (label: string, value: string) => `${label.toLowerCase()} ${value}`,
  on: "on",
  off: "off",
  automatic: "automatic",

  start: "The start: curves as drawn, one depth everywhere, nothing moves.",
  startShort: "The start",
  place: (pass: number, of: number, energy: string) => `Pass ${pass} of ${of}. ${energy}`,
  bare: (pass: number) => `Pass ${pass}.`,
  /** Of which scale a pass was, within a sentence on it. */
  scaleOf: (scale: number, of: number) => `, scale ${scale} of ${of}`,
  did: (pass: number, scale: string, stage: Stage, changed: string) =>
    `Pass ${pass}${scale}: ${stages[stage].did}; ${changed}. From ${stages[stage].from}.`,
  takenBack: (pass: number, scale: string, stage: Stage) =>
    `Pass ${pass}${scale}: ${stages[stage].did}; that raised (7), so labels, motions and relief were put back, and the scale is done with.`,
  noSteps: (pass: number, scale: string) =>
    `Pass ${pass}${scale}: depth pixel by pixel would explain no region better, so nothing was changed. From ${stages.steps.from}.`,
  adopted: (regions: number) => (regions === 1 ? "1 region took it" : `${regions} regions took it`),
  /** `pixels` is the number as it is written. */
  changed(count: number, pixels: string): string {
    if (count === 0) return "no pixel changed sides";
    return count === 1 ? "1 pixel changed sides" : `${pixels} pixels changed sides`;
  },
  goneOn: (pass: number) => `Gone on from pass ${pass}.`,
  goneOnFromCurves: (pass: number) =>
    `Gone on from the curves of pass ${pass} alone: under these settings depth and motion start anew.`,
  notKept: (pass: number) => `(Pass ${pass} is no longer kept.)`,

  energy: (energy: string) => `E ${energy}.`,
  newSum: (energy: string) => `E ${energy}, a new sum.`,
  asBefore: (energy: string) => `E ${energy}, as before.`,
  less: (energy: string, share: string) => `E ${energy}, ${share} less than before.`,
  more: (energy: string, share: string) => `E ${energy}, ${share} more than before.`,

  /** Two lines at a pass. */
  energies: (one: string, other: string) =>
    `E is ${one} on the first line, ${other} on the second.`,
  apart: (share: string) => `Labels differ in ${share} of all pixels.`,
  differ: (options: string) => `What differs is set under ${options}.`,
  same: "The settings are the same.",
};
