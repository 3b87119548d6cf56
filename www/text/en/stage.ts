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
    hint: "Colours run from far to near. Hatched: depth cannot be determined from these two frames.",
  },
  motion: {
    label: "Motion",
    hint: "The motion of each pixel. Hue is its direction, strength is its length.",
  },
  anaglyph: {
    label: "Anaglyph",
    hint: "For coloured glasses, the left eye's colour first. Or the pictures of both eyes, side by side or in turn.",
  },
  relief: {
    label: "Relief",
    hint: "Drag it, or use the arrow keys, to turn it; with Shift, to move the light. + and − change the distance.",
  },
  labels: { label: "Labels", hint: "The region that each pixel belongs to." },
  confidence: {
    label: "Confidence",
    hint: "1: depth is determined by the image motion. 0: it cannot be determined.",
  },
  occlusion: {
    label: "Occlusion",
    hint: "Coloured: pixels that are hidden in the second frame, if the preset looks for them.",
  },
  residual: {
    label: "Residual",
    hint: "|ψ|: the change of brightness that the motion found does not explain.",
  },
  compare: {
    label: "Compare",
    hint: "The ground truth beside the result, in the same colours. Each region's depth is scaled to the ground truth.",
  },
  error: {
    label: "Error",
    hint: "The error of the result at each pixel. Each region's depth is scaled to the ground truth.",
  },
};

/** What a view lets one set. */
export const settings = {
  palette: "Palette",
  curvesOnTop: "Curves on top",
  motion: "Shown as",
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
  ghosts: "Unknown depth",
  compare: "Compare",
  error: "Error of",
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
  errorOfBaseline: "Error: Horn–Schunck motion",
  on: "Two views, with a divider between them.",
  off: "One view.",
  at: (share: string) => `${share} from the left`,
};

export const curves = {
  tooMany: (most: number) =>
    `${most} curves are drawn, and no more are possible. Delete one to draw another.`,
  added: (curve: number, shape: string) => `Curve ${curve} added: ${shape}.`,
  changed: (curve: number, shape: string) => `Curve ${curve}: ${shape}.`,
  deleted: (curve: number) => `Curve ${curve} deleted.`,
  selected: (curve: number, shape: string) => `Curve ${curve} selected: ${shape}.`,
  circle: (x: number, y: number, r: number) => `circle at ${x}, ${y}, radius ${r}`,
  outline: (points: number, x: number, y: number) => `outline of ${points} points about ${x}, ${y}`,
  finding: "Looking for objects that move by themselves",
  found(curves: number): string {
    if (curves === 0) return "One motion explains the whole frame. No curve is needed.";
    return curves === 1 ? "1 curve found." : `${curves} curves found.`;
  },
};

export const stage = {
  overlay: "Curves on the frame",
  pixelByPixel: (view: string) => `${view}, pixel by pixel`,
  drawnAfterPass: "This view is drawn after the present pass…",
  beingDrawn: "Drawing…",
};

export const legend = {
  depthInTruth: "Depth in the unit of the ground truth",
  depthInMean: "Depth, in units of the region's mean depth",
  truthUnit: "unit of the truth",
  meanUnit: "× mean",
  longest: (value: string) => `longest ${value}`,
  hold: "Hold",
  holdWhat: "the range",
  isHeld: "This range is kept for all passes. Press to fit it to each pass again.",
  isFree: "Keep this range of colours for all passes, or type another",
  /** The ends of a range that is held, as names of fields. */
  nearest: "Nearest depth",
  farthest: "Farthest depth",
  fullColour: (quantity: string) => `${quantity} at the end of the colours`,
  longestArrow: "Motion of the longest arrow",
  howToType: "Enter applies it, Escape leaves it as it was.",
  rangeIs: (ends: string[], unit: string) =>
    `The colours go ${ends.length > 1 ? `from ${ends.join(" to ")}` : `up to ${ends[0]}`} ${unit}.`,
  empty: (name: string) => `${name}: no number was typed. The range stays as it was.`,
  noNumber: (name: string) => `${name}: this is not a number. The range stays as it was.`,
  outOfRange: (name: string, least: string, most: string) =>
    `${name}: the number must be between ${least} and ${most}. The range stays as it was.`,
  notLess: (name: string, typed: string, other: string, end: string) =>
    `${name}: ${typed} is not less than the ${other.toLowerCase()}, ${end}. The range stays as it was.`,
  notMore: (name: string, typed: string, other: string, end: string) =>
    `${name}: ${typed} is not more than the ${other.toLowerCase()}, ${end}. The range stays as it was.`,
  rim: (value: string) => `rim ${value}`,
  rimTitle: "Length of the motion at the rim of the wheel, where colours are strongest",
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
  depthTitle: "In units of the region's mean depth",
  motion: "motion",
  pixels: (speed: string, u: string, v: string) => `${speed} px (${u}, ${v})`,
  motionTitle: "Pixels per frame: length, and in brackets to the right and down",
  residualTitle: "Residual: change of brightness that the motion does not explain, in grey levels",
  confidence: "confidence",
  confidenceTitle: "How well the image motion determines depth, 0 to 1",
  hidden: "hidden",
  inSecond: "in the second frame",
};

export const relief = {
  tap: "Tap to turn",
  keys: "Relief. Arrow keys turn it; with Shift they move the light. Plus comes closer, minus goes away, Home shows the front.",
  front: "The relief is seen from the front.",
  broken: (reason: string) =>
    `The relief cannot be shown: ${reason}. It needs WebGL. The other views do not.`,
  light: (from: string) => `Light from ${from}. Drag it, or move it with the arrow keys`,
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
  inTurn: "The pictures of the left and the right eye, in turn",
  besideEachOther: "The pictures of the left and the right eye, side by side",
};
