// Where the picture lies in the window: fit, zoom to pixels, pan. In device pixels, from the top
// left.

const kMinZoom = 1 / 32;
const kMaxZoom = 64;

/// Event "change" whenever the picture moves on the screen.
export class ViewTransform extends EventTarget {
  zoom = 1; // device pixels a pixel of the picture
  x = 0; // left edge of the picture
  y = 0; // top edge
  fitted = true;
  hasPicture = false;
  #viewport = [1, 1];
  #picture = [1, 1];
  #ratio = 1; // device pixels a CSS pixel

  setViewport(width, height, ratio) {
    this.#viewport = [width, height];
    this.#ratio = ratio;
    this.#place();
  }

  setPicture(width, height) {
    if (this.hasPicture && width === this.#picture[0] && height === this.#picture[1]) return;
    this.hasPicture = true;
    this.#picture = [width, height];
    this.#place();
  }

  get pictureSize() { return this.#picture; }

  /// CSS pixels that a pixel of the picture takes.
  get cssZoom() { return this.zoom / this.#ratio; }

  fit() {
    this.fitted = true;
    this.#place();
  }

  /// One pixel of the picture on one of the screen; its middle stays.
  actual() {
    this.#zoomTo(1, this.#viewport[0] / 2, this.#viewport[1] / 2);
  }

  /// Zooms about a point in CSS pixels; about the middle of the window without one.
  zoomBy(factor, cssX, cssY) {
    const x = cssX === undefined ? this.#viewport[0] / 2 : cssX * this.#ratio;
    const y = cssY === undefined ? this.#viewport[1] / 2 : cssY * this.#ratio;
    this.#zoomTo(this.zoom * factor, x, y);
  }

  panBy(cssX, cssY) {
    this.fitted = false;
    this.x += cssX * this.#ratio;
    this.y += cssY * this.#ratio;
    this.#keepInSight();
    this.#changed();
  }

  /// The point of the picture, in its pixels, below a point of the window in CSS pixels.
  toPicture(cssX, cssY) {
    return [(cssX * this.#ratio - this.x) / this.zoom, (cssY * this.#ratio - this.y) / this.zoom];
  }

  /// The point of the window in CSS pixels above a point of the picture.
  toWindow(x, y) {
    return [(x * this.zoom + this.x) / this.#ratio, (y * this.zoom + this.y) / this.#ratio];
  }

  #zoomTo(zoom, x, y) {
    const limited = Math.min(Math.max(zoom, kMinZoom), kMaxZoom);
    const factor = limited / this.zoom;
    this.fitted = false;
    this.x = x - (x - this.x) * factor;
    this.y = y - (y - this.y) * factor;
    this.zoom = limited;
    this.#keepInSight();
    this.#changed();
  }

  #place() {
    const [width, height] = this.#viewport;
    const [pictureWidth, pictureHeight] = this.#picture;
    if (this.fitted) {
      this.zoom = Math.min(width / pictureWidth, height / pictureHeight);
      this.x = (width - pictureWidth * this.zoom) / 2;
      this.y = (height - pictureHeight * this.zoom) / 2;
    } else {
      this.#keepInSight();
    }
    this.#changed();
  }

  // A part of the picture always stays in the window, and its pixels lie on those of the screen.
  #keepInSight() {
    const margin = 40;
    const [width, height] = this.#viewport;
    const limit = (value, size, room) =>
      Math.min(Math.max(value, margin - size), Math.max(room - margin, 0));
    this.x = Math.round(limit(this.x, this.#picture[0] * this.zoom, width));
    this.y = Math.round(limit(this.y, this.#picture[1] * this.zoom, height));
  }

  #changed() {
    this.dispatchEvent(new Event('change'));
  }
}
