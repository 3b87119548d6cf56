// What the page may do: load from where it came, run its own WebAssembly, and show what it has made itself.

/** The Content-Security-Policy, for the page's head and for the server's. */
export const POLICY = [
  "default-src 'none'",
  "script-src 'self' 'wasm-unsafe-eval'",
  "style-src 'self'",
  "img-src 'self' blob:",
  "media-src 'self' blob: mediastream:",
  "connect-src 'self' blob:",
  // Clips with transparency are merged by a worker that their reader makes of a blob of its own.
  "worker-src 'self' blob:",
  "manifest-src 'self'",
  "form-action 'none'",
  "base-uri 'none'",
].join("; ");
