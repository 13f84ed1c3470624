// Lines drawn over the picture: a path of the inspected pixel, the pixel itself, a crop rectangle.

import { byId, shape } from './dom.js';

const kFar = 4000; // CSS pixels; browsers draw longer lines badly

export class PathOverlay {
  #view;
  #svg = byId('overlay');
  #path = null; // points in pixels of the picture, null where not in front of the camera
  #pixel = null;
  #crop = null; // in CSS pixels

  constructor(view) {
    this.#view = view;
    view.addEventListener('change', () => this.#draw());
  }

  showPixel(x, y) {
    this.#pixel = [x, y];
    this.#path = null;
    this.#draw();
  }

  showPath(points) {
    this.#path = points;
    this.#draw();
  }

  showCrop(rectangle) {
    this.#crop = rectangle;
    this.#draw();
  }

  clear() {
    this.#pixel = this.#path = null;
    this.#draw();
  }

  #draw() {
    const shapes = [];
    if (this.#path) shapes.push(...this.#pathShapes());
    if (this.#pixel) shapes.push(...this.#pixelShapes());
    if (this.#crop) {
      const { x0, y0, x1, y1 } = this.#crop;
      shapes.push(shape('rect',
        { class: 'crop', x: x0, y: y0, width: x1 - x0, height: y1 - y0 }));
    }
    this.#svg.replaceChildren(...shapes);
  }

  #pathShapes() {
    const points = this.#path.map((point) => point && this.#view.toWindow(...point));
    const seen = points.filter((point) => point && Math.hypot(...point) < kFar);
    const line = segments(points).map(([a, b]) => `M${a.join(' ')}L${b.join(' ')}`).join('');
    return [
      shape('path', { class: 'path-shadow', d: line }), shape('path', { class: 'path', d: line }),
      ...seen.map((point) => shape('circle', {
        class: point === points.at(-1) ? 'vertex last' : 'vertex',
        cx: point[0], cy: point[1], r: 3.5 }))];
  }

  #pixelShapes() {
    const [x, y] = this.#view.toWindow(this.#pixel[0], this.#pixel[1]);
    const size = Math.max(this.#view.cssZoom, 9);
    const middle = (size - this.#view.cssZoom) / 2;
    const box = { x: x - middle, y: y - middle, width: size, height: size };
    return [shape('rect', { class: 'pixel-shadow', ...box }),
      shape('rect', { class: 'pixel', ...box })];
  }
}

// Lines between neighbours, those to far points shortened in their direction.
function segments(points) {
  const found = [];
  for (let index = 1; index < points.length; ++index) {
    const [a, b] = [points[index - 1], points[index]];
    if (!a || !b) continue;
    if (Math.hypot(...a) < kFar) found.push([a, shortened(a, b)]);
    else if (Math.hypot(...b) < kFar) found.push([shortened(b, a), b]);
  }
  return found;
}

function shortened([x, y], [farX, farY]) {
  const length = Math.hypot(farX - x, farY - y);
  const part = Math.min(1, kFar / length);
  return length > 0 ? [x + part * (farX - x), y + part * (farY - y)] : [farX, farY];
}
