import { fileURLToPath } from "node:url";

import { defineConfig } from "vite";

const here = (path: string) => fileURLToPath(new URL(path, import.meta.url));

export default defineConfig({
  root: here("www"),
  // Relative addresses, so that the built page can be put into any folder of any server.
  base: "./",
  build: {
    outDir: here("dist"),
    emptyOutDir: true,
    target: "es2022",
    // Small pictures are files as well: nothing in the page needs data: addresses.
    assetsInlineLimit: 0,
    // three.js alone is more than the usual limit; it comes only with the relief.
    chunkSizeWarningLimit: 700,
  },
  worker: { format: "es" },
  // The WebAssembly lies beside www/, not in it.
  server: { fs: { allow: [here(".")] } },
});
