/**
 * The address of the page names the pair and how it is looked at: Back and Forward step through that, and a link opens what
 * it tells. What is dragged (zoom, divider) is a step once it has come to rest.
 */

import { announce, byId } from "../dom";
import { open, openScene } from "../session";
import { store } from "../store";
import { text } from "../text";
import type { Source } from "../worker/protocol";
import { recall } from "./database";
import { settingsOf } from "./held";
import { addressOf, linkOf, targetOf, type Target } from "./link";
import { isOwn, nameOf } from "./names";
import { flush, resume } from "./remember";
import { lookLike, USUAL_SIGHT } from "./sight";

/** The address that is shown, or about to be. */
let shown = "";

export function mountAddress(): void {
  // Links within the page scroll, and say nothing of pairs.
  addEventListener("popstate", () => void follow());
  store.watch(
    ({ source, view, opening, frames, playing, lessonStep, split, ranges, viewParams }) => [
      ...[source, view, opening, frames, playing, lessonStep],
      ...[split?.left, split?.right, ranges, viewParams.palette],
    ],
    tellNow,
  );
  store.watch(
    ({ zoom, split }) => [zoom, split?.at],
    () => {
      clearTimeout(resting);
      resting = setTimeout(tellNow, REST_MS);
    },
  );
  byId("share").addEventListener("click", () => void share());
  store.watch(
    ({ frames }) => [frames],
    ({ frames }) => {
      byId<HTMLButtonElement>("share").disabled = !frames;
    },
  );
}

/** What moves no more for so long has come to rest, milliseconds. */
const REST_MS = 400;
let resting: ReturnType<typeof setTimeout> | undefined;

function tellNow(): void {
  const { source, opening, playing } = store.state;
  if (source && !opening && !playing) void tell(source);
}

async function tell(source: Source): Promise<void> {
  const name = await nameOf(source);
  const { state } = store;
  const own = addressOf(name, state);
  const address = state.lessonStep ?? own;
  // Something else may have been opened while the name was made.
  if (state.source !== source || address === shown) return;
  const first = shown === "";
  shown = address;
  if (following || first) history.replaceState(null, "", address);
  else history.pushState(null, "", address);
}

type Opening = (parts: string[]) => Promise<boolean>;

/** What opens addresses that are no pairs, by their first part. */
const places = new Map<string, Opening>();

/** Has addresses `#name/…` opened by somebody else. */
export function onPlace(name: string, opening: Opening): void {
  places.set(name, opening);
}

/** While an address is followed, what it leads to makes no new one. */
let following = false;

/** Opens what the address asks for; whether it asked for anything that is there. */
export async function follow(): Promise<boolean> {
  const { catalogues } = store.state;
  const [place = "", ...parts] = location.hash.slice(1).split("/");
  const opening = places.get(place);
  const target = catalogues && !opening && targetOf(location.hash, catalogues);
  if (!opening && !target) return false;
  following = true;
  try {
    if (opening) {
      shown = location.hash;
      return await opening(parts);
    }
    store.update({ lessonStep: null });
    return target ? await lead(target) : false;
  } finally {
    tellNow();
    // Names are made in between.
    setTimeout(() => (following = false), 50);
  }
}

/** Opens what a link asks for; whether it is there. */
export async function lead(target: Target): Promise<boolean> {
  const { name, view, setting, sight, useless } = target;
  const { source, catalogues } = store.state;
  const isOpen = source !== null && (await nameOf(source)) === name;
  const scene = catalogues?.scenes.some((one) => one.name === name);
  let there = isOpen;
  if (isOpen && !setting) {
    if (view) store.update({ view });
    // An address without more is of the usual look.
    if (!sight) lookLike(USUAL_SIGHT);
  } else if (setting) {
    there = await exactly(target);
  } else {
    there = (await resume(name, view ?? undefined)) || (scene === true && (await openScene(name)));
    if (there && view) store.update({ view });
  }
  if (there && sight) lookLike(sight);
  else if (there && setting) store.update({ split: null });
  const complaint = complaintOf(name, there, scene === true, useless);
  if (complaint) store.update({ message: complaint });
  return there;
}

function complaintOf(name: string, there: boolean, scene: boolean, useless: string[]) {
  if (useless.length > 0) return text.links.useless(useless);
  if (there || scene) return null;
  return isOwn(name) ? text.links.notKept : text.links.noSequence(name.slice(0, 40));
}

/** The pair with exactly what the link tells; what was kept of it can be gone back to. */
async function exactly({ name, view, setting }: Target): Promise<boolean> {
  await flush();
  const kept = await recall(name).catch(() => null);
  const scene = store.state.catalogues?.scenes.find((one) => one.name === name);
  const open_ = store.state.source;
  const present = open_ && (await nameOf(open_)) === name ? open_ : null;
  const source = kept?.source ?? present;
  const wanted = { ...setting, ...(view ? { view } : {}) };
  const done = source
    ? await open({ ...source }, text.waits.link, wanted)
    : scene !== undefined && (await openScene(name, wanted));
  if (done && kept) {
    const { setting: before } = kept.session;
    const { result } = kept;
    if (settingsOf(before) === settingsOf(store.state)) return done;
    const found = result && result.settings === settingsOf(before) ? result.found : null;
    const held = found && {
      revision: -1,
      settings: result!.settings,
      ready: Promise.resolve(found),
      found,
    };
    const { shapes, camera, options, scales } = before;
    const timeline = kept.timeline;
    store.update({ past: [{ shapes, camera, options, scales, held, timeline }], future: [] });
  }
  return done;
}

async function share(): Promise<void> {
  const { source } = store.state;
  if (!source) return;
  const link = new URL(linkOf(await nameOf(source), store.state), location.href).href;
  const own = source.kind === "files";
  let copied = true;
  try {
    await navigator.clipboard.writeText(link);
  } catch {
    // Not allowed, or no clipboard: the address bar has it to copy from.
    copied = false;
    shown = new URL(link).hash;
    history.replaceState(null, "", link);
  }
  const what = copied ? text.links.copied : text.links.inAddress;
  const note = own ? `${what} ${text.links.withoutFrames}` : what;
  byId("share-note").textContent = note;
  announce(note);
  setTimeout(() => (byId("share-note").textContent = ""), 6000);
}
