/** Frames of one's own: the panel that they come in by, and what is said of files. */

export const frames = {
  titles: ["First frame", "Second frame"] as [string, string],
  swap: "Swap the two frames",
  choose: "Choose…",
  empty: "missing",
  use: "Use them",
  discard: "Discard",
  bring:
    "Bring your own: two pictures taken shortly after each other, or a clip, an animation or the camera to choose them from. Choose, drop or paste.",
  missing: (which: 0 | 1, stage: string) =>
    `The ${which === 0 ? "first" : "second"} frame is still missing. Until it is there, the stage keeps ${stage || "what it shows"}.`,
  inUse: (truth: string) =>
    `These are your frames. Draw or find a curve on each thing that moves by itself, then run. ${truth}`,
  unused: (stage: string) => `These two are not in use; the stage keeps ${stage}.`,
  truthWanted:
    "If their true motion, depth or labels are known, drop those files, too: scores and maps of errors follow.",
  truthFrom: (names: string) => `The truth comes from ${names}.`,
  dropMany: "Choose two frames of these",
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
    `${name} cannot be read; it may be a folder, or have been moved or deleted`,
  notHere: (name: string, format: string) =>
    `${name} is ${article(format)} ${format} file, which is not opened here; save it as JPEG, PNG or TIFF first`,
  notInBrowser: (name: string, format: string) =>
    `${name} is ${article(format)} ${format} file, which this browser does not open; save it as JPEG, PNG or TIFF first`,
  notTakenApart: (name: string, format: string) =>
    `${name} is an animated ${format}, which this browser does not take apart; save two of its frames as PNG and open those`,
  alone: (name: string) =>
    `${name} holds many frames by itself; open it alone, without other files`,
  frame: (number: number) => `frame ${number}`,
  pictures: (count: number) => `${count} pictures`,
  notShown: (name: string) => `${name} cannot be shown`,
  view: (name: string, which: 0 | 1) => `${name}, ${which === 0 ? "first" : "second"} view`,
  twoViews: (name: string) =>
    `Two views from one file, ${name}: opened as a pair. Whatever stood still has one motion, and no curve is needed.`,
  fromFilm: (film: string, first: string, second: string) =>
    `From ${film}: ${first} and ${second}.`,
  areOpen: (first: string, second: string) => `${first} and ${second} are open.`,
};

const article = (name: string) => (/^[AEIO]/.test(name) ? "an" : "a");

export const truth = {
  reading: "Reading the truth",
  noFrames: (names: string, stage: string) =>
    `${names}: a truth of two frames, but the stage has ${stage || "no frames"}, which brings its own. Open the two frames first, then give their truth.`,
  taken: (names: string) => `Truth taken: ${names}.`,
};
