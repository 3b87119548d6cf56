/** The stage: views and what they let one set, curves, tools, legends, and what is read at a pixel. */

export const groups = {
  curves: "Outlines",
  depth: "Depth",
  motion: "Motion",
  space: "3-D",
  diagnostics: "Diagnostics",
};

/** The name of each view, and one line on how to read it. */
export const views = {
  curves: {
    label: "Outlines",
    hint: "The frame with its curves. Draw, move and resize them here.",
  },
  depth: {
    label: "Depth",
    hint: "From far to near along the palette; hatched where two frames do not tell.",
  },
  motion: {
    label: "Motion",
    hint: "Where each pixel goes: hue is the direction, strength the distance.",
  },
  anaglyph: {
    label: "Anaglyph",
    hint: "For coloured glasses, left eye first; or both eyes' pictures side by side, or in turn.",
  },
  relief: {
    label: "Relief",
    hint: "Turn it by dragging or with the arrow keys, with Shift the light; + and − come closer and go away.",
  },
  labels: { label: "Labels", hint: "Which region each pixel belongs to." },
  confidence: {
    label: "Confidence",
    hint: "1 where depth shows in the image motion, 0 where it cannot be told.",
  },
  occlusion: {
    label: "Occlusion",
    hint: "In colour: what the second frame hides, as far as the preset looks for it.",
  },
  residual: {
    label: "Residual",
    hint: "|ψ|: what the motion found leaves unexplained of the second frame’s brightness.",
  },
  compare: {
    label: "Compare",
    hint: "The truth beside what was found, in the same colours; each region's depth in the truth's unit.",
  },
  error: {
    label: "Error",
    hint: "How far what was found is from the truth; each region’s depth in the truth’s unit.",
  },
};

/** What a view lets one set. */
export const settings = {
  palette: "Palette",
  curvesOnTop: "Curves on top",
  motion: "As",
  flow: "Colours",
  arrows: "Arrows",
  presentation: "Shown as",
  anaglyph: "Anaglyph",
  wiggle: "Wiggle",
  glasses: "Glasses",
  swap: "Swap eyes",
  parallax: "Parallax",
  convergence: "Convergence",
  converge: "Automatic convergence",
  material: "Surface",
  textured: "Frame",
  plaster: "Plaster",
  wireframe: "Wireframe",
  normals: "Normals",
  ghosts: "Unknown depth as a ghost",
  compare: "What",
  error: "Of",
};

/** What pictures are of, as a name by itself. */
export const kinds = {
  flow: "Motion",
  depth: "Depth",
  labels: "Labels",
  occlusion: "Occlusion",
};

/** Whose a picture is. */
export const whose = {
  frames: "Frames",
  found: "Found",
  truth: "Truth",
  "horn-schunck": "Horn–Schunck",
  error: "Error",
};

/** Two views with a divider between them. */
export const split = {
  first: "First frame",
  second: "Second frame",
  /** What each side shows, after whose it is. */
  kinds: {
    depth: "depth",
    flow: "motion",
    labels: "labels",
    occlusion: "occlusion",
    confidence: "confidence",
    arrows: "arrows",
    residual: "residual",
  },
  side: (whose: string, kind: string) => `${whose}: ${kind}`,
  errorOfBaseline: "Error: Horn–Schunck’s motion",
  on: "Two views, with a divider between them.",
  off: "One view.",
  at: (share: string) => `${share} from the left`,
};

export const curves = {
  tooMany: (most: number) =>
    `${most} curves are drawn, more are not possible. Delete one to draw another.`,
  added: (curve: number, shape: string) => `Curve ${curve} added: ${shape}.`,
  changed: (curve: number, shape: string) => `Curve ${curve}: ${shape}.`,
  deleted: (curve: number) => `Curve ${curve} deleted.`,
  selected: (curve: number, shape: string) => `Curve ${curve} selected: ${shape}.`,
  circle: (x: number, y: number, r: number) => `circle at ${x}, ${y}, radius ${r}`,
  outline: (points: number, x: number, y: number) => `outline of ${points} points about ${x}, ${y}`,
  finding: "Looking for what moves by itself",
  found(curves: number): string {
    if (curves === 0) return "One motion explains both frames: no curve is needed.";
    return curves === 1 ? "1 curve found." : `${curves} curves found.`;
  },
};

export const stage = {
  overlay: "Curves on the frame",
  pixelByPixel: (view: string) => `${view}, pixel by pixel`,
  drawnAfterPass: "Drawn once this pass is done…",
  beingDrawn: "Being drawn…",
};

export const legend = {
  depthInTruth: "Depth in the truth's unit",
  depthInMean: "Depth; 1 is the region's mean",
  truthUnit: "truth's unit",
  meanUnit: "× mean",
  longest: (value: string) => `longest ${value}`,
  hold: "Hold",
  holdWhat: "the range",
  isHeld: "The range is held; press to let it follow",
  isFree: "Hold this range of colours",
  rim: (value: string) => `rim ${value}`,
  rimTitle: "Motion at which colours are full",
  background: "Backgr.",
  curve: (label: number) => `Curve ${label}`,
};

/** What is found at a pixel: names, values and what they mean. */
export const readout = {
  place: (x: number, y: number) => `x ${x}, y ${y}`,
  unknown: "not known",
  region: "region",
  background: "background",
  curve: (label: number) => `curve ${label}`,
  depth: "depth",
  timesMean: (value: string) => `${value} × mean`,
  depthTitle: "In units of the region's mean",
  motion: "motion",
  pixels: (speed: string, u: string, v: string) => `${speed} px (${u}, ${v})`,
  motionTitle: "Pixels per frame: its length, to the right and downwards",
  residualTitle: "Brightness that motion leaves unexplained, grey levels",
  confidence: "confidence",
  confidenceTitle: "How far depth shows in the image motion, 0 to 1",
  hidden: "hidden",
  inSecond: "in the second frame",
};

export const relief = {
  tap: "Tap to turn",
  keys: "Relief. Arrow keys turn it, with Shift they move the light; plus and minus come closer and go away, Home looks from the front.",
  front: "Relief seen from the front.",
  broken: (reason: string) =>
    `The relief cannot be shown: ${reason}. It needs WebGL; the other views do not.`,
  light: (from: string) => `Light from ${from}: drag it, or move it with the arrow keys`,
  /** Where the light comes from: aside −1, 0, 1 from the left to the right; above 1, below −1. */
  from(aside: number, above: number): string {
    const up = above > 0 ? "above" : above < 0 ? "below" : "";
    const side = aside > 0 ? "the right" : aside < 0 ? "the left" : "";
    return [up, side].filter(Boolean).join(" and ") || "the front";
  },
};

export const glasses = {
  full: "Full screen",
  leaveFull: "Leave full screen",
  wiggle: "Wiggle",
  stop: "Stop wiggling",
  inTurn: "Left and right eye's picture in turn",
  besideEachOther: "Left and right eye's picture side by side",
};
