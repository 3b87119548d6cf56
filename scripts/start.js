// npm start: set up, build, serve, and say where. With --dev the page reloads as its files change.

import { parseArgs } from "node:util";

import { ifMain, root, Trouble } from "./shell.js";
import { serve } from "./serve.js";
import { setup } from "./setup.js";
import { build } from "./build.js";
import { recordings } from "./recordings.js";

const USAGE = "npm start [-- [--port PORT] [--host HOST]]";

function options() {
  try {
    const { values } = parseArgs({
      options: {
        dev: { type: "boolean", default: false },
        host: { type: "string", default: "127.0.0.1" },
        port: { type: "string", default: "5173" },
      },
    });
    const port = Number(values.port);
    if (!(Number.isInteger(port) && port > 0 && port < 65536)) throw new Error();
    return { dev: values.dev, host: values.host, port };
  } catch {
    throw new Trouble(`Usage: ${USAGE}`);
  }
}

/**
 * The page from its sources.
 * @param {string} host
 * @param {number} port
 */
async function serveSources(host, port) {
  // Only now is Vite sure to be installed.
  const vite = await import("vite");
  const common = { configFile: `${root}/vite.config.ts`, root: `${root}/www` };
  const server = await vite.createServer({ ...common, server: { host, port } });
  await server.listen();
  return server.resolvedUrls?.local[0] ?? `http://${host}:${port}/`;
}

await ifMain(import.meta.url, async () => {
  const { dev, host, port } = options();
  await setup();
  if (dev) await recordings();
  else await build();

  const address = dev ? await serveSources(host, port) : await serve(host, port);
  console.log(`\nRelievo is at ${address}\nPress Ctrl-C to stop.`);
});
