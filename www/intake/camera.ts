/**
 * The camera: two shots, or several at one press; the filmstrip then proposes two of them.
 *
 * Leave to use it is asked for when this dialog opens, and the camera is let go when it closes.
 */

import { make } from "../dom";
import { later } from "../text/later";
import { button, openSheet } from "./dialog";
import type { Film } from "./film";
import { shotsFilm, type Shot } from "./shots";

const words = later.camera;

/** Shots of one press, and the time between them. */
const SEVERAL = 12;
const BETWEEN_MS = 120;
/** What is asked of a camera, as far as it goes. */
const WISHES = { width: { ideal: 1920 }, height: { ideal: 1080 } };

/** Opens the camera; `taken` gets the shots once there are enough. */
export async function openCamera(taken: (film: Film) => void): Promise<void> {
  const shots: Shot[] = [];
  let stream: MediaStream | null = null;
  let open = true;
  const sheet = openSheet("camera-sheet", words.title, () => {
    open = false;
    stop();
    // Handed on, they are the film's.
    if (!handed) shots.forEach((shot) => shot.picture.close());
  });
  let handed = false;

  const video = make("video", { playsinline: true, class: "camera-view" });
  video.muted = true;
  const held = make("div", { class: "camera-shots", "aria-hidden": "true" });
  const cameras = make("select", { id: "cameras" });
  const choice = make(
    "label",
    { class: "field", hidden: true },
    make("span", {}, words.camera),
    cameras,
  );
  const several = button(words.several, takeSeveral);
  const one = button(words.one, takeOne, "primary");
  const cancel = button(words.cancel, () => sheet.close());
  sheet.body.append(
    make("div", { class: "camera-stage" }, video, held),
    choice,
    make("p", { class: "note" }, words.note),
  );
  sheet.foot.append(cancel, several, one);
  one.disabled = several.disabled = true;
  cameras.addEventListener("change", () => void start(cameras.value));
  await start();

  async function start(id?: string): Promise<void> {
    stop();
    one.disabled = several.disabled = true;
    sheet.say(words.waiting);
    try {
      stream = await ask(id);
      if (!open) return stop();
      video.srcObject = stream;
      await video.play();
      sheet.say(ready());
      one.disabled = several.disabled = false;
      await list();
    } catch (error) {
      if (open) sheet.say(trouble(error as Error));
    }
  }

  function stop(): void {
    stream?.getTracks().forEach((track) => track.stop());
    stream = null;
  }

  async function list(): Promise<void> {
    const devices = await navigator.mediaDevices.enumerateDevices();
    const known = devices.filter(({ kind }) => kind === "videoinput");
    const present = stream?.getVideoTracks()[0]?.getSettings().deviceId;
    cameras.replaceChildren(
      ...known.map(({ deviceId, label }, i) =>
        make("option", { value: deviceId }, label || words.unnamed(i + 1)),
      ),
    );
    if (present) cameras.value = present;
    choice.hidden = known.length < 2;
  }

  async function shoot(): Promise<void> {
    const picture = await createImageBitmap(video);
    if (!open) return picture.close();
    shots.push({ picture, at: performance.now() / 1000 });
    const canvas = make("canvas", {
      width: 96,
      height: Math.round((96 * picture.height) / picture.width),
    });
    canvas.getContext("2d")!.drawImage(picture, 0, 0, canvas.width, canvas.height);
    held.append(canvas);
  }

  function ready(): string {
    return shots.length === 0 ? words.ready : words.second;
  }

  async function takeOne(): Promise<void> {
    await shoot();
    if (shots.length === 2) hand();
    else sheet.say(ready());
  }

  async function takeSeveral(): Promise<void> {
    one.disabled = several.disabled = true;
    for (let i = 0; i < SEVERAL && open; i++) {
      sheet.say(words.taking(i + 1, SEVERAL));
      const next = new Promise((over) => setTimeout(over, BETWEEN_MS));
      await shoot();
      await next;
    }
    if (open) hand();
  }

  function hand(): void {
    handed = true;
    sheet.close();
    taken(shotsFilm(shots));
  }
}

async function ask(id?: string): Promise<MediaStream> {
  // Browsers lend a camera to secure pages only, and otherwise do as if there were none.
  if (!navigator.mediaDevices) throw Object.assign(new Error(), { name: "InsecureContext" });
  const which = id ? { deviceId: { exact: id } } : { facingMode: { ideal: "environment" } };
  return navigator.mediaDevices.getUserMedia({ video: { ...WISHES, ...which }, audio: false });
}

function trouble({ name, message }: Error): string {
  switch (name) {
    case "NotAllowedError":
      return words.forbidden;
    case "NotFoundError":
    case "OverconstrainedError":
      return words.notFound;
    case "NotReadableError":
    case "AbortError":
      return words.inUse;
    case "InsecureContext":
      return words.insecure;
    default:
      return words.broken(message || name);
  }
}
