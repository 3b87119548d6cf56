/** What concerns the whole page: waiting, errors, links, undo, lessons. */

/** What the page waits for, in the status line and before an ellipsis. */
export const waits = {
  loading: "Loading",
  rendering: "Rendering the sequence",
  nextPair: "Opening the next pair",
  kept: "Opening the pair kept on this device",
  link: "Opening the link",
  afresh: "Restarting the computation",
};

export const page = {
  isOpen: (title: string, width: number, height: number) =>
    `${title} is open, ${width} by ${height} pixels.`,
  brokeDown: (reason: string) =>
    `The computation has failed: ${reason} It was restarted. Your frames and curves are kept.`,
  notLoaded: (reason: string) =>
    `${reason} Check the connection, then try again or reload the page.`,
  workerFailed: "the worker could not be started",
  undone: "Undone.",
  redone: "Redone.",
  close: "Close",
};

export const links = {
  /** Parts of a link that cannot be used, within `useless`. */
  view: (name: string) => `a view called “${name}”`,
  curves: "its curves",
  camera: "its camera",
  options: "its options",
  params: "the settings of its view",
  scales: "its depth factors",
  split: "its two views",
  ranges: "its range of colours",
  zoom: "its zoom",
  palette: "its palette",
  useless(parts: string[]): string {
    const list = [parts.slice(0, -1).join(", "), parts.at(-1)].filter(Boolean).join(" and ");
    return `A part of the link cannot be used: ${list}. The rest is used.`;
  },
  notKept:
    "The frames of this link are not kept on this device. Open the two files, then follow the link again.",
  noSequence: (name: string) => `There is no sequence called “${name}”. The link cannot be opened.`,
  copied: "Link copied.",
  inAddress: "The link is in the address bar. Copy it from there.",
  withoutFrames: "It does not contain your frames. It works only on devices that keep them.",
};

export const lessons = {
  /** By the names of their files, in `www/lessons`. */
  titles: {
    aperture: "The aperture problem",
    rigid: "The rigid constraint",
    scale: "Why only T/Z",
    weights: "What each weight does",
    diffusion: "Smoothing with (11) or with (12)",
    start: "When the initial curves matter",
    still: "A still camera sees no depth",
    small: "Small objects and rotation",
    occlusion: "Occlusion",
    scales: "Large motion and scales",
    flow: "Rigid motion compared with Horn–Schunck",
    anaglyph: "How an anaglyph works",
  },
  heading: "Lessons",
  note: "Each step sets up the page and runs the solver. You can change everything as you like.",
  unknown: (name: string) => `There is no lesson called “${name}”. The list is under Learn.`,
  opened: (title: string, step: number, of: number) => `${title}, step ${step} of ${of}.`,
  all: "All lessons",
  steps: "Steps of the lesson",
  step: (step: number, of: number) => `Step ${step} of ${of}`,
  back: "Back",
  nextStep: "Next step",
  nextLesson: "Next lesson",
  again: "Set this step up again",
};
