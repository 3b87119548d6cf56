/** How to cite the method and this software. */

import { version } from "../../package.json";
import { later } from "../text/later";

export const CITATIONS = [
  {
    id: "cite-method",
    title: later.exporting.method,
    bibtex: `@article{sekkati2006concurrent,
  author  = {Sekkati, Hicham and Mitiche, Amar},
  title   = {Concurrent {3-D} motion segmentation and {3-D} interpretation of temporal sequences of monocular images},
  journal = {IEEE Transactions on Image Processing},
  volume  = {15},
  number  = {3},
  pages   = {641--653},
  year    = {2006},
}`,
  },
  {
    id: "cite-software",
    title: later.exporting.software,
    bibtex: `@software{relievo,
  author  = {{The Relievo authors}},
  title   = {Relievo: concurrent {3-D} motion segmentation and {3-D} interpretation of two frames of a film},
  version = {${version}},
  year    = {2026},
  url     = {https://github.com/relievo/relievo},
}`,
  },
];

export const bibliography = () => CITATIONS.map(({ bibtex }) => `${bibtex}\n`).join("\n");
