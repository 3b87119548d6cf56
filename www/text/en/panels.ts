/** The panels: regions, energy, scores, camera, options, sequences, and what is kept. */

export const regions = {
  background: "Background",
  curve: (label: number) => `Curve ${label}`,
  remove: (label: number) => `Delete curve ${label}`,
  translation: "Translation per frame, in units in which the region's mean 1/Z is 1",
  rotation: "Rotation per frame, in degrees about x, y and z",
  depth: "Depth",
  rest: "everything else",
  noCurve: "No curve is drawn: the whole frame is taken for one region, as from a moving camera.",
  scales:
    "Two frames do not tell how deep one region lies against another: each has a scale of its own, and the sliders set it by eye.",
  rough: "A rough curve that covers part of each moving thing is enough.",
  circle: (x: number, y: number, r: number) => `${x}, ${y} · radius ${r}`,
  corners: (count: number) => `${count} corners`,
  nonRigid: "non-rigid",
  oneWith: (label: number) => `one with ${label}?`,
  isBackground: "background?",
  ambiguous: "two explanations fit equally",
  inFrontOf: (curves: number[]) => `in front of ${curves.join(" and ")}`,
};

export const energy = {
  pass: "Pass",
  energy: "Energy",
  left: (data: string, smoothness: string, length: string) =>
    `Of what is left, ${data} is misfit of the frames, ${smoothness} depth's roughness, ${length} length of curves.`,
  newSum:
    "From the next pass on energy is another sum: curves or weights are new, or a finer scale begins.",
  fell: (from: string, to: string) => `from ${from} to ${to}`,
  once: (energy: string) => `${energy} after one pass`,
  sinceLine: (fall: string, left: string) =>
    `Since the last dashed line: ${fall}. ${left} At a dashed line a finer scale begins, weights are chosen anew or curves were drawn: energy can be compared only between two lines.`,
};

export const scores = {
  found: "Found",
  baseline: "Horn–Schunck",
  aee: "AEE",
  aeeMeaning: "Mean error of the image motion",
  aae: "AAE",
  aaeMeaning: "Mean angle between (u, v, 1) and the truth",
  labels: "Labels wrong",
  labelsMeaning: "Share of pixels in the wrong region",
  region: "Region",
  iou: "IoU",
  depth: "Depth",
  flat: "flat",
  background: "Backgr.",
  curve: (label: number) => `Curve ${label}`,
  meaning:
    "IoU: overlap of region and truth. Depth: mean error once the region's scale is aligned, beside that of a flat guess. T: angle between directions. ω: difference per frame.",
};

export const camera = {
  focal: "Focal length f, px",
  view: "Field of view, °",
  viewSlider: "Field of view",
  degrees: (value: string) => `${value} degrees`,
  notDegrees: "The field of view must be a number of degrees between 0 and 180.",
  principal: "Principal point",
  column: "Column, px",
  row: "Row, px",
  principalMeaning: "Where the optical axis meets the frame; as a rule its centre.",
  byHand: "f is as you set it.",
  bends: "A wrong f bends depth more than outlines.",
  finding: "Looking for the focal length",
  notFound: "These frames do not tell f: it stays.",
  found: (f: number, least: number, greatest: number) =>
    `f is about ${f}\u00a0px (${least} to ${greatest}), as far as these frames tell.`,
};

export const options = {
  preset: "Preset",
  automatic: "from the data",
  placeholder: "auto",
  chosen: "chosen from the data",
  idle: (preset: string) => `No effect under ${preset}.`,
};

export const sequence = {
  own: "Your own frames",
  size: (width: number, height: number) =>
    `${width} × ${height} pixels. Set the camera's focal length if you know it, or have it found.`,
};

export const kept = {
  forgotten: "This device keeps nothing any more.",
  never:
    "This browser keeps nothing for the page: frames, curves and results are gone once it is closed.",
  nothing: (most: number) =>
    `Nothing is kept. Frames, curves, settings, passes and results will be, on this device only, up to ${most}\u00a0MB.`,
  pairs: (count: number, size: string, most: number) =>
    `Kept on this device, and nowhere else: ${count === 1 ? "1 pair" : `${count} pairs`} with curves, settings, passes and results, ${size} of at most ${most}\u00a0MB.`,
};
