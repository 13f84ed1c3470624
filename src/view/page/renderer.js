// Draws the picture: sums its layers into a float texture, then shows that on the canvas.
// It must not know of the server or of the panels; what to show comes as plain values.

import { kFalseColors, kMaxLayers, linkPrograms } from './shaders.js';
import { bindTexture, FloatTarget, LayerTextures, setNearest } from './textures.js';

const kCompareModes = { none: 0, split: 1, other: 2, difference: 3, heat: 4 };
const kCurves = { srgb: 0, filmic: 1, false: 2 };
const kContents = { light: 0, reflectance: 1, directions: 2, number: 3 };

/// A picture on the graphics card: layers and their sum.
class Picture {
  constructor(gl, format) {
    this.layers = new LayerTextures(gl);
    this.sum = new FloatTarget(gl, format);
    this.weights = '';
  }

  get header() { return this.layers.header; }

  release() {
    this.layers.release();
    this.sum.release();
  }
}

export class Renderer {
  #gl;
  #programs;
  #grid;
  #heat = null;
  #blank;
  #pictures;

  /// Throws if the browser cannot draw float pictures.
  constructor(canvas) {
    const gl = canvas.getContext('webgl2', { alpha: false, antialias: false, depth: false });
    if (!gl) throw new Error('This page needs WebGL 2. Switch it on, or use another browser.');
    const full = gl.getExtension('EXT_color_buffer_float');
    if (!full && !gl.getExtension('EXT_color_buffer_half_float')) {
      throw new Error('This page needs float pictures, which this graphics card cannot draw.');
    }
    const format = full ? gl.RGBA32F : gl.RGBA16F;
    this.#gl = gl;
    this.#programs = linkPrograms(gl);
    this.#grid = new FloatTarget(gl, format);
    this.#pictures = { current: new Picture(gl, format), other: new Picture(gl, format) };
    this.#blank = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.#blank);
    gl.texStorage2D(gl.TEXTURE_2D, 1, gl.RGBA8, 1, 1);
    setNearest(gl, gl.TEXTURE_2D);
  }

