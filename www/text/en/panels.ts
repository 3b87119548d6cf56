/** The panels: regions, energy, scores, camera, options, sequences, and what is kept. */

export const regions = {
  background: "Background",
  curve: (label: number) => `Curve ${label}`,
  remove: (label: number) => `Delete curve ${label}`,
  translation: "Translation per frame, in the region's unit of depth: its mean 1/Z is 1",
  rotation: "Rotation per frame about x, y and z, in degrees",
  depth: "Depth",
  rest: "everything else",
  noCurve: "No curve is drawn. The whole frame is one region, as if only the camera moved.",
  scales:
    "Each region has an unknown scale of depth. Two frames do not determine the depth of one region relative to another. Set it by eye with the sliders.",
  rough: "A rough curve that covers a part of each moving object is enough.",
  circle: (x: number, y: number, r: number) => `${x}, ${y} · radius ${r}`,
  corners: (count: number) => `${count} corners`,
  models: {
    still: "still",
    rotation: "rotation",
    translation: "translation",
    full: "translation and rotation",
  },
  nonRigid: "non-rigid",
  oneWith: (label: number) => `same body as ${label}?`,
  isBackground: "part of the background?",
  ambiguous: "two motions fit equally well",
  inFrontOf: (curves: number[]) => `in front of ${curves.join(" and ")}`,
};

export const energy = {
  pass: "Pass",
  energy: "Energy",
  left: (data: string, smoothness: string, length: string) =>
    `Remaining energy: ${data} data, ${smoothness} smoothness of depth, ${length} length of curves.`,
  newSum:
    "The next energies cannot be compared with these: curves or weights have changed, or a finer scale begins.",
  fell: (from: string, to: string) => `from ${from} to ${to}`,
  once: (energy: string) => `${energy} after one pass`,
  sinceLine: (fall: string, left: string) =>
    `Since the last dashed line: ${fall}. ${left} A dashed line stands where a finer scale begins, or weights or curves have changed. Energies can be compared only between two dashed lines.`,
};

export const scores = {
  found: "Found",
  baseline: "Horn–Schunck",
  aee: "AEE",
  aeeMeaning: "Average endpoint error: mean error of the image motion",
  aae: "AAE",
  aaeMeaning: "Mean angular error: angle between (u, v, 1) and the ground truth",
  labels: "Labels wrong",
  labelsMeaning: "Share of pixels that are in the wrong region",
  region: "Region",
  iou: "IoU",
  depth: "Depth",
  flat: "flat",
  background: "Backgr.",
  curve: (label: number) => `Curve ${label}`,
  meaning:
    "IoU: intersection over union of the region and the ground truth. Depth: mean relative error after the region's scale is aligned. Flat: the same error for constant depth. T: error of its direction. ω: error per frame.",
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
  principalMeaning: "Where the optical axis meets the frame, usually its centre.",
  byHand: "You have set f.",
  bends: "A wrong f distorts depth more than outlines.",
  finding: "Looking for the focal length",
  notFound: "These frames do not determine f. It is unchanged.",
  found: (f: number, least: number, greatest: number) =>
    `f is about ${f}\u00a0px (between ${least} and ${greatest}), estimated from these frames.`,
};

export const options = {
  preset: "Preset",
  automatic: "automatic",
  placeholder: "auto",
  chosen: "chosen from the frames",
  idle: (preset: string) => `No effect under ${preset}.`,
};

export const sequence = {
  own: "Your own frames",
  size: (width: number, height: number, focal: string) => `${width} × ${height} pixels. ${focal}`,
};

export const kept = {
  forgotten: "All that was kept on this device is deleted.",
  never:
    "This browser does not let the page keep anything. Frames, curves and results are lost when the page is closed.",
  nothing: (most: number) =>
    `Nothing is kept yet. Frames, curves, settings, passes and results will be kept on this device only, up to ${most}\u00a0MB.`,
  pairs: (count: number, size: string, most: number) =>
    `Kept on this device only: ${count === 1 ? "1 pair" : `${count} pairs`} of frames with curves, settings, passes and results. ${size} of at most ${most}\u00a0MB.`,
};
