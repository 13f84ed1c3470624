// How linear values become colours of the screen: exposure, white point, curve, marks and view.
// It must not know of the page or of WebGL.

import { whiteBalance } from './white_point.js';

const kDefaults = { stops: 0, kelvin: 6500, tint: 0, curve: 'srgb', marks: false };
const kContents = { albedo: 'reflectance', N: 'directions', normal: 'directions' };

/// Event "change" whenever a value changes. What is viewed is the mix ("") or one layer's name.
export class Display extends EventTarget {
  view = '';
  pictureExposure = 1; // of the PNG
  range = [0, 1]; // of the numbers of a layer with one channel
  #values = { ...kDefaults };
  #channels = 'RGB'; // of the viewed layer

  get stops() { return this.#values.stops; }
  get kelvin() { return this.#values.kelvin; }
  get tint() { return this.#values.tint; }
  get curve() { return this.#values.curve; }
  get marks() { return this.#values.marks; }
  get exposure() { return this.pictureExposure * 2 ** this.#values.stops; }

  /// Changes some of stops, kelvin, tint, curve and marks.
  set(values) {
    Object.assign(this.#values, values);
    this.#changed();
  }

  reset() {
    this.set(kDefaults);
  }

  setView(name, channels) {
    this.view = name;
    this.#channels = channels;
    this.#changed();
  }

  /// What the numbers of the viewed layer are: light, reflectance, directions, number.
  get content() {
    if (this.view === '') return 'light';
    if (this.#channels.length === 1) return 'number';
    return kContents[this.view] ?? 'light';
  }

  get balance() {
    return whiteBalance(this.kelvin, this.tint);
  }

  /// All that the renderer wants to know.
  look() {
    const { exposure, balance, curve, content, range, marks } = this;
    return { exposure, balance, curve, content, range, marks };
  }

  #changed() {
    this.dispatchEvent(new Event('change'));
  }
}
