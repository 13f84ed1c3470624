// The gains of the layers: which layers the picture is summed from, and with which weights.
// It must not know of the page or of WebGL.

const kNeutralTint = '#ffffff';

/// Event "change" whenever a weight or the kind changes.
export class Mix extends EventTarget {
  #layers = [];
  #entries = new Map();
  #kind = 'route';

  /// Takes over the layers of a state. Gains stay with their names.
  setLayers(layers) {
    const key = (list) => list.map((layer) => `${layer.kind}/${layer.name}`).join('\n');
    if (key(layers) === key(this.#layers)) return;
    this.#layers = layers;
    const other = this.#kind === 'light' ? 'route' : 'light';
    if (this.names.length === 0 && this.namesOf(other).length > 0) this.#kind = other;
    this.#changed();
  }

  get kind() { return this.#kind; }
  set kind(kind) {
    if (kind === this.#kind) return;
    this.#kind = kind;
    this.#changed();
  }

  /// Names of the layers of the kind that is mixed.
  get names() { return this.namesOf(this.#kind); }

  namesOf(kind) {
    return this.#layers.filter((layer) => layer.kind === kind).map((layer) => layer.name);
  }

  /// {gain, tint: "#rrggbb", on, solo}; read it, change it by set().
  entry(name) {
    const key = `${this.#kind}/${name}`;
    if (!this.#entries.has(key)) {
      this.#entries.set(key, { gain: 1, tint: kNeutralTint, on: true, solo: false });
    }
    return this.#entries.get(key);
  }

  /// Changes some values of a layer: set('key', {gain: 2}). Goes to the layer's kind if need be.
  set(name, values) {
    const layer = this.#layers.find((one) => one.name === name && one.kind === this.#kind) ??
      this.#layers.find((one) => one.name === name && ['route', 'light'].includes(one.kind));
    if (!layer) throw new Error(`layer "${name}": not in the picture`);
    this.#kind = layer.kind;
    Object.assign(this.entry(name), values);
    this.#changed();
  }

  reset() {
    for (const name of this.names) this.#entries.delete(`${this.#kind}/${name}`);
    this.#changed();
  }

  /// Whether the sum is the picture itself.
  get neutral() {
    return this.names.every((name) => {
      const { gain, tint, on, solo } = this.entry(name);
      return gain === 1 && tint === kNeutralTint && on && !solo;
    });
  }

  /// Factors of red, green and blue for a layer; the picture itself has 1.
  weight(name) {
    if (!this.names.includes(name)) return [1, 1, 1];
    const { gain, tint, on, solo } = this.entry(name);
    const heard = on && (solo || !this.#anySolo());
    return linearColor(tint).map((value) => (heard ? gain * value : 0));
  }

  /// Name to gain, or to three factors, for the program's own mix.
  describe() {
    const described = {};
    for (const name of this.names) {
      const weight = this.weight(name);
      described[name] = weight.every((value) => value === weight[0]) ? weight[0] : weight;
    }
    return described;
  }

  #anySolo() {
    return this.names.some((name) => this.entry(name).solo);
  }

  #changed() {
    this.dispatchEvent(new Event('change'));
  }
}

/// "#rrggbb" in sRGB as linear factors.
export function linearColor(hex) {
  return [1, 3, 5].map((at) => {
    const value = parseInt(hex.slice(at, at + 2), 16) / 255;
    return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
  });
}
