/** A result's bytes made small, and back, by the browser's own means. */

const FORMAT = "deflate-raw";

export const squeeze = (bytes: Uint8Array<ArrayBuffer>) =>
  through(bytes, new CompressionStream(FORMAT));

/** How the core's bytes begin: a result, a solver's state. */
const MAGIC = ["RLV1", "RLS1"];

/** Bytes that were never squeezed are left as they are. */
export async function unsqueeze(bytes: Uint8Array<ArrayBuffer>): Promise<Uint8Array<ArrayBuffer>> {
  const begin = String.fromCharCode(...bytes.subarray(0, 4));
  return MAGIC.includes(begin) ? bytes : through(bytes, new DecompressionStream(FORMAT));
}

async function through(
  bytes: Uint8Array<ArrayBuffer>,
  stream: CompressionStream | DecompressionStream,
): Promise<Uint8Array<ArrayBuffer>> {
  const out = new Blob([bytes]).stream().pipeThrough(stream);
  return new Uint8Array(await new Response(out).arrayBuffer());
}
