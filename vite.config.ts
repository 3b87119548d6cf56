import { createHash } from "node:crypto";
import { readdirSync, readFileSync } from "node:fs";
import { join } from "node:path";
import { fileURLToPath } from "node:url";

import { defineConfig, type Plugin } from "vite";

import { POLICY } from "./scripts/policy.js";
import { markup } from "./www/text/en/markup";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

const WORKER = "service-worker.js";

/** Puts the words into the page, where their keys stand in double braces. */
const words: Plugin = {
  name: "words",
  transformIndexHtml: {
    order: "pre",
    handler: (html) =>
      html.replace(/\{\{(\w+)\}\}/g, (_, key: string) => {
        const word = (markup as Record<string, string>)[key];
        if (word === undefined)
          throw new Error(`index.html asks for words that there are not: ${key}`);
        return word.replaceAll("&", "&amp;").replaceAll('"', "&quot;").replaceAll("<", "&lt;");
      }),
  },
};

/** The policy in the page's head, so that it holds on any server; styles of `npm run dev` would not pass it. */
const policy: Plugin = {
  name: "policy",
  apply: "build",
  transformIndexHtml: () => [
    {
      tag: "meta",
      attrs: { "http-equiv": "Content-Security-Policy", content: POLICY },
      injectTo: "head-prepend",
    },
  ],
};

/** Tells the service worker which files there are. */
const files: Plugin = {
  name: "files",
  apply: "build",
  generateBundle: {
    order: "post",
    handler(_, bundle) {
      const built = Object.values(bundle).filter(({ fileName }) => fileName !== WORKER);
      const open = here("www/public");
      const copied = readdirSync(open).map(
        (name) => [name, readFileSync(join(open, name))] as const,
      );
      const hash = createHash("sha256");
      for (const output of built) {
        hash.update(output.fileName).update(output.type === "asset" ? output.source : output.code);
      }
      for (const [name, bytes] of copied) hash.update(name).update(bytes);
      const names = [...built.map(({ fileName }) => fileName), ...copied.map(([name]) => name)];
      const worker = bundle[WORKER];
      if (worker?.type !== "chunk" || !bundle["index.html"]) {
        throw new Error("the service worker needs the page and itself");
      }
      const list = names.filter((name) => name !== "index.html").map((name) => `./${name}`);
      worker.code = worker.code
        .replace("__FILES__", JSON.stringify(list))
        .replace("__BUILD__", JSON.stringify(hash.digest("hex").slice(0, 16)));
    },
  },
};

export default defineConfig({
  root: here("www"),
  // Relative addresses, so that the built page can be put into any folder of any server.
  base: "./",
  plugins: [words, policy, files],
  build: {
    outDir: here("dist"),
    emptyOutDir: true,
    target: "es2022",
    // Small pictures are files as well: nothing in the page needs data: addresses.
    assetsInlineLimit: 0,
    // three.js alone is more than the usual limit; it comes only with the relief.
    chunkSizeWarningLimit: 700,
    modulePreload: { polyfill: false },
    rollupOptions: {
      input: [here("www/index.html"), here("www/service-worker.ts")],
      output: {
        // Its address is what browsers know it by.
        entryFileNames: ({ name }) =>
          name === "service-worker" ? WORKER : "assets/[name]-[hash].js",
        // What the page needs from the start is one file: it is smaller than parts that are shared with what comes later.
        codeSplitting: { groups: [{ name: "page", test: /[\\/]www[\\/]main\.ts$/ }] },
      },
    },
  },
  worker: { format: "es" },
  // The WebAssembly lies beside www/, not in it.
  server: { fs: { allow: [here(".")] } },
});
