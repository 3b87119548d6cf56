/** Frames of one's own: the panel that they come in by, and what is said of files. */

export const frames = {
  titles: ["First frame", "Second frame"] as [string, string],
  swap: "Swap the two frames",
  choose: "Choose…",
  empty: "missing",
  use: "Use them",
  discard: "Discard",
  bring:
    "Open two pictures that were taken shortly after each other. Or choose two frames of a clip, of an animation or from the camera. You can also drop or paste files.",
  missing: (which: 0 | 1, stage: string) =>
    `The ${which === 0 ? "first" : "second"} frame is still missing. Until then, ${stage ? `“${stage}”` : "the present pair"} stays open.`,
  inUse: (truth: string) =>
    `These are your frames. Draw or find a curve on each object that moves by itself. Then press Run. ${truth}`,
  interlaced: (name: string) =>
    `${name} seems to be interlaced: its even and odd rows show two moments.`,
  takeFields: "Open its two fields",
  unused: (stage: string) => `These two frames are not in use. “${stage}” is still open.`,
  truthWanted:
    "If you have ground truth for them (motion, depth or labels), drop those files, too. Then scores and error maps are shown.",
  truthFrom: (names: string) => `Ground truth: ${names}.`,
  dropMany: "Choose two frames from these",
  openingCamera: "Opening the camera",
  openingStrip: "Opening the filmstrip",
  opening: "Opening your frames",
};

export const files = {
  reading: (name: string) => `Reading ${name}`,
  readingAll: "Reading the files",
  /** For files without a name. */
  unnamed: "a picture",
  unnamedFrames: ["first frame", "second frame"] as [string, string],
  unnamedPicture: (number: number) => `picture ${number}`,
  unreadable: (name: string) =>
    `${name} cannot be read; it may be a folder, or it was moved or deleted`,
  notHere: (name: string, format: string) =>
    `${name} is ${article(format)} ${format} file, which this page cannot open; save it as JPEG, PNG or TIFF first`,
  notInBrowser: (name: string, format: string) =>
    `${name} is ${article(format)} ${format} file, which this browser cannot open; save it as JPEG, PNG or TIFF first`,
  notTakenApart: (name: string, format: string) =>
    `${name} is an animated ${format}, which this browser cannot split into frames; save two of its frames as PNG and open those`,
  alone: (name: string) => `${name} holds many frames; open it alone, without other files`,
  frame: (number: number) => `frame ${number}`,
  pictures: (count: number) => `${count} pictures`,
  notShown: (name: string) => `${name} cannot be shown`,
  view: (name: string, which: 0 | 1) => `${name}, ${which === 0 ? "first" : "second"} view`,
  twoViews: (name: string) =>
    `The two views of ${name} are opened as a pair. If nothing moved between them, no curve is needed.`,
  field: (name: string, which: 0 | 1) => `${name}, ${which === 0 ? "even" : "odd"} rows`,
  twoFields: (name: string) =>
    `The two fields of ${name} are opened as a pair, each half as wide and high.`,
  fromFilm: (film: string, first: string, second: string) =>
    `From ${film}: ${first} and ${second}.`,
  areOpen: (first: string, second: string) => `${first} and ${second} are open.`,
};

const article = (name: string) => (/^[AEIO]/.test(name) ? "an" : "a");

export const truth = {
  reading: "Reading the ground truth",
  noFrames: (names: string, stage: string) =>
    `${names}: this is ground truth for two frames of your own, but ${stage ? `“${stage}” is open` : "no frames are open"}. Open the two frames first, then their ground truth.`,
  taken: (names: string) => `Ground truth is loaded: ${names}.`,
};
