// The panel of layers: on and off, solo, tint and gain of each, saved as a mix.

import { byId, element, pressOne } from './dom.js';
import { formatStops } from './format.js';

const kMaxStops = 6;
const kFloorStops = -10; // the slider's left end is no light at all

export class LayersPanel {
  #mix;
  #rows = new Map(); // name to the controls of its row
  #shown = ''; // names that have rows
  #canChoose = true; // which layers there are
  #buttons = document.querySelectorAll('#layers-panel [data-kind]');

  constructor(mix) {
    this.#mix = mix;
    for (const button of this.#buttons) {
      button.addEventListener('click', () => { mix.kind = button.dataset.kind; });
    }
    byId('gain-linear').addEventListener('change', () => this.#show());
    byId('mix-reset').addEventListener('click', () => mix.reset());
    mix.addEventListener('change', () => this.#show());
    this.#show();
  }

  setState(state) {
    const note = byId('mix-note');
    note.hidden = state.mix.exact;
    note.textContent = state.mix.exact ? ''
      : `The layers do not add up exactly: ${state.mix.why}`;
    if (this.#canChoose === (state.kind === 'scene')) return;
    this.#canChoose = state.kind === 'scene';
    this.#show();
  }

  #show() {
    const mix = this.#mix;
    const names = mix.names;
    const key = `${mix.kind}\n${names.join('\n')}`;
    if (key !== this.#shown) this.#makeRows(names);
    this.#shown = key;
    pressOne(this.#buttons, 'kind', mix.kind);
    for (const button of this.#buttons) {
      button.disabled = mix.namesOf(button.dataset.kind).length === 0;
    }
    byId('layers-empty').hidden = names.length > 0;
    byId('layers-empty').textContent = 'This picture has no layers of this kind.' +
      (this.#canChoose ? ' Choose them under Render.' : '');
    byId('save-mix').hidden = names.length === 0;
    byId('mix-reset').disabled = mix.neutral;
    byId('save-mix').href = 'api/save?' +
      new URLSearchParams({ kind: 'exr', mix: JSON.stringify(mix.describe()) });
    for (const name of names) this.#showRow(name);
  }

  #showRow(name) {
    const { gain, tint, on, solo } = this.#mix.entry(name);
    const row = this.#rows.get(name);
    const linear = byId('gain-linear').checked;
    row.item.classList.toggle('off', this.#mix.weight(name).every((value) => value === 0));
    row.on.checked = on;
    row.solo.setAttribute('aria-pressed', String(solo));
    row.tint.value = tint;
    row.slider.value = gain > 0 ? Math.log2(gain) : kFloorStops;
    row.slider.setAttribute('aria-valuetext',
      gain > 0 ? `${formatStops(Math.log2(gain))} stops` : 'no light');
    if (document.activeElement !== row.number) {
      row.number.value = linear ? Number(gain.toPrecision(4))
        : gain > 0 ? Number(Math.log2(gain).toFixed(2)) : '';
    }
    row.number.placeholder = linear ? '' : 'none';
    row.unit.textContent = linear ? '×' : 'stops';
  }

  #makeRows(names) {
    this.#rows = new Map(names.map((name) => [name, this.#makeRow(name)]));
    byId('layer-list').replaceChildren(...[...this.#rows.values()].map((row) => row.item));
  }

  #makeRow(name) {
    const row = {
      on: element('input', { type: 'checkbox', 'aria-label': `${name}: on` }),
      solo: element('button', { type: 'button', text: 'Solo', 'aria-label': `${name}: solo` }),
      tint: element('input', { type: 'color', 'aria-label': `${name}: tint`, title: 'Tint' }),
      slider: element('input', { type: 'range', min: kFloorStops, max: kMaxStops, step: 0.05,
        'aria-label': `${name}: gain` }),
      number: element('input', { type: 'number', step: 'any',
        'aria-label': `${name}: gain as a number` }),
      unit: element('span', { class: 'unit' }),
    };
    row.item = element('li', { class: 'layer' },
      element('div', { class: 'layer-head' }, row.on,
        element('span', { class: 'layer-name', text: name, title: name }), row.tint, row.solo),
      element('div', { class: 'layer-gain' }, row.slider, row.number, row.unit));
    this.#listen(name, row);
    return row;
  }

  #listen(name, row) {
    const mix = this.#mix;
    row.on.addEventListener('change', () => mix.set(name, { on: row.on.checked }));
    row.solo.addEventListener('click', () => mix.set(name, { solo: !mix.entry(name).solo }));
    row.tint.addEventListener('input', () => mix.set(name, { tint: row.tint.value }));
    row.slider.addEventListener('input', () => {
      const stops = Number(row.slider.value);
      mix.set(name, { gain: stops <= kFloorStops ? 0 : 2 ** stops });
    });
    row.slider.addEventListener('dblclick', () => mix.set(name, { gain: 1 }));
    row.number.addEventListener('change', () => {
      const value = row.number.valueAsNumber;
      const linear = byId('gain-linear').checked;
      row.number.blur();
      if (Number.isFinite(value)) mix.set(name, { gain: linear ? Math.max(0, value) : 2 ** value });
      else this.#show();
    });
  }
}
