/** The page in English: all that it says from the start. */

import * as intake from "./intake";
import * as page from "./page";
import * as panels from "./panels";
import * as solve from "./solve";
import * as stage from "./stage";

export const en = { language: "en", ...stage, ...solve, ...panels, ...intake, ...page };
