// Lines drawn over the picture: a path of the inspected pixel, the pixel itself, a crop rectangle.

import { byId, shape } from './dom.js';

const kFar = 1e5; // pixels; points farther away are drawn in their direction

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
    const points = this.#path.map((point) => point && this.#view.toWindow(
      limited(point[0]), limited(point[1])));
    const seen = points.filter(Boolean);
    const line = runs(points).map((run) => 'M' + run.map((p) => p.join(' ')).join('L')).join('');
    return [
      shape('path', { class: 'path-shadow', d: line }), shape('path', { class: 'path', d: line }),
      ...seen.map(([cx, cy], index) => shape('circle', {
        class: index === seen.length - 1 ? 'vertex last' : 'vertex', cx, cy, r: 3.5 }))];
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

function limited(value) {
  return Math.min(kFar, Math.max(-kFar, value));
}

// Stretches of points without a gap.
function runs(points) {
  const found = [[]];
  for (const point of points) {
    if (point) found.at(-1).push(point);
    else if (found.at(-1).length > 0) found.push([]);
  }
  return found.filter((run) => run.length > 1);
}
