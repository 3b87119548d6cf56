/** The page in English: all that it says from the start. */

import { files, frames, truth } from "./intake";
import { lessons, links, page, waits } from "./page";
import { camera, energy, kept, options, regions, scores, sequence } from "./panels";
import { ending, expected, progress, run, status, timeline } from "./solve";
import {
  curves,
  glasses,
  groups,
  kinds,
  legend,
  readout,
  relief,
  settings,
  split,
  stage,
  views,
  whose,
} from "./stage";

export const en = {
  language: "en",
  frames,
  files,
  truth,
  waits,
  page,
  links,
  lessons,
  regions,
  energy,
  scores,
  camera,
  options,
  sequence,
  kept,
  run,
  status,
  progress,
  ending,
  expected,
  timeline,
  groups,
  views,
  settings,
  kinds,
  whose,
  split,
  curves,
  stage,
  legend,
  readout,
  relief,
  glasses,
};
