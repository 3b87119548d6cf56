/**
 * What a file is, by its first bytes: names of files lie.
 *
 * Who opens it: the core decodes `still` images of its own formats; the browser those that it alone may know
 * (`browser`); an `animation` or a `video` holds several moments; nobody here opens what is `foreign`.
 */

export type Reader = "core" | "browser" | "animation" | "video" | "foreign";

export interface Format {
  /** What people call it. */
  name: string;
  reader: Reader;
  /** Media type, where the browser must be told. */
  type: string;
}

/** Bytes that are enough to tell: colour profiles may come before the mark of an animated PNG. */
export const ENOUGH = 1 << 18;

const format = (name: string, reader: Reader, type = ""): Format => ({ name, reader, type });

/** Marks at the beginning of a file, `.` standing for any byte. */
const MARKS: [string, Format][] = [
  ["\xff\xd8\xff", format("JPEG", "core", "image/jpeg")],
  ["GIF8", format("GIF", "animation", "image/gif")],
  ["BM", format("BMP", "core", "image/bmp")],
  ["II*\0........CR", format("Canon raw", "foreign")],
  ["II*\0", format("TIFF", "core", "image/tiff")],
  ["MM\0*", format("TIFF", "core", "image/tiff")],
  ["\xff\x0a", format("JPEG XL", "browser", "image/jxl")],
  ["\0\0\0\x0cJXL ", format("JPEG XL", "browser", "image/jxl")],
  ["\0\0\0\x0cjP  ", format("JPEG 2000", "browser", "image/jp2")],
  ["\0\0\x01\0", format("ICO", "browser", "image/x-icon")],
  ["8BPS", format("Photoshop", "foreign")],
  ["v/1\x01", format("OpenEXR", "foreign")],
  ["#?RADIANCE", format("Radiance HDR", "foreign")],
  ["FUJIFILM", format("Fujifilm raw", "foreign")],
  ["IIRO", format("Olympus raw", "foreign")],
  ["%PDF", format("PDF", "foreign")],
  ["\x1a\x45\xdf\xa3", format("WebM or Matroska", "video", "video/webm")],
  ["OggS", format("Ogg", "video", "video/ogg")],
  ["RIFF....AVI ", format("AVI", "video")],
  ["\x30\x26\xb2\x75\x8e\x66\xcf\x11", format("Windows Media", "video")],
  ["\0\0\x01\xba", format("MPEG", "video", "video/mpeg")],
  ["\0\0\x01\xb3", format("MPEG", "video", "video/mpeg")],
  ["FLV\x01", format("Flash video", "video")],
];

/** Brands of files that begin with `ftyp`. */
const BRANDS: [RegExp, Format][] = [
  [/^avis/, format("AVIF", "animation", "image/avif")],
  [/^avif/, format("AVIF", "browser", "image/avif")],
  [/^(hei[cxms]|hev[cxms]|mif1|msf1)/, format("HEIC", "browser", "image/heic")],
  [/^crx /, format("Canon raw", "foreign")],
  [/^qt /, format("MOV", "video", "video/quicktime")],
  [/./, format("MP4", "video", "video/mp4")],
];

/** Boxes with which a QuickTime film of the time before `ftyp` begins. */
const QUICKTIME = ["moov", "mdat", "wide", "free", "skip"];

/** What the file is; `null` when its first bytes are nothing that is known here. The core then has the word. */
export function formatOf(head: Uint8Array): Format | null {
  const text = (from: number, length: number) =>
    String.fromCharCode(...head.subarray(from, from + length));
  const start = text(0, 16);
  const box = text(4, 4);
  if (box === "ftyp") {
    // An AVIF may be called a picture of some kind first.
    const brands = text(8, Math.min(64, head.length - 8));
    if (/^mif1/.test(brands) && /avif/.test(brands)) return BRANDS[1]![1];
    return BRANDS.find(([brand]) => brand.test(brands))?.[1] ?? null;
  }
  if (QUICKTIME.includes(box)) return format("MOV", "video", "video/quicktime");
  if (start.startsWith("\x89PNG")) {
    return format("PNG", animatedPng(head) ? "animation" : "core", "image/png");
  }
  if (start.startsWith("RIFF") && text(8, 4) === "WEBP") {
    const animated = text(12, 4) === "VP8X" && (head[20]! & 2) !== 0;
    return format("WebP", animated ? "animation" : "core", "image/webp");
  }
  const matches = (mark: string) =>
    [...mark].every((letter, i) => letter === "." || letter === start[i]);
  return MARKS.find(([mark]) => matches(mark))?.[1] ?? null;
}

/** Whether `acTL` comes before the first picture, as it must in an animated PNG. */
function animatedPng(head: Uint8Array): boolean {
  const view = new DataView(head.buffer, head.byteOffset, head.byteLength);
  for (let at = 8; at + 8 <= head.length; at += view.getUint32(at) + 12) {
    const chunk = String.fromCharCode(...head.subarray(at + 4, at + 8));
    if (chunk === "acTL") return true;
    if (chunk === "IDAT") return false;
  }
  return false;
}

/** The first bytes of a file. */
export async function headOf(file: Blob): Promise<Uint8Array<ArrayBuffer>> {
  return new Uint8Array(await file.slice(0, ENOUGH).arrayBuffer());
}
