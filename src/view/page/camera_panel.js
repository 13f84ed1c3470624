// The panel of the camera: lens, shutter, pose, undo, flying, and the camera as text.

import { byId, setFigures } from './dom.js';
import { formatColor } from './format.js';

export class CameraPanel {
  #camera;
  #notify;

  /// tools: {setTool (name), toggleFly ()}; notify: (text).
  constructor(camera, server, tools, notify) {
    this.#camera = camera;
    this.#notify = notify;
    byId('fov').addEventListener('input', () => this.#setFov(true));
    byId('fov').addEventListener('change', () => this.#setFov(false));
    this.#number('lens', (value) => ({ lens_radius: value }));
    this.#number('focus', (value) => ({ focal_distance: value }));
    for (const id of ['shutter-open', 'shutter-close']) {
      this.#number(id, () => ({
        shutter: [byId('shutter-open').valueAsNumber, byId('shutter-close').valueAsNumber] }));
    }
    byId('focus-pick').addEventListener('click', () => tools.setTool('focus'));
    byId('fly').addEventListener('click', () => tools.toggleFly());
    byId('camera-undo').addEventListener('click', () => camera.undo());
    byId('camera-redo').addEventListener('click', () => camera.redo());
    byId('copy-camera').addEventListener('click', () => this.#copy(server));
    camera.addEventListener('change', () => this.#show());
  }

  setState(state) {
    const note = byId('camera-note');
    const can = Boolean(state.camera?.can_move);
    note.hidden = can;
    note.textContent = 'A picture has no camera to move.';
    for (const control of document.querySelectorAll('#camera-panel :is(input, button)')) {
      if (!['camera-undo', 'camera-redo'].includes(control.id)) control.disabled = !can;
    }
    this.#show();
  }

  #setFov(moving) {
    this.#camera.setLens({ fov: Number(byId('fov').value) }, moving);
  }

  #number(id, valuesOf) {
    byId(id).addEventListener('change', () => {
      const values = valuesOf(byId(id).valueAsNumber);
      const valid = Object.values(values).flat().every(Number.isFinite);
      if (valid) this.#camera.setLens(values);
      else this.#show();
    });
  }

  #show() {
    const { pose, canMove } = this.#camera;
    byId('camera-undo').disabled = !this.#camera.canUndo;
    byId('camera-redo').disabled = !this.#camera.canRedo;
    if (!pose) return;
    byId('fov').disabled = !canMove || pose.fov === undefined;
    byId('fov-value').textContent = pose.fov === undefined ? '' : `${pose.fov.toFixed(1)}°`;
    if (pose.fov !== undefined) byId('fov').value = pose.fov;
    this.#setNumber('lens', pose.lens_radius);
    this.#setNumber('focus', pose.focal_distance);
    this.#setNumber('shutter-open', pose.shutter?.[0]);
    this.#setNumber('shutter-close', pose.shutter?.[1]);
    setFigures(byId('pose'), [['Eye', formatColor(pose.eye)], ['Target', formatColor(pose.target)],
      ['Up', formatColor(pose.up)]]);
  }

  #setNumber(id, value) {
    const input = byId(id);
    if (document.activeElement === input) return;
    input.disabled = !this.#camera.canMove || value === undefined;
    input.value = value === undefined ? '' : Number(value.toPrecision(6));
  }

  // The clipboard needs a safe page, which loopback is. Without one the text can be copied by hand.
  async #copy(server) {
    const box = byId('camera-text');
    try {
      const text = await server.text('api/save?kind=camera');
      box.value = text;
      box.hidden = false;
      await navigator.clipboard.writeText(text);
      this.#notify('The camera is in the clipboard.');
    } catch (error) {
      if (box.hidden) this.#notify(error.message);
      else box.select();
    }
  }
}
