// Reads frames of the live view for tests, without any code of the page.

/// A half float from its 16 bits.
export function halfToNumber(bits) {
  const sign = bits & 0x8000 ? -1 : 1;
  const exponent = (bits >> 10) & 31;
  const fraction = bits & 1023;
  if (exponent === 0) return sign * fraction * 2 ** -24;
  if (exponent === 31) return fraction ? NaN : sign * Infinity;
  return sign * (1 + fraction / 1024) * 2 ** (exponent - 15);
}

/// A frame with all tiles: {header, value(layer, x, y)}, x and y from the corner of the window.
export function readFrame(bytes) {
  if (bytes.toString('latin1', 0, 4) !== 'NPHV') throw new Error('frame: wrong magic number');
  const length = bytes.readUInt32LE(8);
  const header = JSON.parse(bytes.toString('utf8', 12, 12 + length));
  const width = header.window[2] - header.window[0];
  const height = header.window[3] - header.window[1];
  const columns = Math.ceil(width / header.tile);
  const layers = new Map();
  let at = 12 + length;
  for (const layer of header.layers) {
    const channels = layer.channels.length;
    const values = new Float64Array(width * height * channels);
    for (const tile of header.tiles) {
      const left = (tile % columns) * header.tile;
      const top = Math.floor(tile / columns) * header.tile;
      for (let y = top; y < Math.min(top + header.tile, height); ++y) {
        for (let x = left; x < Math.min(left + header.tile, width); ++x) {
          for (let channel = 0; channel < channels; ++channel, at += 2) {
            values[(y * width + x) * channels + channel] =
              layer.scale * halfToNumber(bytes.readUInt16LE(at));
          }
        }
      }
    }
    layers.set(layer.name, { channels, values });
  }
  const value = (name, x, y) => {
    const { channels, values } = layers.get(name);
    const start = (y * width + x) * channels;
    return [...values.subarray(start, start + channels)];
  };
  return { header, value };
}
