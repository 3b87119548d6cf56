/** Files with several moments in them, made for the tests: clips, animations, two views in one. */

import {
  BufferSource,
  BufferTarget,
  EncodedPacketSink,
  EncodedVideoPacketSource,
  Input,
  Mp4OutputFormat,
  Output,
  WEBM,
} from "mediabunny";
import { crc32, deflateSync } from "node:zlib";

import type { Page } from "@playwright/test";

/** A picture in grey levels, in row order. */
export interface Grey {
  width: number;
  height: number;
  data: Uint8Array;
}

/** A texture without a period, and on it a square that moves by `step` pixels a frame; frame `n` says its number. */
export function moments(count: number, step = 4, width = 160, height = 120): Grey[] {
  return Array.from({ length: count }, (_, n) => {
    const data = new Uint8Array(width * height);
    for (let y = 0; y < height; y++) {
      for (let x = 0; x < width; x++) {
        const left = 40 + step * n;
        const on = x >= left && x < left + 40 && y >= 50 && y < 90;
        data[y * width + x] = on ? texture(x - step * n + 300, y + 500) : texture(x, y);
        if (y < 12 && x < 96) data[y * width + x] = (n >> Math.floor(x / 16)) & 1 ? 235 : 20;
      }
    }
    return { width, height, data };
  });
}

function texture(x: number, y: number): number {
  const wave =
    Math.sin(0.21 * x + 0.13 * y + 2 * Math.sin(0.043 * y)) +
    Math.sin(0.23 * y - 0.14 * x + 2 * Math.cos(0.037 * x)) +
    0.7 * Math.sin(0.61 * x - 0.47 * y + 3 * Math.sin(0.05 * x)) +
    0.7 * Math.sin(0.53 * y + 0.51 * x + 3 * Math.cos(0.045 * y));
  return Math.round(127 + 32 * wave);
}

/** The number that a picture of `moments` says, read off a canvas or bitmap of any size. */
export function numberOn(page: Page, selector: string): Promise<number> {
  return page.locator(selector).evaluate((element) => {
    const source = element as HTMLCanvasElement;
    const copy = document.createElement("canvas");
    [copy.width, copy.height] = [160, 120];
    const context = copy.getContext("2d")!;
    context.drawImage(source, 0, 0, 160, 120);
    let number = 0;
    for (let bit = 0; bit < 6; bit++) {
      if (context.getImageData(16 * bit + 8, 6, 1, 1).data[0]! > 127) number |= 1 << bit;
    }
    return number;
  });
}

/** A clip recorded by the browser from a canvas, as `type`; frames come some 40 ms after each other. */
export async function clip(page: Page, frames: Grey[], type = "video/webm"): Promise<Buffer> {
  const text = await page.evaluate(
    async ({ frames, width, height, type }) => {
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [width, height];
      const context = canvas.getContext("2d")!;
      const stream = canvas.captureStream(0);
      const track = stream.getVideoTracks()[0] as CanvasCaptureMediaStreamTrack;
      const recorder = new MediaRecorder(stream, { mimeType: type, videoBitsPerSecond: 12e6 });
      const chunks: Blob[] = [];
      recorder.addEventListener("dataavailable", ({ data }) => chunks.push(data));
      const stopped = new Promise((done) => recorder.addEventListener("stop", done));
      const started = new Promise((begun) => recorder.addEventListener("start", begun));
      recorder.start();
      await Promise.race([started, new Promise((next) => setTimeout(next, 1000))]);
      for (const frame of frames) {
        const bytes = Uint8Array.from(atob(frame), (letter) => letter.charCodeAt(0));
        const picture = context.createImageData(width, height);
        for (const [i, grey] of bytes.entries()) picture.data.set([grey, grey, grey, 255], 4 * i);
        context.putImageData(picture, 0, 0);
        track.requestFrame();
        await new Promise((next) => setTimeout(next, 40));
      }
      recorder.stop();
      await stopped;
      const bytes = new Uint8Array(await new Blob(chunks).arrayBuffer());
      let text = "";
      for (const byte of bytes) text += String.fromCharCode(byte);
      return btoa(text);
    },
    {
      frames: frames.map(({ data }) => Buffer.from(data).toString("base64")),
      width: frames[0]!.width,
      height: frames[0]!.height,
      type,
    },
  );
  return Buffer.from(text, "base64");
}

