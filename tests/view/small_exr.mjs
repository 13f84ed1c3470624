// Writes an EXR of float channels for tests, without compression.
import { writeFileSync } from 'node:fs';

const kFloat = 2; // pixel type

function attribute(name, type, bytes) {
  const size = Buffer.alloc(4);
  size.writeInt32LE(bytes.length);
  return Buffer.concat([Buffer.from(`${name}\0${type}\0`), size, bytes]);
}

function integers(...values) {
  const bytes = Buffer.alloc(4 * values.length);
  values.forEach((value, index) => bytes.writeInt32LE(value, 4 * index));
  return bytes;
}

function floats(...values) {
  return Buffer.from(new Float32Array(values).buffer);
}

/// value: (channel's name, x, y) => number.
export function writeExr(file, width, height, channels, value) {
  const names = [...channels].sort(); // as the format wants them
  const list = Buffer.concat([...names.map((name) => Buffer.concat([
    Buffer.from(`${name}\0`), integers(kFloat, 0, 1, 1)])), Buffer.from([0])]);
  const box = integers(0, 0, width - 1, height - 1);
  const header = Buffer.concat([
    Buffer.from([0x76, 0x2f, 0x31, 0x01]), integers(2),
    attribute('channels', 'chlist', list), attribute('compression', 'compression', Buffer.from([0])),
    attribute('dataWindow', 'box2i', box), attribute('displayWindow', 'box2i', box),
    attribute('lineOrder', 'lineOrder', Buffer.from([0])),
    attribute('pixelAspectRatio', 'float', floats(1)),
    attribute('screenWindowCenter', 'v2f', floats(0, 0)),
    attribute('screenWindowWidth', 'float', floats(1)), Buffer.from([0])]);
  const rowBytes = 4 * width * names.length;
  const offsets = Buffer.alloc(8 * height);
  const rows = Array.from({ length: height }, (_, y) => {
    offsets.writeBigUInt64LE(BigInt(header.length + offsets.length + y * (8 + rowBytes)), 8 * y);
    const values = names.flatMap((name) => Array.from({ length: width }, (__, x) =>
      value(name, x, y)));
    return Buffer.concat([integers(y, rowBytes), floats(...values)]);
  });
  writeFileSync(file, Buffer.concat([header, offsets, ...rows]));
}
