// Optical flow of others, where Python and its packages are there.

import { existsSync } from "node:fs";
import { join } from "node:path";

import { ask, root } from "../../scripts/shell.js";
import { Server } from "./server.js";

export const PEERS = [
  { work: "tvl1", name: "TV-L1" },
  { work: "dis", name: "DIS" },
];

const INSTALL =
  "python3 -m venv out/peers && out/peers/bin/pip install -r bench/peers/requirements.txt";

/** Where the packages may be: a venv of this checkout, or the Python at hand. */
const PYTHONS = ["out/peers/bin/python", "out/peers/Scripts/python.exe", "python3", "python"];

/** A server of the peers, or null after saying how to have them. */
export function peers() {
  for (const python of PYTHONS) {
    const program = python.includes("/") ? join(root, python) : python;
    if (program !== python && !existsSync(program)) continue;
    if (ask(program, "-c", "import cv2, numpy, skimage.registration") === null) continue;
    return new Server(program, [join(root, "bench/peers/speed.py")]);
  }
  console.error(
    `TV-L1 and DIS are left out: no Python with their packages. Install them with: ${INSTALL}`,
  );
  return null;
}
