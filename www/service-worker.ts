/**
 * Keeps the page's own files, so that it opens without a network after the first visit.
 *
 * The build puts the list of files and a hash of them in (`vite.config.ts`): another build is another worker. It waits
 * until the page lets it take over (`installed.ts`), so that no page runs on files of two builds.
 */

export {};

declare const self: ServiceWorkerGlobalScope;
declare const __FILES__: string[];
declare const __BUILD__: string;

const PREFIX = "relievo-";
const CACHE = PREFIX + __BUILD__;
const FILES = new Set(__FILES__.map((file) => new URL(file, self.location.href).href));
const PAGE = new URL("./", self.location.href).href;

self.addEventListener("install", (event) => {
  event.waitUntil(caches.open(CACHE).then((cache) => cache.addAll([PAGE, ...FILES])));
});

self.addEventListener("activate", (event) => {
  event.waitUntil(
    (async () => {
      for (const name of await caches.keys()) {
        if (name.startsWith(PREFIX) && name !== CACHE) await caches.delete(name);
      }
      await self.clients.claim();
    })(),
  );
});

self.addEventListener("message", (event) => {
  if (event.data === "take over") void self.skipWaiting();
});

self.addEventListener("fetch", (event) => {
  const { request } = event;
  const { origin, pathname, href } = new URL(request.url);
  if (request.method !== "GET" || origin !== self.location.origin) return;
  const isPage = request.mode === "navigate" && origin + pathname === PAGE;
  const key = isPage ? PAGE : href;
  if (isPage || FILES.has(href)) event.respondWith(kept(key, request));
});

async function kept(key: string, request: Request): Promise<Response> {
  const cache = await caches.open(CACHE);
  return (await cache.match(key)) ?? fetch(request);
}
