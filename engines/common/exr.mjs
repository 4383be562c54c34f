// Writes OpenEXR files with one part of uncompressed scanlines of 32-bit floats.
import { closeSync, openSync, writeSync } from "node:fs";

const text = (string) => Buffer.from(string + "\0", "latin1");

function int32(...values) {
  const bytes = Buffer.alloc(4 * values.length);
  values.forEach((value, i) => bytes.writeInt32LE(value, 4 * i));
  return bytes;
}

function float32(...values) {
  return Buffer.from(new Float32Array(values).buffer);
}

function attribute(name, type, ...parts) {
  const value = Buffer.concat(parts);
  return Buffer.concat([text(name), text(type), int32(value.length), value]);
}

function header(names, width, height) {
  const pixelTypeFloat = 2;
  const box = int32(0, 0, width - 1, height - 1);
  const channels = names.map((name) => Buffer.concat([text(name), int32(pixelTypeFloat, 0, 1, 1)]));
  return Buffer.concat([
    int32(20000630, 2), // the format's magic number, and its version
    attribute("channels", "chlist", ...channels, Buffer.from([0])),
    attribute("compression", "compression", Buffer.from([0])),
    attribute("dataWindow", "box2i", box),
    attribute("displayWindow", "box2i", box),
    attribute("lineOrder", "lineOrder", Buffer.from([0])),
    attribute("pixelAspectRatio", "float", float32(1)),
    attribute("screenWindowCenter", "v2f", float32(0, 0)),
    attribute("screenWindowWidth", "float", float32(1)),
    Buffer.from([0]),
  ]);
}

/**
 * Writes an EXR file.
 * @param channels  name → (x, y) => number; rows count from the top.
 * @throws Error  if the file cannot be written.
 */
export function writeExr(file, width, height, channels) {
  const names = Object.keys(channels).sort();
  const head = header(names, width, height);
  const rowBytes = 8 + 4 * names.length * width;
  const first = head.length + 8 * height;
  const offsets = Buffer.alloc(8 * height);
  const rows = Buffer.alloc(rowBytes * height);
  const row = new Float32Array(names.length * width);
  for (let y = 0; y < height; ++y) {
    offsets.writeBigUInt64LE(BigInt(first + y * rowBytes), 8 * y);
    names.forEach((name, c) => {
      const value = channels[name];
      for (let x = 0; x < width; ++x) row[c * width + x] = value(x, y);
    });
    int32(y, rowBytes - 8).copy(rows, y * rowBytes);
    Buffer.from(row.buffer).copy(rows, y * rowBytes + 8);
  }
  const target = openSync(file, "w");
  try {
    [head, offsets, rows].forEach((part) => {
      for (let done = 0; done < part.length;) done += writeSync(target, part, done);
    });
  } finally {
    closeSync(target);
  }
}