/** The same film in a container of the kind MP4, for browsers that record none. */
export async function mp4(webm: Buffer): Promise<Buffer> {
  const input = new Input({ source: new BufferSource(webm), formats: [WEBM] });
  const track = await input.getPrimaryVideoTrack();
  const output = new Output({ format: new Mp4OutputFormat(), target: new BufferTarget() });
  const source = new EncodedVideoPacketSource("vp9");
  output.addVideoTrack(source);
  await output.start();
  const decoderConfig = (await track!.getDecoderConfig())!;
  for await (const packet of new EncodedPacketSink(track!).packets()) {
    await source.add(packet, { decoderConfig });
  }
  await output.finalize();
  return Buffer.from(output.target.buffer!);
}

/** A Matroska file that says of its film no more than its codec. */
export function matroska(codec: string): Buffer {
  const element = (id: number[], ...data: (Buffer | number)[]) => {
    const parts = data.map((part) => (typeof part === "number" ? Buffer.from([part]) : part));
    const body = Buffer.concat(parts);
    // A length in eight bytes, of which the first says so.
    const length = Buffer.concat([Buffer.from([1, 0, 0, 0]), words(body.length)]);
    return Buffer.concat([Buffer.from(id), length, body]);
  };
  const video = element([0xe0], element([0xb0], 160), element([0xba], 120));
  const track = element(
    [0xae],
    element([0xd7], 1),
    element([0x73, 0xc5], 1),
    element([0x83], 1),
    element([0x86], Buffer.from(codec)),
    video,
  );
  return Buffer.concat([
    element([0x1a, 0x45, 0xdf, 0xa3], element([0x42, 0x82], Buffer.from("matroska"))),
    element([0x18, 0x53, 0x80, 0x67], element([0x16, 0x54, 0xae, 0x6b], track)),
  ]);
}

/** An animated GIF of 128 greys; the compression's codes are all of eight bits, so that nothing is compressed. */
export function gif(frames: Grey[]): Buffer {
  const { width, height } = frames[0]!;
  const word = (value: number) => [value & 255, value >> 8];
  const out: number[] = [...Buffer.from("GIF89a"), ...word(width), ...word(height), 0xf6, 0, 0];
  for (let i = 0; i < 128; i++) out.push(2 * i, 2 * i, 2 * i);
  for (const { data } of frames) {
    out.push(0x21, 0xf9, 4, 0, 4, 0, 0, 0);
    out.push(0x2c, 0, 0, 0, 0, ...word(width), ...word(height), 0, 7);
    const codes: number[] = [];
    // Cleared before the table would need nine bits.
    for (const [i, grey] of data.entries()) {
      if (i % 100 === 0) codes.push(128);
      codes.push(grey >> 1);
    }
    codes.push(129);
    for (let i = 0; i < codes.length; i += 255) {
      const block = codes.slice(i, i + 255);
      out.push(block.length, ...block);
    }
    out.push(0);
  }
  out.push(0x3b);
  return Buffer.from(out);
}

/** An animated PNG; of one frame, a plain one. */
export function apng(frames: Grey[]): Buffer {
  const { width, height } = frames[0]!;
  const chunk = (name: string, data: Buffer) => {
    const body = Buffer.concat([Buffer.from(name, "latin1"), data]);
    return Buffer.concat([words(data.length), body, words(crc32(body))]);
  };
  const rows = ({ data }: Grey) => {
    const lines = Array.from({ length: height }, (_, y) => [
      Buffer.from([0]),
      Buffer.from(data.subarray(y * width, (y + 1) * width)),
    ]);
    return deflateSync(Buffer.concat(lines.flat()));
  };
  let order = 0;
  const parts = [
    Buffer.from("\x89PNG\r\n\x1a\n", "latin1"),
    chunk("IHDR", Buffer.concat([words(width, height), Buffer.from([8, 0, 0, 0, 0])])),
  ];
  if (frames.length > 1) parts.push(chunk("acTL", words(frames.length, 0)));
  for (const [i, frame] of frames.entries()) {
    if (frames.length > 1) {
      const shown = Buffer.from([0, 1, 0, 25, 0, 0]);
      parts.push(chunk("fcTL", Buffer.concat([words(order++, width, height, 0, 0), shown])));
    }
    parts.push(
      i === 0
        ? chunk("IDAT", rows(frame))
        : chunk("fdAT", Buffer.concat([words(order++), rows(frame)])),
    );
  }
  parts.push(chunk("IEND", Buffer.alloc(0)));
  return Buffer.concat(parts);
}

function words(...values: number[]): Buffer {
  const out = Buffer.alloc(4 * values.length);
  values.forEach((value, i) => out.writeUInt32BE(value >>> 0, 4 * i));
  return out;
}

