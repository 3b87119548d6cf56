/** No request leaves the origin, no script but the page's own runs, and what is sent is sent compressed. */

import { expect, open, read, solve, test, until, pressView } from "./helpers";

test.use({ bypassCSP: false });

test("a strict policy holds, in the head and from the server, and nothing breaks it", async ({
  page,
  baseURL,
}) => {
  const strangers: string[] = [];
  page.on("request", (request) => {
    if (!request.url().startsWith(baseURL!) && !request.url().startsWith("blob:")) {
      strangers.push(request.url());
    }
  });
  await page.addInitScript(() => {
    const broken: string[] = [];
    Object.assign(window, { broken });
    document.addEventListener("securitypolicyviolation", (event) =>
      broken.push(`${event.violatedDirective} ${event.blockedURI}`),
    );
  });
  await open(page);
  await solve(page);
  for (const view of ["Depth", "Anaglyph", "Compare"]) {
    await pressView(page, view);
  }
  await until(page, ({ pictured }) => pictured.startsWith("compare"));
  await pressView(page, "Relief");
  await expect(page.locator("#relief canvas")).toBeVisible();
  const broken = await page.evaluate(() => (window as unknown as { broken: string[] }).broken);
  expect(broken).toEqual([]);
  expect(strangers).toEqual([]);

  const head = page.locator("meta[http-equiv=Content-Security-Policy]");
  const policy = (await head.getAttribute("content"))!;
  expect(policy).toContain("default-src 'none'");
  expect(policy).toContain("'wasm-unsafe-eval'");
  expect(policy).not.toContain("unsafe-inline");
  expect(policy).not.toContain(" *");
  // It holds: nobody else's script, no request to elsewhere.
  const refused = await page.evaluate(async () => {
    const script = document.createElement("script");
    script.textContent = "window.intruded = true";
    document.body.append(script);
    const sent = await fetch("https://example.org/").then(
      () => true,
      () => false,
    );
    return { sent, intruded: "intruded" in window };
  });
  expect(refused).toEqual({ sent: false, intruded: false });
});

test("all is served compressed, and WebAssembly so that it compiles as it comes", async ({
  page,
  request,
  baseURL,
}) => {
  const types = new Map<string, { encoding: string; bytes: number }>();
  page.on("response", async (response) => {
    const { pathname } = new URL(response.url());
    const kind = pathname.split(".").pop()!;
    if (!["wasm", "js", "css"].includes(kind)) return;
    const headers = await response.allHeaders();
    types.set(pathname, {
      encoding: headers["content-encoding"] ?? "none",
      bytes: Number(headers["content-length"]),
    });
    if (kind === "wasm") expect(headers["content-type"]).toBe("application/wasm");
    expect(headers["content-security-policy"]).toContain("default-src 'none'");
  });
  await open(page);
  expect(types.size).toBeGreaterThan(3);
  for (const [path, { encoding }] of types) expect(encoding, path).toMatch(/br|gzip/);
  const streamed = await page.evaluate(() => typeof WebAssembly.instantiateStreaming);
  expect(streamed).toBe("function");
  const plain = await request.get(baseURL!, { headers: { "Accept-Encoding": "identity" } });
  expect(plain.headers()["content-encoding"]).toBeUndefined();
  await until(page, ({ frames }) => frames !== null);
  expect(await read(page, ({ message }) => message)).toBeNull();
});
