// Textures of one picture: its layers as they come, float16 with a scale a tile, and their sum.
// It must not know of gains, of the display or of the protocol's requests.

import { tileRectangle, windowSize } from './protocol.js';

const kPollMs = 8;

/// The layers of a picture in a texture array. Frames of the same shape renew single tiles.
export class LayerTextures {
  #gl;
  #layers = null;
  #scales = null;
  #shape = '';
  header = null; // of the last frame

  constructor(gl) {
    this.#gl = gl;
  }

  /// Layers of a frame must have the same number of channels, one to three.
  accept({ header, halves }) {
    const shape = JSON.stringify([windowSize(header), header.tile, header.layers.map(
      (layer) => [layer.name, layer.channels])]);
    if (shape !== this.#shape) this.#allocate(header);
    this.#shape = shape;
    this.header = header;
    this.#upload(header, halves);
  }

  bind(layerUnit, scaleUnit) {
    bindTexture(this.#gl, layerUnit, this.#gl.TEXTURE_2D_ARRAY, this.#layers);
    bindTexture(this.#gl, scaleUnit, this.#gl.TEXTURE_2D_ARRAY, this.#scales);
  }

  release() {
    this.#gl.deleteTexture(this.#layers);
    this.#gl.deleteTexture(this.#scales);
    this.#layers = this.#scales = this.header = null;
    this.#shape = '';
  }

  #allocate(header) {
    const gl = this.#gl;
    const [width, height] = windowSize(header);
    const count = header.layers.length;
    const rows = Math.ceil(height / header.tile);
    const columns = Math.ceil(width / header.tile);
    const format = [gl.R16F, gl.RG16F, gl.RGB16F][header.layers[0].channels.length - 1];
    this.release();
    this.#layers = arrayTexture(gl, format, width, height, count);
    this.#scales = arrayTexture(gl, gl.R32F, columns, rows, count);
  }

  #upload(header, halves) {
    const gl = this.#gl;
    const columns = Math.ceil(windowSize(header)[0] / header.tile);
    const scale = new Float32Array(1);
    let start = 0;
    gl.pixelStorei(gl.UNPACK_ALIGNMENT, 2);
    header.layers.forEach((layer, index) => {
      const channels = layer.channels.length;
      const format = [gl.RED, gl.RG, gl.RGB][channels - 1];
      scale[0] = layer.scale;
      for (const tile of header.tiles) {
        const { x, y, width, height } = tileRectangle(header, tile);
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.#layers);
        gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, x, y, index, width, height, 1, format,
          gl.HALF_FLOAT, halves, start);
        gl.bindTexture(gl.TEXTURE_2D_ARRAY, this.#scales);
        gl.texSubImage3D(gl.TEXTURE_2D_ARRAY, 0, tile % columns, Math.floor(tile / columns), index,
          1, 1, 1, gl.RED, gl.FLOAT, scale);
        start += channels * width * height;
      }
    });
  }
}

/// A float texture to draw into, row 0 at the top of the picture.
export class FloatTarget {
  #gl;
  #format;
  #framebuffer = null;
  texture = null;
  width = 0;
  height = 0;

  constructor(gl, format) {
    this.#gl = gl;
    this.#format = format;
  }

  resize(width, height) {
    if (width === this.width && height === this.height) return;
    const gl = this.#gl;
    this.release();
    [this.width, this.height] = [width, height];
    this.texture = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.texture);
    gl.texStorage2D(gl.TEXTURE_2D, 1, this.#format, width, height);
    setNearest(gl, gl.TEXTURE_2D);
    this.#framebuffer = gl.createFramebuffer();
    gl.bindFramebuffer(gl.FRAMEBUFFER, this.#framebuffer);
    gl.framebufferTexture2D(gl.FRAMEBUFFER, gl.COLOR_ATTACHMENT0, gl.TEXTURE_2D, this.texture, 0);
  }

  /// Makes it the place that is drawn into and read from.
  use() {
    this.#gl.bindFramebuffer(this.#gl.FRAMEBUFFER, this.#framebuffer);
    this.#gl.viewport(0, 0, this.width, this.height);
  }

  /// Four numbers a pixel of a rectangle.
  read(x, y, width, height) {
    const values = new Float32Array(4 * width * height);
    this.use();
    this.#gl.readPixels(x, y, width, height, this.#gl.RGBA, this.#gl.FLOAT, values);
    return values;
  }

  /// Promises four numbers for each pixel, without waiting for the graphics card.
  async readLater() {
    const gl = this.#gl;
    const values = new Float32Array(4 * this.width * this.height);
    const buffer = gl.createBuffer();
    this.use();
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.bufferData(gl.PIXEL_PACK_BUFFER, values.byteLength, gl.STREAM_READ);
    gl.readPixels(0, 0, this.width, this.height, gl.RGBA, gl.FLOAT, 0);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    await finished(gl);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, buffer);
    gl.getBufferSubData(gl.PIXEL_PACK_BUFFER, 0, values);
    gl.bindBuffer(gl.PIXEL_PACK_BUFFER, null);
    gl.deleteBuffer(buffer);
    return values;
  }

  release() {
    this.#gl.deleteFramebuffer(this.#framebuffer);
    this.#gl.deleteTexture(this.texture);
    this.#framebuffer = this.texture = null;
    this.width = this.height = 0;
  }
}

// Waits until the card has done all that it was told so far.
async function finished(gl) {
  const fence = gl.fenceSync(gl.SYNC_GPU_COMMANDS_COMPLETE, 0);
  if (!fence) return; // the card is lost
  gl.flush();
  while (gl.clientWaitSync(fence, 0, 0) === gl.TIMEOUT_EXPIRED) {
    await new Promise((resolve) => { setTimeout(resolve, kPollMs); });
  }
  gl.deleteSync(fence);
}

export function bindTexture(gl, unit, target, texture) {
  gl.activeTexture(gl.TEXTURE0 + unit);
  gl.bindTexture(target, texture);
}

export function setNearest(gl, target) {
  gl.texParameteri(target, gl.TEXTURE_MIN_FILTER, gl.NEAREST);
  gl.texParameteri(target, gl.TEXTURE_MAG_FILTER, gl.NEAREST);
  gl.texParameteri(target, gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
  gl.texParameteri(target, gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
}

function arrayTexture(gl, format, width, height, count) {
  const texture = gl.createTexture();
  gl.bindTexture(gl.TEXTURE_2D_ARRAY, texture);
  gl.texStorage3D(gl.TEXTURE_2D_ARRAY, 1, format, width, height, count);
  setNearest(gl, gl.TEXTURE_2D_ARRAY);
  return texture;
}
