/** Results to take away: the view as it is, and the files that the command line writes too. */

import { byId, make } from "../dom";
import { askShown } from "../session";
import { stagePicture } from "../stage/snapshot";
import { store } from "../store";
import { awaited, wantedParams } from "../views";
import type { ResultFile } from "../worker/protocol";

const TYPES: Record<string, string> = { png: "image/png", json: "application/json" };

let addresses: string[] = [];
/** How pictures are taken of views that draw themselves; `null` where at present the stage draws. */
const takes = new Map<string, () => Promise<Blob | null> | null>();

/** A view that draws itself leaves here how to take its picture. */
export function takePicture(view: string, take: () => Promise<Blob | null> | null): void {
  takes.set(view, take);
}

export function mountFiles(): void {
  const list = byId<HTMLButtonElement>("save-files");
  const clear = () => {
    addresses.forEach((address) => URL.revokeObjectURL(address));
    addresses = [];
    byId("files").replaceChildren();
  };
  list.addEventListener("click", async () => {
    const files = await askShown("Writing files", (service) =>
      service.files(wantedParams(store.state)),
    );
    if (!files) return;
    clear();
    byId("files").append(...files.map(link));
    byId("files").querySelector("a")?.focus();
  });
  byId("save-view").addEventListener("click", async () => {
    const blob = await (takes.get(store.state.view)?.() ?? stagePicture());
    if (!blob) return;
    const { view, source } = store.state;
    const name = source?.kind === "scene" ? source.name : "frames";
    save(blob, `relievo-${name}-${view}.png`);
  });
  store.watch(
    ({ started, running, busy }) => [started, running, busy],
    ({ started, running, busy }) => {
      // The next pass would take away what this one wrote.
      list.disabled = !started || running || busy !== null;
    },
  );
  store.watch(
    ({ frames, view, viewParams, pictured }) => [frames, view, viewParams, pictured],
    (state) => {
      byId<HTMLButtonElement>("save-view").disabled = !state.frames || awaited(state);
    },
  );
  // Files of an earlier result would be mistaken for the present one.
  store.watch(({ source, report }) => [source, report], clear);
}

function link(file: ResultFile): HTMLElement {
  const type = TYPES[file.name.split(".").pop() ?? ""] ?? "application/octet-stream";
  const address = URL.createObjectURL(new Blob([file.bytes], { type }));
  addresses.push(address);
  const size = `${Math.max(1, Math.round(file.bytes.length / 1024))} kB`;
  return make(
    "li",
    {},
    make("a", { href: address, download: file.name }, file.name, make("small", {}, size)),
  );
}

function save(blob: Blob, name: string): void {
  const address = URL.createObjectURL(blob);
  make("a", { href: address, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(address), 10_000);
}
