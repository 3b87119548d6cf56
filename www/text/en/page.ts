/** What concerns the whole page: waiting, errors, links, undo, lessons. */

/** What the page waits for, in the status line and before an ellipsis. */
export const waits = {
  loading: "Loading",
  rendering: "Rendering the sequence",
  nextPair: "Taking up the next pair",
  kept: "Opening what was kept",
  link: "Opening the link",
  afresh: "Starting afresh",
};

export const page = {
  isOpen: (title: string, width: number, height: number) =>
    `${title} is open, ${width} by ${height} pixels.`,
  brokeDown: (reason: string) =>
    `The computation broke down (${reason}) It was started afresh; your frames and curves are kept.`,
  notLoaded: (reason: string) =>
    `${reason} Check the connection, then try again or reload the page.`,
  workerFailed: "the worker could not be started",
  undone: "Undone.",
  redone: "Done again.",
  close: "Close",
};

export const links = {
  /** Parts of a link that cannot be used, within `useless`. */
  view: (name: string) => `a view called “${name}”`,
  curves: "its curves",
  camera: "its camera",
  options: "its options",
  params: "how its view is set",
  scales: "its depth factors",
  split: "its two views",
  ranges: "its range of colours",
  zoom: "its zoom",
  palette: "its palette",
  useless(parts: string[]): string {
    const list = [parts.slice(0, -1).join(", "), parts.at(-1)].filter(Boolean).join(" and ");
    return `The link has a part that cannot be used (${list}). The rest of it holds.`;
  },
  notKept:
    "The link is to frames that are not kept on this device. Open the two files, then follow it again.",
  noSequence: (name: string) => `The link is to a sequence called “${name}”, which there is not.`,
  copied: "Link copied.",
  inAddress: "The link is in the address bar, to copy from there.",
  withoutFrames: "It does not carry your frames: it works where they are kept.",
};

export const lessons = {
  /** By the names of their files, in `www/lessons`. */
  titles: {
    aperture: "The aperture problem",
    rigid: "The rigid constraint",
    scale: "Why only T/Z",
    weights: "What each weight does",
    diffusion: "Smoothing by (11) or by (12)",
    start: "The start does not matter, until it does",
    still: "A still camera sees no depth",
    small: "Small objects and rotation",
    occlusion: "Occlusion",
    scales: "Large motion and scales",
    flow: "Depth from motion against Horn–Schunck",
    anaglyph: "How an anaglyph works",
  },
  heading: "Lessons",
  note: "Each opens on the solver itself, which you can change as you like.",
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
