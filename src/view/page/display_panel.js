// The panel of exposure, white point, curve and view, with histogram and legend.

import { byId, element, setOptions } from './dom.js';
import { formatStops, formatValue } from './format.js';
import { clippingText, countValues, drawHistogram, rangeOf } from './histogram.js';
import { kFalseColorFirstStop, kFalseColors } from './shaders.js';

const kHistogramPixels = 40000;
const kHistogramMs = 250;
const kSliders = { exposure: 'stops', kelvin: 'kelvin', green: 'tint' };

export class DisplayPanel {
  #display;
  #stage;
  #timer = 0;
  #counted = ''; // layer that was counted last

  constructor(display, stage) {
    this.#display = display;
    this.#stage = stage;
    for (const [id, name] of Object.entries(kSliders)) {
      byId(id).addEventListener('input', (event) =>
        display.set({ [name]: Number(event.target.value) }));
      byId(id).addEventListener('dblclick', () =>
        display.set({ [name]: name === 'kelvin' ? 6500 : 0 }));
    }
    byId('curve').addEventListener('change', (event) =>
      display.set({ curve: event.target.value }));
    byId('marks').addEventListener('change', (event) =>
      display.set({ marks: event.target.checked }));
    byId('view').addEventListener('change', (event) =>
      display.setView(event.target.value));
    byId('display-reset').addEventListener('click', () => display.reset());
    display.addEventListener('change', () => this.#show());
    // A closed panel has no histogram.
    byId('display-panel').addEventListener('toggle', () => this.pictureChanged());
    this.#makeLegend();
    this.#show();
  }

  setState(state) {
    const views = state.layers.filter((layer) => ['feature', 'aov'].includes(layer.kind));
    this.#display.features = new Map(views.map(({ name, channels }) => [name, channels]));
    setOptions(byId('view'), [['', 'Picture'], ...views.map(({ name }) =>
      [name, kViewNames[name] ?? name])]);
    if (this.#display.view !== '' && !this.#display.features.has(this.#display.view)) {
      this.#display.setView('');
    }
  }

  /// The picture has changed. Counts it again soon; at once if it shows something else.
  pictureChanged() {
    const isOther = this.#counted !== '' && this.#stage.shownLayer !== this.#counted;
    if (this.#timer && !isOther) return;
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#count(), isOther ? 0 : kHistogramMs);
  }

  async #count() {
    const layer = this.#stage.shownLayer;
    this.#counted = layer;
    this.#timer = 0;
    const grid = await this.#stage.renderer.readGrid(kHistogramPixels);
    if (grid.length === 0 || layer !== this.#stage.shownLayer) return;
    const display = this.#display;
    const content = display.contentOf(layer);
    if (content === 'number') {
      const [low, high] = rangeOf(grid);
      const range = display.view === 'Z' ? [low, high] : [high, low]; // near is white
      if (String(range) !== String(display.range)) {
        display.range = range;
        display.set({});
      }
    }
    if (!byId('display-panel').open) return;
    const light = content === 'light';
    const counts = countValues(grid, light ? display.exposure : 1,
      light ? display.balance : [1, 0, 0, 0, 1, 0, 0, 0, 1]);
    drawHistogram(byId('histogram'), counts);
    const note = light ? clippingText(counts) : '';
    byId('clip-note').textContent = note;
    byId('histogram').setAttribute('aria-label', `Histogram in stops. ${note}`);
  }

  #show() {
    const display = this.#display;
    byId('exposure').value = display.stops;
    byId('exposure-value').textContent = formatStops(display.stops);
    byId('kelvin').value = display.kelvin;
    byId('kelvin-value').textContent = `${display.kelvin} K`;
    byId('green').value = display.tint;
    byId('green-value').textContent = display.tint;
    byId('curve').value = display.curve;
    byId('marks').checked = display.marks;
    byId('view').value = display.view;
    const light = display.contentOf(display.view) === 'light';
    for (const id of [...Object.keys(kSliders), 'curve', 'marks']) byId(id).disabled = !light;
    this.#showLegend();
    this.pictureChanged();
  }

  #showLegend() {
    const { curve, range, view } = this.#display;
    const content = this.#display.contentOf(view);
    const isNumber = content === 'number';
    byId('legend').hidden = !isNumber && !(content === 'light' && curve === 'false');
    for (const swatch of byId('legend').querySelectorAll('.swatch')) swatch.hidden = isNumber;
    const sign = view === 'bias' ? '±' : '';
    byId('legend').querySelector('.words').textContent = isNumber
      ? `white ${sign}${formatValue(range[0])}, black ${sign}${formatValue(range[1])}`
      : 'stops from middle grey';
  }

  #makeLegend() {
    kFalseColors.forEach((color, index) => {
      const bar = element('div', { class: 'colour' });
      bar.style.backgroundColor = `rgb(${color.join(' ')})`;
      const stop = kFalseColorFirstStop + index;
      const text = stop > 0 ? `+${stop}` : String(stop).replace('-', '−');
      byId('legend').append(element('div', { class: 'swatch' }, bar, text));
    });
    byId('legend').append(element('span', { class: 'words' }));
  }
}

const kViewNames = {
  albedo: 'Albedo', N: 'Normals', Z: 'Depth', samples: 'Samples', stderr: 'Standard error',
  bias: 'Bias',
};
