// Keyboard shortcuts, and the dialog that lists them.

import { byId, element } from './dom.js';

const kFlyKeys = { KeyD: [1, 0, 0], KeyA: [-1, 0, 0], KeyE: [0, 1, 0], KeyQ: [0, -1, 0],
  KeyW: [0, 0, 1], KeyS: [0, 0, -1] };
const kArrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };
const kArrowPixels = 12;
const kDollyFactor = 1.08;

const kMouse = [
  ['Left drag', 'Orbit'], ['Right drag, Shift drag', 'Pan'], ['Wheel', 'Dolly'],
  ['Ctrl wheel', 'Zoom the picture'], ['Click', 'Inspect a pixel'],
  ['Double click', 'Orbit about this point']];

/// Actions are named as in the table below; fly (right, up, forward), setFlying (on),
/// arrow (dx, dy, shift) and dolly (factor) belong to keys that are held.
export class Keyboard {
  #actions;
  #held = new Set(); // codes of fly keys
  #flyMode = false; // switched on by a button
  #flyHeld = false;

  constructor(actions) {
    this.#actions = actions;
    window.addEventListener('keydown', (event) => this.#down(event));
    window.addEventListener('keyup', (event) => this.#up(event));
    window.addEventListener('blur', () => this.#releaseAll());
    byId('open-help').addEventListener('click', () => byId('help').showModal());
    byId('shortcuts').append(...[...kMouse, ...kShortcuts.map(({ keys, text }) => [keys, text]),
      ['F + W A S D Q E', 'Fly'], ['Arrows, Shift arrows', 'Orbit, pan (picture focused)'],
      ['Page Up, Page Down', 'Dolly (picture focused)']].flatMap(([keys, text]) => [
      element('dt', {}, ...keys.split(', ').flatMap((key, index) =>
        [index > 0 ? ' ' : '', element('kbd', { text: key })])),
      element('dd', { text })]));
  }

  toggleFly() {
    this.#flyMode = !this.#flyMode;
    this.#updateFlying();
  }

  #down(event) {
    if (byId('help').open || isTyping(event.target)) return;
    if (event.code === 'KeyF' && !event.ctrlKey && !event.metaKey) {
      this.#flyHeld = true;
      this.#updateFlying();
    } else if ((this.#flyHeld || this.#flyMode) && kFlyKeys[event.code] && !event.ctrlKey &&
               !event.metaKey) {
      this.#held.add(event.code);
      this.#fly();
    } else if (!this.#stageKey(event) && !this.#shortcut(event)) {
      return;
    }
    event.preventDefault();
  }

  #up(event) {
    if (event.code === 'KeyF') {
      this.#flyHeld = false;
      this.#updateFlying();
    }
    if (this.#held.delete(event.code)) this.#fly();
  }

  #releaseAll() {
    this.#held.clear();
    this.#flyHeld = false;
    this.#updateFlying();
  }

  #updateFlying() {
    const flying = this.#flyHeld || this.#flyMode;
    byId('fly').setAttribute('aria-pressed', String(flying));
    this.#actions.setFlying(flying);
    if (!flying) this.#held.clear();
    this.#fly();
  }

  #fly() {
    const sum = [0, 0, 0];
    for (const code of this.#held) kFlyKeys[code].forEach((value, axis) => { sum[axis] += value; });
    this.#actions.fly(...sum);
  }

  #stageKey(event) {
    if (event.target !== byId('stage') || event.ctrlKey || event.metaKey) return false;
    if (kArrows[event.key]) {
      const [dx, dy] = kArrows[event.key].map((value) => value * kArrowPixels);
      this.#actions.arrow(dx, dy, event.shiftKey);
    } else if (event.key === 'PageUp') {
      this.#actions.dolly(1 / kDollyFactor);
    } else if (event.key === 'PageDown') {
      this.#actions.dolly(kDollyFactor);
    } else {
      return false;
    }
    return true;
  }

  #shortcut(event) {
    const found = kShortcuts.find(({ matches }) => matches(event));
    if (!found) return false;
    if (found.action === 'help') byId('help').showModal();
    else this.#actions[found.action]();
    return true;
  }
}

const plain = (key) => (event) => event.key === key && !event.ctrlKey && !event.metaKey &&
  !event.altKey;
const control = (key, shift) => (event) => event.key.toLowerCase() === key &&
  (event.ctrlKey || event.metaKey) && event.shiftKey === shift;

const kShortcuts = [
  { keys: 'Ctrl+Z', text: 'Undo a camera move', action: 'undo', matches: control('z', false) },
  { keys: 'Ctrl+Shift+Z', text: 'Redo it', action: 'redo', matches: control('z', true) },
  { keys: '0', text: 'Fit the picture', action: 'fit', matches: plain('0') },
  { keys: '1', text: 'Zoom to 100 %', action: 'actual', matches: plain('1') },
  { keys: '+', text: 'Zoom in', action: 'zoomIn', matches: plain('+') },
  { keys: '-', text: 'Zoom out', action: 'zoomOut', matches: plain('-') },
  { keys: '[', text: 'Exposure down by a third of a stop', action: 'darker', matches: plain('[') },
  { keys: ']', text: 'Exposure up', action: 'brighter', matches: plain(']') },
  { keys: 'C', text: 'Clipping marks', action: 'marks', matches: plain('c') },
  { keys: 'V', text: 'False colour', action: 'falseColor', matches: plain('v') },
  { keys: 'X', text: 'Snapshot', action: 'snapshot', matches: plain('x') },
  { keys: 'B', text: 'Blink with the other picture', action: 'blink', matches: plain('b') },
  { keys: 'P', text: 'Pause or resume', action: 'pause', matches: plain('p') },
  { keys: 'Shift+R', text: 'Restart', action: 'restart',
    matches: (event) => event.shiftKey && plain('R')(event) }, // not with Caps Lock
  { keys: 'H', text: 'Show or hide the panels', action: 'panels', matches: plain('h') },
  { keys: 'Esc', text: 'Back to the camera tool', action: 'escape', matches: plain('Escape') },
  { keys: '?', text: 'This list', action: 'help', matches: plain('?') },
];

function isTyping(target) {
  if (target.matches('textarea, select, [contenteditable]')) return true;
  return target.matches('input') && !['range', 'checkbox', 'color', 'file'].includes(target.type);
}
