/** Puts the service worker up, and says when a new version of the page is ready to take over. */

import { byId } from "./dom";

export async function mountInstalled(): Promise<void> {
  if (!import.meta.env.PROD || !("serviceWorker" in navigator)) return;
  const { serviceWorker } = navigator;
  // The first one takes over a page that runs on the same files: nothing to load again.
  let update = serviceWorker.controller !== null;
  const registration = await serviceWorker.register("./service-worker.js").catch(() => null);
  if (!registration) return;
  const offer = (worker: ServiceWorker | null) => {
    if (!worker || !serviceWorker.controller) return;
    byId("update").hidden = false;
    byId("update-now").onclick = () => worker.postMessage("take over");
  };
  offer(registration.waiting);
  registration.addEventListener("updatefound", () => {
    const { installing } = registration;
    installing?.addEventListener("statechange", () => {
      if (installing.state === "installed") offer(installing);
    });
  });
  serviceWorker.addEventListener("controllerchange", () => {
    if (update) location.reload();
    update = true;
  });
  byId("update-later").addEventListener("click", () => (byId("update").hidden = true));
}
