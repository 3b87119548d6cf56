/** What comes with dialogs that are fetched when they are opened: export, camera, filmstrip, clips. */

export const exporting = {
  title: "Export",
  oneAtATime: "One at a time: something is still being written.",
  writing: "Writing…",
  writingFile: (name: string) => `Writing ${name}…`,
  failed: (reason: string) => `It could not be written: ${reason}.`,
  kilobytes: (count: string) => `${count} kB`,
  megabytes: (count: string) => `${count} MB`,
  saved: (name: string, size: string) => `${name} saved, ${size}.`,

  pictures: "Pictures",
  anyView: "Any view",
  atSize: (width: number, height: number) =>
    `At the frame's size, ${width}×${height} pixels, sRGB; a stereo pair is twice as wide.`,
  stage: "The stage",
  asOnScreen: (view: string) =>
    `${view} as on the screen: turned, zoomed, divided or captioned as it is.`,
  ofTruth: (title: string) => `${title}, the truth`,
  baseline: "Motion, Horn–Schunck",
  measurements: "Measurements",
  surface: "Surface",
  film: "Film",
  solve: "The solve",
  cite: "Cite",
  method: "The method",
  software: "This software",
  bibtex: (title: string) => `${title}, BibTeX`,
  copy: "Copy BibTeX",
  copied: "BibTeX copied.",
  copyByHand: "It is selected, to be copied by hand.",
  everything: "Everything as one zip",
  inIt: "All files above, every view, the citations and a README that says what they are.",

  /** Why there is no result to take away. */
  noFrames: "Open a sequence or two frames first.",
  recording: "A recording is being shown: wait until the solver is there.",
  atWork: "The solver is at work: pause it, or wait until it is done.",
  notRun: "Run the solver first: there is no result yet.",
};

export const solveFilm = {
  noPasses: "No passes of this solve are kept.",
  about: (pictures: number, seconds: number) =>
    `The outlines pass by pass, with the energy, as far as passes are kept: ${pictures} pictures in ${seconds} s.`,
  none: "There is no film: no passes of this solve are kept.",
  noEncoder:
    "There is no film: this browser does not encode video. Current versions of Chrome, Edge and Firefox do.",
  filming: (pass: number, of: number) => `Filming pass ${pass} of ${of}…`,
  start: "Start",
  pass: (pass: number, of: number) => `Pass ${pass} of ${of}`,
  energy: "Energy",
};

/** Files of a result: what each is, its units, and what its buttons say. */
export const items = {
  labels: {
    title: "Labels",
    line: "8-bit PNG: 0 is the background, k is inside curve k. The numbers are small, so it looks black.",
  },
  depth: {
    title: "Depth Z",
    line:
      "Each region in its own unit, in which its mean 1/Z is 1, times its slider. PFM: 32-bit floats, from the bottom " +
      "row up. PNG: 16 bits, Z = value ÷ depth_scale in motion.json; 0 is unknown, 65535 is that far or farther.",
    png: "16-bit PNG",
  },
  flow: {
    title: "Image motion",
    line: "Middlebury .flo: u to the right and v down at every pixel, in pixels per frame.",
  },
  occlusion: {
    title: "Hidden pixels",
    line: "8-bit PNG: 255 where the second frame hides what the first one shows, else 0.",
  },
  motion: {
    title: "Motions in space",
    line: "JSON: T of each region per frame, in its unit of depth; ω in radians per frame; energy after each pass.",
  },
  relief: {
    title: "Relief",
    line:
      "The surface of the 3-D view: x right, y up, z towards you, about 2 units wide; its true size is not known. GLB: " +
      "with the first frame as its texture. PLY: a colour for each vertex, no texture; unknown depth is left out.",
  },
};

/** The README in the zip; `files` are their names, each with a line; `film` is why there is none, or empty. */
export const readme = (title: string, files: string, film: string) =>
  `${title}, as Relievo found it.

pictures/
    Every view at the frame's size, sRGB; a stereo pair is twice as wide.
${files}solve.webm
    ${film || "The outlines, pass by pass."}
cite.bib
    How to cite the method and this software, for BibTeX.

Pixel (0, 0) is the centre of the top-left pixel. The camera looks along Z, x is to the right and y down.
`;

export const camera = {
  title: "Take two frames with the camera",
  camera: "Camera",
  unnamed: (number: number) => `Camera ${number}`,
  several: "Take several",
  one: "Take a shot",
  cancel: "Cancel",
  note: "Two shots from slightly different places, or of something that moves; or several at one press, of which two are proposed. Nothing leaves this device.",
  waiting: "Waiting for the camera…",
  ready: "Ready for the first shot.",
  second: "One shot is taken. Move a little, then take the second.",
  taking: (shot: number, of: number) => `Taking shot ${shot} of ${of}…`,
  /** Its shots as a film. */
  film: "the camera's shots",
  firstShot: "first shot",
  laterShot: (time: string) => `${time} later`,
  file: (shot: string) => `camera, ${shot}`,

  forbidden:
    "This page may not use the camera. Allow it in the browser's settings for this page, then open this dialog again.",
  notFound: "No camera was found. Connect one, or open a clip or two photos instead.",
  inUse:
    "The camera cannot be used: another program may have it. Close that, then open this dialog again.",
  insecure:
    "Browsers lend the camera only to pages that are served by https or from this machine. Open a clip or two photos instead.",
  broken: (reason: string) =>
    `The camera cannot be used (${reason}). Open a clip or two photos instead.`,
};

export const strip = {
  title: (film: string) => `Choose two frames of ${film}`,
  frames: ["First frame", "Second frame"] as [string, string],
  keys: "Keys: 1 and 2 choose the number, comma and full stop step by one frame.",
  row: "A picture of the row takes the chosen number.",
  film: "The film",
  propose: "Propose the second",
  cancel: "Cancel",
  open: "Open these two",
  opening: "Opening these two frames…",
  same: "These are one and the same frame.",
  onlyOne: "This film has but one frame.",
  measuring: "Measuring the motion between them…",
  looking: "Looking for a second frame…",
  sizes: "These two differ in size, so that motion between them cannot be measured.",
  fit: (share: string) =>
    `Between them the faster things move by ${share} of the frame: enough to see depth by, little enough to follow.`,
  small: (share: string) =>
    `Between them the faster things move by ${share} of the frame. Further apart, depth would show better.`,
  still: "Nothing moves between them.",
  large: "Too much changes between them to be followed. Take two that are closer together.",
  earlier: (frame: string) => `${frame}: one earlier`,
  later: (frame: string) => `${frame}: one later`,
  place: (number: number, of: number) => `${number} of ${of}`,
  /** A picture of the row, as it is read out. */
  frame: (number: number, label: string) => `Frame ${number}, ${label}`,
  isFirst: "the first",
  isSecond: "the second",
};

export const clips = {
  encoded: (name: string, codec: string) =>
    `${name} is encoded as ${codec}, which this browser does not play; open it in another browser, or convert it to MP4 with H.264 first, as the free ffmpeg or HandBrake do`,
  unknown: (name: string, container: string) =>
    `${name} is of the kind ${container}, which this browser does not play; open it in another browser, or convert it to MP4 with H.264 first, as the free ffmpeg or HandBrake do`,
  notDecoded: (name: string, time: string) => `${name} cannot be decoded at ${time}`,
};
