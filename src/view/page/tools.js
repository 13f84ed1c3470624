// The tools of the pointer, and what they do: camera, zoom of the picture, focus, crop, inspection.

import { byId, pressOne } from './dom.js';
import { StageInput } from './stage_input.js';

export class Tools {
  #parts;
  #input;
  #buttons = document.querySelectorAll('[data-tool]');

  /// parts: server, view, camera, inspector, render, overlay, readout, notify.
  constructor(parts) {
    this.#parts = parts;
    const { view, camera, readout } = parts;
    this.#input = new StageInput(byId('stage'), {
      orbit: (dx, dy) => camera.orbit(dx, dy),
      pan: (dx, dy) => camera.pan(dx, dy, this.#shortSide()),
      look: (dx, dy) => camera.look(dx, dy),
      dolly: (factor) => camera.dolly(factor),
      movePicture: (dx, dy) => view.panBy(dx, dy),
      zoom: (factor, x, y) => view.zoomBy(factor, x, y),
      hover: (x, y) => readout.show(view.toPicture(x, y)),
      leave: () => readout.clear(),
      click: (x, y) => this.#click(view.toPicture(x, y)),
      pickOrbit: (x, y) => this.#pick(view.toPicture(x, y),
        ({ depth }) => camera.setOrbitDepth(depth)),
      crop: (rectangle, done) => this.#crop(rectangle, done),
    });
    for (const button of this.#buttons) {
      button.addEventListener('click', () => this.set(button.dataset.tool));
    }
  }

  setState() {
    const { canMove } = this.#parts.camera;
    this.#input.canMove = canMove;
    for (const button of this.#buttons) {
      button.disabled = !canMove && button.dataset.tool !== 'picture';
    }
    if (!canMove && this.#input.tool !== 'picture') this.set('picture');
  }

  set(name) {
    this.#input.tool = name;
    this.#parts.overlay.showCrop(null);
    pressOne(this.#buttons, 'tool', name);
  }

  setFlying(flying) {
    this.#input.flying = flying;
  }

  dolly(factor) {
    if (this.#input.tool === 'picture') this.#parts.view.zoomBy(1 / factor);
    else this.#parts.camera.dolly(factor);
  }

  /// An arrow key: moves the picture, or the camera as a drag of the pointer would.
  arrow(dx, dy, shift) {
    const { view, camera } = this.#parts;
    if (this.#input.tool === 'picture') view.panBy(-dx, -dy);
    else if (shift) camera.pan(-dx, -dy, this.#shortSide());
    else camera.orbit(dx, dy);
  }

  #shortSide() {
    const { view } = this.#parts;
    return Math.min(...view.pictureSize) * view.cssZoom;
  }

  #click([x, y]) {
    const { view, inspector, camera, readout } = this.#parts;
    const [width, height] = view.pictureSize;
    if (x < 0 || y < 0 || x >= width || y >= height) return;
    if (this.#input.tool !== 'focus') {
      readout.show([x, y]);
      if (!byId('inspector-panel').hidden) inspector.inspect(Math.floor(x), Math.floor(y));
      return;
    }
    this.#pick([x, y], ({ depth }) => {
      camera.setLens({ focal_distance: depth });
      this.set('camera');
    });
  }

  async #pick([x, y], use) {
    const { server, notify } = this.#parts;
    try {
      const seen = await server.post('api/pick', { x: Math.floor(x), y: Math.floor(y) });
      if (seen.point) use(seen);
      else notify('No surface at this pixel.');
    } catch (error) {
      notify(error.message);
    }
  }

  #crop({ x0, y0, x1, y1 }, done) {
    const { overlay, render, view } = this.#parts;
    overlay.showCrop(done ? null : { x0, y0, x1, y1 });
    if (!done) return;
    const [width, height] = view.pictureSize;
    const [left, top] = view.toPicture(x0, y0);
    const [right, bottom] = view.toPicture(x1, y1);
    render.setCrop({ x0: left / width, y0: top / height, x1: right / width, y1: bottom / height });
    this.set('camera');
  }
}