  get contextLost() { return this.#gl.isContextLost(); }

  /// Header of the frame that is shown as "current" or "other", or null.
  header(slot) {
    return this.#pictures[slot].header;
  }

  setFrame(slot, frame) {
    this.#pictures[slot].layers.accept(frame);
    this.#pictures[slot].weights = '';
  }

  clear(slot) {
    this.#pictures[slot].release();
  }

  /// An ImageBitmap that covers the picture, or null.
  setHeat(bitmap) {
    const gl = this.#gl;
    gl.deleteTexture(this.#heat);
    this.#heat = null;
    if (!bitmap) return;
    this.#heat = gl.createTexture();
    gl.bindTexture(gl.TEXTURE_2D, this.#heat);
    gl.texImage2D(gl.TEXTURE_2D, 0, gl.RGBA8, gl.RGBA, gl.UNSIGNED_BYTE, bitmap);
    setNearest(gl, gl.TEXTURE_2D);
  }

  /// Sums the layers, if the frame or the weights changed. weightOf: name to three factors.
  sum(slot, weightOf) {
    const picture = this.#pictures[slot];
    if (!picture.header) return;
    const layers = picture.header.layers.slice(0, kMaxLayers);
    const weights = layers.flatMap((layer) => weightOf(layer.name));
    if (picture.weights === String(weights)) return;
    picture.weights = String(weights);
    const gl = this.#gl;
    const { program, at } = this.#programs.sum;
    const [x0, y0, x1, y1] = picture.header.window;
    picture.sum.resize(x1 - x0, y1 - y0);
    picture.sum.use();
    gl.useProgram(program);
    picture.layers.bind(0, 1);
    gl.uniform1i(at.layers, 0);
    gl.uniform1i(at.scales, 1);
    gl.uniform1i(at.count, layers.length);
    gl.uniform1i(at.tile, picture.header.tile);
    gl.uniform1i(at.scalar, Number(layers[0].channels.length === 1));
    gl.uniform3fv(at.weights, weights);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /// Shows the sums. look: values of Display; view: ViewTransform; compare: {mode, split}.
  draw(view, look, compare) {
    const gl = this.#gl;
    const { program, at } = this.#programs.show;
    gl.bindFramebuffer(gl.FRAMEBUFFER, null);
    gl.viewport(0, 0, gl.drawingBufferWidth, gl.drawingBufferHeight);
    gl.useProgram(program);
    this.#bindPictures(at, view);
    gl.uniform2fv(at.frameSize, view.pictureSize);
    gl.uniform1f(at.canvasHeight, gl.drawingBufferHeight);
    gl.uniform2f(at.origin, view.x, view.y);
    gl.uniform1f(at.zoom, view.zoom);
    gl.uniform1i(at.smoothed, Number(view.fitted));
    gl.uniform1i(at.compare, kCompareModes[this.#possible(compare.mode)]);
    gl.uniform1f(at.split, compare.split * gl.drawingBufferWidth);
    gl.uniform1f(at.exposure, look.exposure);
    gl.uniformMatrix3fv(at.balance, false, look.balance);
    gl.uniform1i(at.curve, kCurves[look.curve]);
    gl.uniform1i(at.content, kContents[look.content]);
    gl.uniform2fv(at.range, look.range);
    gl.uniform1i(at.marks, Number(look.marks));
    gl.uniform3fv(at.falseColors, kFalseColors.flat().map((value) => value / 255));
    gl.drawArrays(gl.TRIANGLES, 0, 3);
  }

  /// Linear value of the sum at a pixel of the frame's picture, or null outside of its window.
  readPixel(x, y) {
    const { header, sum } = this.#pictures.current;
    if (!header || !sum.texture) return null;
    const column = Math.floor(x) - header.window[0];
    const row = Math.floor(y) - header.window[1];
    if (column < 0 || row < 0 || column >= sum.width || row >= sum.height) return null;
    return [...sum.read(column, row, 1, 1).slice(0, 3)];
  }

  /// Draws a pixel of a picture, so that the card's driver is ready when the first one comes.
  warmUp(view, look) {
    const layers = [{ name: 'picture', channels: 'RGB', scale: 1 }];
    const header = { width: 1, height: 1, window: [0, 0, 1, 1], tile: 1, tiles: [0], layers };
    this.setFrame('current', { header, halves: new Uint16Array(3) });
    this.sum('current', () => [1, 1, 1]);
    this.#gl.enable(this.#gl.SCISSOR_TEST);
    this.#gl.scissor(0, 0, 1, 1);
    this.draw(view, look, { mode: 'none', split: 0 });
    this.#gl.disable(this.#gl.SCISSOR_TEST);
    this.clear('current');
  }

  /// Promises four numbers each for about that many pixels, spread evenly over the sum.
  readGrid(count) {
    const { sum } = this.#pictures.current;
    if (!sum.texture) return Promise.resolve(new Float32Array(0));
    const shrink = Math.min(1, Math.sqrt(count / (sum.width * sum.height)));
    this.#grid.resize(Math.ceil(sum.width * shrink), Math.ceil(sum.height * shrink));
    this.#grid.use();
    const gl = this.#gl;
    const { program, at } = this.#programs.grid;
    gl.useProgram(program);
    bindTexture(gl, 0, gl.TEXTURE_2D, sum.texture);
    gl.uniform1i(at.picture, 0);
    gl.uniform2f(at.grid, this.#grid.width, this.#grid.height);
    gl.drawArrays(gl.TRIANGLES, 0, 3);
    return this.#grid.readLater();
  }

  #bindPictures(at, view) {
    const gl = this.#gl;
    const { current, other } = this.#pictures;
    gl.uniform1i(at.current, 0);
    gl.uniform1i(at.other, 1);
    gl.uniform1i(at.heat, 2);
    bindTexture(gl, 0, gl.TEXTURE_2D, current.sum.texture ?? this.#blank);
    bindTexture(gl, 1, gl.TEXTURE_2D, other.sum.texture ?? this.#blank);
    bindTexture(gl, 2, gl.TEXTURE_2D, this.#heat ?? this.#blank);
    gl.uniform1i(at.hasCurrent, Number(Boolean(current.sum.texture)));
    gl.uniform4fv(at.currentRegion, regionOf(current.header, view.pictureSize));
    gl.uniform4fv(at.otherRegion, regionOf(other.header, view.pictureSize));
    gl.uniform2i(at.currentTop, Math.max(0, current.sum.width - 1),
      Math.max(0, current.sum.height - 1));
    gl.uniform2i(at.otherTop, Math.max(0, other.sum.width - 1), Math.max(0, other.sum.height - 1));
  }

  #possible(mode) {
    if (mode === 'heat') return this.#heat ? mode : 'none';
    return this.#pictures.other.sum.texture ? mode : 'none';
  }
}

// Rectangle of a frame's window in pixels of the full picture, whatever the frame's own size.
function regionOf(header, [width, height]) {
  if (!header) return [0, 0, 0, 0];
  const [x0, y0, x1, y1] = header.window;
  const [sx, sy] = [width / header.width, height / header.height];
  return [x0 * sx, y0 * sy, (x1 - x0) * sx, (y1 - y0) * sy];
}
