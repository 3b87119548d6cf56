/** What can be taken away of a result, with what it is and its units: for the dialog and for the zip's README alike. */

export interface Item {
  title: string;
  line: string;
  /** The core's names of its files, and what their buttons say. */
  files: { name: string; label: string }[];
}

export const MEASURES: Item[] = [
  {
    title: "Labels",
    line: "8-bit PNG: 0 is the background, k is inside curve k. The numbers are small, so it looks black.",
    files: [{ name: "labels.png", label: "PNG" }],
  },
  {
    title: "Depth Z",
    line:
      "Each region in its own unit, in which its mean 1/Z is 1, times its slider. PFM: 32-bit floats, from the bottom " +
      "row up. PNG: 16 bits, Z = value ÷ depth_scale in motion.json; 0 is unknown, 65535 is that far or farther.",
    files: [
      { name: "depth.pfm", label: "PFM" },
      { name: "depth16.png", label: "16-bit PNG" },
    ],
  },
  {
    title: "Image motion",
    line: "Middlebury .flo: u to the right and v down at every pixel, in pixels per frame.",
    files: [{ name: "flow.flo", label: ".flo" }],
  },
  {
    title: "Hidden pixels",
    line: "8-bit PNG: 255 where the second frame hides what the first one shows, else 0.",
    files: [{ name: "occlusion.png", label: "PNG" }],
  },
  {
    title: "Motions in space",
    line: "JSON: T of each region per frame, in its unit of depth; ω in radians per frame; energy after each pass.",
    files: [{ name: "motion.json", label: "JSON" }],
  },
];

export const SURFACE: Item = {
  title: "Relief",
  line:
    "The surface of the 3-D view: x right, y up, z towards you, about 2 units wide; its true size is not known. GLB: " +
    "with the first frame as its texture. PLY: a colour for each vertex, no texture; unknown depth is left out.",
  files: [
    { name: "relief.glb", label: "GLB" },
    { name: "relief.ply", label: "PLY" },
  ],
};

/** Files with these endings do not get smaller. */
export const COMPRESSED = /\.(png|webm)$/;

/** What the zip's README says; `film` is why there is none, or empty. */
export function readme(title: string, film: string): string {
  const listed = [...MEASURES, SURFACE].map(
    ({ title, line, files }) =>
      `${files.map(({ name }) => name).join(", ")}\n    ${title}. ${line}\n`,
  );
  return `${title}, as Relievo found it.

pictures/
    Every view at the frame's size, sRGB; a stereo pair is twice as wide.
${listed.join("")}solve.webm
    ${film || "The outlines, pass by pass."}
cite.bib
    How to cite the method and this software, for BibTeX.

Pixel (0, 0) is the centre of the top-left pixel. The camera looks along Z, x is to the right and y down.
`;
}
