// How linear values become colours of the screen: exposure, white point, curve, marks and view.
// It must not know of the page or of WebGL.

import { whiteBalance } from './white_point.js';

const kDefaults = { stops: 0, kelvin: 6500, tint: 0, curve: 'srgb', marks: false };
const kContents = { albedo: 'reflectance', N: 'directions', normal: 'directions' };

/// Event "change" whenever a value changes. What is viewed is the mix ("") or one feature's name.
export class Display extends EventTarget {
  view = '';
  range = [1, 0]; // numbers of a feature with one channel that are white and black
  features = new Map(); // names of the layers that can be viewed, to their channels
  #values = { ...kDefaults };

  get stops() { return this.#values.stops; }
  get kelvin() { return this.#values.kelvin; }
  get tint() { return this.#values.tint; }
  get curve() { return this.#values.curve; }
  get marks() { return this.#values.marks; }
  get exposure() { return 2 ** this.#values.stops; }

  /// Changes some of stops, kelvin, tint, curve and marks.
  set(values) {
    Object.assign(this.#values, values);
    this.#changed();
  }

  reset() {
    this.set(kDefaults);
  }

  setView(name) {
    this.view = name;
    this.#changed();
  }

  /// What the numbers of a layer are: light, reflectance, directions, number.
  contentOf(layer) {
    if (!this.features.has(layer)) return 'light';
    if (this.features.get(layer).length === 1) return 'number';
    return kContents[layer] ?? 'light';
  }

  get balance() {
    return whiteBalance(this.kelvin, this.tint);
  }

  /// All that the renderer wants to know to show a picture with this layer.
  look(layer) {
    const { exposure, balance, curve, range, marks } = this;
    return { exposure, balance, curve, range, marks, content: this.contentOf(layer) };
  }

  #changed() {
    this.dispatchEvent(new Event('change'));
  }
}
