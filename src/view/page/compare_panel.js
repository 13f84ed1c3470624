// The panel of comparisons: another picture beside, instead of or against the one that is shown.

import { CompareMeasure } from './compare_measure.js';
import { byId, pressOne, setFigures, setOptions, showPanel } from './dom.js';
import { formatNumberOf, formatValue } from './format.js';

const kBlinkMs = 700;
const kHeatMaps = ['relmse', 'flip'];
const kKeyStep = 0.02;
const kFileId = /^file/; // snapshots are letters

/// Event "change" when something else is to be drawn.
export class ComparePanel extends EventTarget {
  #server;
  #renderer; // () => Renderer
  #mix;
  #notify;
  #measure;
  #state = null;
  #hasBegun = false;
  #hasHeat = false;
  #with = ''; // id of the comparison
  #mode = 'split';
  #split = 0.5; // of the width of the stage
  #blinkTimer = 0;
  #blinked = false;
  #buttons = document.querySelectorAll('[data-compare]');

  constructor(server, renderer, mix, notify) {
    super();
    this.#server = server;
    this.#renderer = renderer;
    this.#mix = mix;
    this.#notify = notify;
    this.#measure = new CompareMeasure(server, () => this.#wanted,
      (measured, wanted) => this.#showMeasured(measured, wanted));
    byId('compare-with').addEventListener('change', (event) => this.choose(event.target.value));
    for (const button of this.#buttons) {
      button.addEventListener('click', () => {
        const again = button.dataset.compare === 'blink' && this.#mode === 'blink';
        if (again) this.blink();
        else this.setMode(button.dataset.compare);
      });
    }
    byId('snapshot').addEventListener('click', () => this.snapshot());
    byId('compare-remove').addEventListener('click', () => this.#remove());
    byId('compare-file').addEventListener('change', (event) => this.#upload(event.target));
    this.#listenToSplit(byId('split'));
    this.#show();
  }

  /// What the renderer is to draw: {mode, split}.
  get drawn() {
    if (this.#with === '') return { mode: 'none', split: 0 };
    const mode = this.#mode === 'blink' ? (this.#blinked ? 'other' : 'none')
      : kHeatMaps.includes(this.#mode) ? 'heat' : this.#mode;
    return { mode, split: this.#split };
  }

  setState(state) {
    this.#state = state;
    const items = state.comparisons.map(({ id, name }) => [id, name]);
    setOptions(byId('compare-with'), [['', 'Nothing'], ...items]);
    if (this.#with !== '' && !items.some(([id]) => id === this.#with)) this.choose('');
    if (!this.#hasBegun && state.version > 0 && !state.preview) this.#begin();
  }

  // Whoever gives a file with the command wants to see it.
  #begin() {
    this.#hasBegun = true;
    const file = this.#state.comparisons.find(({ id }) => kFileId.test(id));
    if (!file) return;
    showPanel(byId('compare-panel'));
    this.choose(file.id);
  }

  /// Compares with that picture, or with none for ''.
  async choose(id) {
    this.#with = id;
    byId('compare-with').value = id;
    this.#renderer().clear('other');
    this.#setHeat(null);
    this.#show();
    if (id !== '') await this.load();
  }

  /// Gets the other picture, its figures and its heat map; again after the graphics card was reset.
  async load() {
    const id = this.#with;
    if (id === '') return;
    await this.#try(async () => {
      const frame = await this.#server.frame({ comparison: id });
      if (!frame || id !== this.#with) return;
      this.#renderer().setFrame('other', frame);
      this.#renderer().sum('other', () => [1, 1, 1]);
      this.#changed();
      await this.#measure.now();
    });
  }

  async setMode(mode) {
    this.#mode = mode;
    if (kHeatMaps.includes(mode)) this.#setHeat(null); // that of another measure
    this.#show();
    if (kHeatMaps.includes(mode) && this.#with !== '') {
      await this.#try(() => this.#measure.now());
    }
  }

  /// Shows the other picture, and this one the next time.
  blink() {
    if (this.#with === '') return;
    if (this.#mode !== 'blink') this.setMode('blink');
    clearInterval(this.#blinkTimer);
    this.#blinked = !this.#blinked;
    this.#changed();
  }

  async snapshot() {
    await this.#try(async () => {
      const { id } = await this.#server.post(
        'api/snapshot' + (this.#mix.neutral ? '' : `?mix=${encodeURIComponent(this.#gains)}`), {});
      await this.#server.refresh();
      this.#notify(`Snapshot ${id} kept${this.#mix.neutral ? '' : ', as it is mixed'}.`);
      if (this.#with === '') await this.choose(id);
    });
  }

  async #upload(input) {
    const [file] = input.files;
    input.value = '';
    if (!file) return;
    await this.#try(async () => {
      const { id } = await this.#server.upload(file);
      await this.#server.refresh();
      await this.choose(id);
    });
  }

  async #remove() {
    const id = this.#with;
    // A heat map that is on its way needs the picture.
    await this.#measure.settled();
    if (id === this.#with) await this.choose('');
    await this.#try(async () => {
      await this.#server.remove('api/snapshot?id=' + encodeURIComponent(id));
      await this.#server.refresh();
    });
  }

  // The mix that is compared; a view of another layer does not count.
  get #gains() {
    return this.#mix.neutral ? '' : JSON.stringify(this.#mix.describe());
  }

  // What is to be measured, or null.
  get #wanted() {
    const heat = kHeatMaps.includes(this.#mode) ? this.#mode : '';
    const isSeen = heat !== '' || byId('compare-panel').open;
    if (this.#with === '' || !isSeen || !this.#state || this.#state.preview) return null;
    const { generation, version, progress } = this.#state;
    return { id: this.#with, heat, mix: this.#gains, version: `${generation}/${version}`,
      passes: progress?.passes };
  }

  #showMeasured({ figures, bitmap }, { id, heat, mix, passes }) {
    if (id !== this.#with) return;
    setFigures(byId('compare-figures'), [
      ...[['relMSE', figures.relmse], ['relMSE trim', figures.relmse_trim],
        ['FLIP', figures.flip]]
        .filter(([, value]) => Number.isFinite(value))
        .map(([name, value]) => [name, formatValue(value)]),
      ['Measured', [mix && 'mix', passes > 0 && `after ${formatNumberOf(passes, 'pass', 'passes')}`]
        .filter(Boolean).join(', ')]]);
    if (bitmap && heat === this.#mode) this.#setHeat(bitmap);
    this.#changed();
  }

  #setHeat(bitmap) {
    this.#hasHeat = Boolean(bitmap);
    this.#renderer().setHeat(bitmap);
  }

  async #try(action) {
    try {
      await action();
    } catch (error) {
      this.#notify(error.message);
    }
  }

  #show() {
    const chosen = this.#with !== '';
    pressOne(this.#buttons, 'compare', chosen ? this.#mode : '');
    for (const button of this.#buttons) button.disabled = !chosen;
    byId('compare-remove').disabled = !chosen;
    byId('split').hidden = !chosen || this.#mode !== 'split';
    if (!chosen) setFigures(byId('compare-figures'), []);
    this.#blinked = false;
    clearInterval(this.#blinkTimer);
    const still = matchMedia('(prefers-reduced-motion: reduce)').matches;
    if (chosen && this.#mode === 'blink' && !still) {
      this.#blinkTimer = setInterval(() => {
        this.#blinked = !this.#blinked;
        this.#changed();
      }, kBlinkMs);
    }
    this.#changed();
  }

  #showTags() {
    const name = byId('compare-with').selectedOptions[0]?.textContent ?? '';
    const { mode } = this.drawn;
    byId('tag-left').hidden = !['split', 'other'].includes(mode);
    byId('tag-left').textContent = name;
    byId('tag-right').hidden = this.#with === '' || mode === 'other';
    const measure = this.#mode === 'flip' ? 'FLIP' : 'relMSE';
    byId('tag-right').textContent = { difference: `Difference to ${name}`,
      heat: `${this.#hasHeat ? '' : 'Measuring '}${measure} against ${name}` }[mode] ??
      'This picture';
  }

  #changed() {
    this.#showTags();
    this.dispatchEvent(new Event('change'));
  }

  #listenToSplit(handle) {
    const stage = byId('stage');
    handle.addEventListener('pointerdown', (event) => {
      event.stopPropagation();
      handle.setPointerCapture(event.pointerId);
    });
    handle.addEventListener('pointermove', (event) => {
      if (!handle.hasPointerCapture(event.pointerId)) return;
      const box = stage.getBoundingClientRect();
      this.#moveSplit((event.clientX - box.left) / box.width);
    });
    handle.addEventListener('keydown', (event) => {
      const step = { ArrowLeft: -kKeyStep, ArrowRight: kKeyStep, Home: -1, End: 1 }[event.key];
      if (step === undefined) return;
      event.preventDefault();
      event.stopPropagation();
      this.#moveSplit(this.#split + step);
    });
  }

  #moveSplit(place) {
    this.#split = Math.min(1, Math.max(0, place));
    byId('split').style.left = `${100 * this.#split}%`;
    byId('split').setAttribute('aria-valuenow', Math.round(100 * this.#split));
    this.#changed();
  }
}
