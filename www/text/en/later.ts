/** What comes with dialogs that are fetched when they are opened: export, camera, filmstrip, clips. */

const exporting = {
  title: "Export",
  oneAtATime: "Wait: another file is still being written.",
  writing: "Writing…",
  writingFile: (name: string) => `Writing ${name}…`,
  failed: (reason: string) => `The file could not be written: ${reason}.`,
  kilobytes: (count: string) => `${count} kB`,
  megabytes: (count: string) => `${count} MB`,
  saved: (name: string, size: string) => `${name} saved, ${size}.`,

  pictures: "Pictures",
  anyView: "Any view",
  atSize: (width: number, height: number) =>
    `As large as the frame, ${width}×${height} pixels, sRGB. A stereo pair is twice as wide.`,
  stage: "The stage",
  asOnScreen: (view: string) => `${view}, exactly as on the screen.`,
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
  copyByHand: "The text is selected. Copy it with the keyboard.",
  everything: "Everything as one zip",
  inIt: "All files above, every view, the citations, and a README that explains them.",

  /** Why there is no result to take away. */
  noFrames: "Open a sequence or two frames first.",
  recording: "A recording is being shown. Wait until the solver is loaded.",
  atWork: "The solver is running. Pause it, or wait until it has finished.",
  notRun: "Run the solver first. There is no result yet.",
};

const solveFilm = {
  noPasses: "No passes of this solve are kept.",
  about: (pictures: number, seconds: number) =>
    `The outlines after each pass, with the energy: ${pictures} pictures in ${seconds} s.`,
  none: "There is no film, because no passes of this solve are kept.",
  noEncoder:
    "There is no film, because this browser cannot encode video. Current versions of Chrome, Edge and Firefox can.",
  filming: (pass: number, of: number) => `Filming pass ${pass} of ${of}…`,
  start: "Start",
  pass: (pass: number, of: number) => `Pass ${pass} of ${of}`,
  energy: "Energy",
};

/** Files of a result: what each is, its units, and what its buttons say. */
const items = {
  labels: {
    title: "Labels",
    line: "8-bit PNG. 0 is the background, k is inside curve k. The numbers are small, so the picture looks black.",
  },
  depth: {
    title: "Depth Z",
    line:
      "Each region has its own unit: its mean 1/Z is 1, times the factor of its slider. PFM: 32-bit floats, bottom row " +
      "first. PNG: 16 bits, Z = value ÷ depth_scale of motion.json. 0 is unknown, 65535 is that depth or more.",
    png: "16-bit PNG",
  },
  flow: {
    title: "Image motion",
    line: "Middlebury .flo. At each pixel u to the right and v down, in pixels per frame.",
  },
  occlusion: {
    title: "Hidden pixels",
    line: "8-bit PNG. 255 where a pixel of the first frame is hidden in the second, else 0.",
  },
  motion: {
    title: "3-D motions",
    line: "JSON. T of each region per frame, in its unit of depth. ω in radians per frame. The energy after each pass.",
  },
  relief: {
    title: "Relief",
    line:
      "The surface of the 3-D view. x is right, y up, z towards you. It is about 2 units wide; the true size is unknown. " +
      "GLB: the first frame is the texture. PLY: a colour for each vertex, no texture; unknown depth is left out.",
  },
};

/** The README in the zip; `files` are their names, each with a line; `film` is why there is none, or empty. */
const readme = (title: string, files: string, film: string) =>
  `${title}: result of Relievo.

pictures/
    Every view, as large as the frame, sRGB. A stereo pair is twice as wide.
${files}solve.webm
    ${film || "The outlines after each pass."}
cite.bib
    References for the method and for this software, in BibTeX.

Pixel (0, 0) is the centre of the top-left pixel. The camera looks along Z. x is to the right, y is down.
`;

const camera = {
  title: "Take two frames with the camera",
  camera: "Camera",
  unnamed: (number: number) => `Camera ${number}`,
  several: "Take several",
  one: "Take a shot",
  cancel: "Cancel",
  note: "Take two shots from slightly different places, or of something that moves. Or take several at once: two of them are proposed. Nothing leaves this device.",
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
    "This page is not allowed to use the camera. Allow it in the browser's settings for this page, then open this dialog again.",
  notFound: "No camera was found. Connect one, or open a clip or two photos instead.",
  inUse:
    "The camera cannot be used. Another program may be using it. Close that program, then open this dialog again.",
  insecure:
    "Browsers allow the camera only on pages that come by https or from this computer. Open a clip or two photos instead.",
  broken: (reason: string) =>
    `The camera cannot be used (${reason}). Open a clip or two photos instead.`,
};

const strip = {
  title: (film: string) => `Choose two frames of ${film}`,
  frames: ["First frame", "Second frame"] as [string, string],
  keys: "Keys: 1 and 2 choose which frame to set. Comma and full stop go one frame back and forward.",
  row: "Press a picture in the row to make it the chosen frame.",
  film: "The film",
  propose: "Propose the second frame",
  cancel: "Cancel",
  open: "Open these two",
  opening: "Opening these two frames…",
  same: "Both are the same frame. Choose two different ones.",
  onlyOne: "This film has only one frame.",
  measuring: "Measuring the motion between them…",
  looking: "Looking for a second frame…",
  sizes: "The two frames differ in size, so the motion between them cannot be measured.",
  fit: (share: string) =>
    `The fastest objects move by ${share} of the frame. This is enough to see depth, and little enough to track.`,
  small: (share: string) =>
    `The fastest objects move by ${share} of the frame. With frames further apart, depth would be clearer.`,
  still: "Nothing moves between these two frames.",
  large:
    "Too much changes between these two frames to be tracked. Choose two that are closer together.",
  earlier: (frame: string) => `${frame}: one earlier`,
  later: (frame: string) => `${frame}: one later`,
  place: (number: number, of: number) => `${number} of ${of}`,
  /** A picture of the row, as it is read out. */
  frame: (number: number, label: string) => `Frame ${number}, ${label}`,
  isFirst: "the first",
  isSecond: "the second",
};

const clips = {
  encoded: (name: string, codec: string) =>
    `${name} is encoded as ${codec}, which this browser cannot play; open it in another browser, or convert it to MP4 with H.264 first, with the free ffmpeg or HandBrake`,
  unknown: (name: string, container: string) =>
    `${name} is of the kind ${container}, which this browser cannot play; open it in another browser, or convert it to MP4 with H.264 first, with the free ffmpeg or HandBrake`,
  notDecoded: (name: string, time: string) => `${name} cannot be decoded at ${time}`,
};

export const later = { exporting, solveFilm, items, readme, camera, strip, clips };
