// Serves dist/ as it should be served: compressed, with the policy that keeps the page to itself, built files for good and
// the page itself asked for anew each time.

import { createServer } from "node:http";
import { join } from "node:path";
import { parseArgs } from "node:util";

import { POLICY } from "./policy.js";
import { ifMain, root } from "./shell.js";

const HEADERS = {
  // What a page's head cannot say.
  "Content-Security-Policy": `${POLICY}; frame-ancestors 'none'`,
  "X-Content-Type-Options": "nosniff",
  "Referrer-Policy": "no-referrer",
  "Cross-Origin-Opener-Policy": "same-origin",
};

/**
 * Serves until the process ends; the address once it listens.
 * @param {string} host
 * @param {number} port
 * @returns {Promise<string>}
 */
export async function serve(host, port) {
  const { default: sirv } = await import("sirv");
  const files = sirv(join(root, "dist"), {
    brotli: true,
    gzip: true,
    etag: true,
    // Read anew for each request: a build may come meanwhile.
    dev: true,
    setHeaders(response, path) {
      for (const [name, value] of Object.entries(HEADERS)) response.setHeader(name, value);
      const built = path.startsWith("/assets/");
      const lasting = "public, max-age=31536000, immutable";
      response.setHeader("Cache-Control", built ? lasting : "no-cache");
    },
  });
  const server = createServer((request, response) =>
    files(request, response, () => {
      response.writeHead(404, HEADERS).end("Not found");
    }),
  );
  return new Promise((resolve, reject) => {
    server.on("error", reject);
    server.listen(port, host, () => resolve(`http://${host}:${port}/`));
  });
}

await ifMain(import.meta.url, async () => {
  const { values } = parseArgs({ options: { host: { type: "string" }, port: { type: "string" } } });
  console.log(await serve(values.host ?? "127.0.0.1", Number(values.port ?? 5173)));
});