/** A picture encoded by the browser. */
async function encoded(page: Page, picture: Grey, type: string): Promise<Buffer> {
  const png = apng([picture]).toString("base64");
  const text = await page.evaluate(
    async ({ png, type }) => {
      const picture = new Image();
      picture.src = `data:image/png;base64,${png}`;
      await picture.decode();
      const canvas = document.createElement("canvas");
      [canvas.width, canvas.height] = [picture.width, picture.height];
      canvas.getContext("2d")!.drawImage(picture, 0, 0);
      return canvas.toDataURL(type, 0.95).split(",")[1]!;
    },
    { png, type },
  );
  return Buffer.from(text, "base64");
}

/** An animated WebP: the bitstreams of still ones, each in a frame of its own. */
export async function webp(page: Page, frames: Grey[]): Promise<Buffer> {
  const { width, height } = frames[0]!;
  const small = (value: number) => Buffer.from([value & 255, (value >> 8) & 255, value >> 16]);
  const riff = (name: string, ...data: Buffer[]) => {
    const body = Buffer.concat(data);
    const length = Buffer.alloc(4);
    length.writeUInt32LE(body.length);
    return Buffer.concat([Buffer.from(name), length, body, Buffer.alloc(body.length % 2)]);
  };
  const size = [small(width - 1), small(height - 1)];
  const parts = [riff("VP8X", Buffer.from([2, 0, 0, 0]), ...size), riff("ANIM", Buffer.alloc(6))];
  for (const frame of frames) {
    const still = await encoded(page, frame, "image/webp");
    const stream = Math.max(still.indexOf("VP8 ", 12), still.indexOf("VP8L", 12));
    const length = still.readUInt32LE(stream + 4);
    const bits = still.subarray(stream, stream + 8 + length + (length % 2));
    parts.push(riff("ANMF", Buffer.alloc(6), ...size, small(40), Buffer.from([0]), bits));
  }
  return riff("RIFF", Buffer.from("WEBP"), ...parts);
}

/** Two JPEGs in one file, with the index that leads to the second; `mark` is put into the second. */
export async function mpo(page: Page, views: [Grey, Grey], mark = ""): Promise<Buffer> {
  const [first, second] = await Promise.all(views.map((view) => encoded(page, view, "image/jpeg")));
  const marked = mark ? withSegment(second!, 0xe1, Buffer.from(mark)) : second!;
  const index = (length: number, offset: number) => {
    const entries = words(0x030000, length, 0, 0, 0, marked.length, offset, 0);
    const short = (...values: number[]) => {
      const out = Buffer.alloc(2 * values.length);
      values.forEach((value, i) => out.writeUInt16BE(value, 2 * i));
      return out;
    };
    const field = (tag: number, type: number, count: number, value: number) =>
      Buffer.concat([short(tag, type), words(count, value)]);
    return Buffer.concat([
      Buffer.from("MPF\0MM\0*", "latin1"),
      words(8),
      short(3),
      field(0xb000, 7, 4, 0x30313030),
      field(0xb001, 4, 1, 2),
      field(0xb002, 7, 32, 50),
      words(0),
      entries,
    ]);
  };
  const length = withSegment(first!, 0xe2, index(0, 0)).length;
  // Counted from the byte order, which is ten bytes into the file.
  return Buffer.concat([withSegment(first!, 0xe2, index(length, length - 10)), marked]);
}

/** A photo whose EXIF data say a focal length on 35 mm film. */
export async function photo(page: Page, view: Grey, millimetres: number): Promise<Buffer> {
  const jpeg = await encoded(page, view, "image/jpeg");
  const exif = Buffer.from(
    // A directory that leads to the EXIF directory, which has the one entry.
    "457869660000" +
      "4d4d002a00000008" +
      "0001" +
      "8769000400000001" +
      "0000001a" +
      "00000000" +
      "0001" +
      "a405000300000001" +
      millimetres.toString(16).padStart(4, "0") +
      "0000" +
      "00000000",
    "hex",
  );
  return withSegment(jpeg, 0xe1, exif);
}

/** A picture as PNG. */
export const still = (page: Page, view: Grey) => encoded(page, view, "image/png");

function withSegment(jpeg: Buffer, marker: number, data: Buffer): Buffer {
  const head = Buffer.from([0xff, marker, (data.length + 2) >> 8, (data.length + 2) & 255]);
  return Buffer.concat([jpeg.subarray(0, 2), head, data, jpeg.subarray(2)]);
}
