/** What can be taken away of a result, with what it is and its units: for the dialog and for the zip's README alike. */

import { later } from "../text/later";

export interface Item {
  title: string;
  line: string;
  /** The core's names of its files, and what their buttons say. */
  files: { name: string; label: string }[];
}

const { items } = later;

export const MEASURES: Item[] = [
  { ...items.labels, files: [{ name: "labels.png", label: "PNG" }] },
  {
    ...items.depth,
    files: [
      { name: "depth.pfm", label: "PFM" },
      { name: "depth16.png", label: items.depth.png },
    ],
  },
  { ...items.flow, files: [{ name: "flow.flo", label: ".flo" }] },
  { ...items.occlusion, files: [{ name: "occlusion.png", label: "PNG" }] },
  { ...items.motion, files: [{ name: "motion.json", label: "JSON" }] },
];

export const SURFACE: Item = {
  ...items.relief,
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
  return later.readme(title, listed.join(""), film);
}
