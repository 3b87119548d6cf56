/**
 * Two views in one file: JPEG images one behind the other, listed in an index (CIPA DC-007, "MPF"), as cameras with two
 * lenses write them under the name MPO.
 *
 * The same index also leads to previews and to gain maps of photos with a high dynamic range, which are no views:
 * those are of another size, or say what they are.
 */

/** Entries of the index, each of sixteen bytes. */
const ENTRIES = 0xb002;
/** What a gain map says of itself, in the older and the newer way. */
const GAIN_MAPS = ["hdrgm:", "urn:iso:std:iso:ts:21496"];

/** The first two views of a JPEG file, each a JPEG of its own; `null` when it holds but one. */
export function twoViews(
  bytes: Uint8Array<ArrayBuffer>,
): [Uint8Array<ArrayBuffer>, Uint8Array<ArrayBuffer>] | null {
  const [first, ...others] = indexed(bytes);
  const size = first && sizeOf(first);
  if (!first || !size) return null;
  const second = others.find((other) => sizeOf(other) === size && !isGainMap(other));
  return second ? [first, second] : null;
}

/** The images that the index lists; none without one, or when it leads out of the file. */
function indexed(bytes: Uint8Array<ArrayBuffer>): Uint8Array<ArrayBuffer>[] {
  const view = new DataView(bytes.buffer, bytes.byteOffset, bytes.byteLength);
  const start = indexStart(bytes, view);
  if (start === null) return [];
  try {
    const little = view.getUint16(start) === 0x4949;
    const word = (at: number) => view.getUint32(start + at, little);
    const short = (at: number) => view.getUint16(start + at, little);
    const directory = word(4);
    for (let i = 0; i < short(directory); i++) {
      const field = directory + 2 + 12 * i;
      if (short(field) !== ENTRIES) continue;
      const [length, entries] = [word(field + 4), word(field + 8)];
      return Array.from({ length: length / 16 }, (_, k) => {
        const [size, offset] = [word(entries + 16 * k + 4), word(entries + 16 * k + 8)];
        // The first begins with the file; the others are counted from the index.
        const from = k === 0 ? 0 : start + offset;
        return bytes.subarray(from, from + size);
      }).filter((image) => image[0] === 0xff && image[1] === 0xd8);
    }
  } catch (error) {
    if (!(error instanceof RangeError)) throw error;
  }
  return [];
}

/** Where the index's own addresses begin: after `MPF` in an APP2 segment before the picture. */
function indexStart(bytes: Uint8Array, view: DataView): number | null {
  for (const { marker, at, length } of segments(bytes, view)) {
    const isIndex = marker === 0xe2 && length > 8 && view.getUint32(at) === 0x4d504600;
    if (isIndex) return at + 4;
  }
  return null;
}

/** "width×height", from the frame header. */
function sizeOf(jpeg: Uint8Array): string | null {
  const view = new DataView(jpeg.buffer, jpeg.byteOffset, jpeg.byteLength);
  for (const { marker, at, length } of segments(jpeg, view)) {
    const isFrame = marker >= 0xc0 && marker <= 0xcf && ![0xc4, 0xc8, 0xcc].includes(marker);
    if (isFrame && length >= 5) return `${view.getUint16(at + 3)}×${view.getUint16(at + 1)}`;
  }
  return null;
}

function isGainMap(jpeg: Uint8Array): boolean {
  const view = new DataView(jpeg.buffer, jpeg.byteOffset, jpeg.byteLength);
  const latin = new TextDecoder("latin1");
  for (const { marker, at, length } of segments(jpeg, view)) {
    if (marker !== 0xe1 && marker !== 0xe2) continue;
    const text = latin.decode(jpeg.subarray(at, at + length));
    if (GAIN_MAPS.some((mark) => text.includes(mark))) return true;
  }
  return false;
}

/** Segments before the picture's data: marker, where the contents begin, and how long they are. */
function* segments(bytes: Uint8Array, view: DataView) {
  let at = 2;
  while (at + 4 <= bytes.length && bytes[at] === 0xff) {
    const marker = bytes[at + 1]!;
    const length = view.getUint16(at + 2);
    if (marker === 0xda || length < 2 || at + 2 + length > bytes.length) return;
    yield { marker, at: at + 4, length: length - 2 };
    at += 2 + length;
  }
}
