/**
 * Relievo's page: puts the parts together and opens the first sequence.
 *
 * State is in `store.ts`, commands are in `session.ts` and `curves.ts`; every part below watches what
 * it shows and calls what it offers. What is computed is computed in the worker.
 */

import { byId } from "./dom";
import { mountCamera } from "./panels/camera";
import { mountExport } from "./export/export";
import { mountEnergy, recolour } from "./panels/energy";
import { mountFrames } from "./panels/frames";
import { mountMessage } from "./panels/message";
import { mountOptions } from "./panels/options";
import { mountProgress } from "./panels/progress";
import { mountRegions } from "./panels/regions";
import { mountScores } from "./panels/scores";
import { mountSequence } from "./panels/sequence";
import { mountTabs } from "./panels/tabs";
import { mountTheme } from "./panels/theme";
import { mountTransport } from "./panels/transport";
import { mountViewbar } from "./panels/viewbar";
import { mountGlasses } from "./glasses/glasses";
import { mountRelief } from "./relief/relief";
import { mountLessons } from "./lessons/panel";
import { mountAddress } from "./memory/address";
import { mountInstalled } from "./installed";
import { begin } from "./memory/first";
import { mountHeld } from "./memory/held";
import { mountHistory } from "./memory/history";
import { mountKept } from "./memory/panel";
import { mountRemember } from "./memory/remember";
import { mountDivider } from "./stage/divider";
import { mountKeys } from "./stage/keys";
import { mountLegend } from "./stage/legend";
import { mountReadout } from "./stage/readout";
import { mountStage } from "./stage/stage";
import { mountTools } from "./stage/tools";
import { mountZoom } from "./stage/zoom";
import { mountTimeline } from "./timeline/timeline";
import { store } from "./store";
import { about } from "./text";

byId("about").innerHTML = about;

mountMessage();
mountTabs();
mountSequence();
mountStage();
mountTools();
mountKeys();
mountZoom();
mountDivider();
mountReadout();
mountLegend();
mountViewbar();
mountTimeline();
mountTransport();
mountProgress();
mountFrames();
mountRegions();
mountEnergy();
mountScores();
mountCamera();
mountOptions();
mountExport();
mountRelief();
mountGlasses();
mountTheme(recolour);
mountHeld();
mountHistory();
mountRemember();
mountKept();
mountAddress();
mountLessons();

/** For the browser's console: what the page knows, to read. */
Object.defineProperty(window, "relievo", { get: () => store.state });

void begin().then(mountInstalled);
