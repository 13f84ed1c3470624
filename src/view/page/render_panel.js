// The panel that controls the render: pause, restart, settings, crop, and figures of its progress.

import { byId, element, setFigures, setOptions } from './dom.js';
import { formatCount, formatDuration, formatShare } from './format.js';

const kWhole = [0, 1, 0, 1];

export class RenderPanel {
  #server;
  #notify;
  #state = null;
  #shown = ''; // settings of the program that the form shows

  constructor(server, notify) {
    this.#server = server;
    this.#notify = notify;
    for (const id of ['pause', 'pause-icon']) {
      byId(id).addEventListener('click', () => this.togglePause());
    }
    byId('restart').addEventListener('click', () => this.restart());
    byId('crop-clear').addEventListener('click', () => this.#send({ crop: kWhole }));
    byId('settings-form').addEventListener('input', () => this.#showApply());
    byId('settings-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.#send(this.#changes());
    });
  }

  setState(state) {
    this.#state = state;
    const renders = state.kind === 'scene';
    const paused = state.status === 'paused';
    byId('pause').textContent = paused ? 'Resume' : 'Pause';
    byId('pause-icon').setAttribute('aria-pressed', String(paused));
    for (const id of ['pause', 'pause-icon']) {
      byId(id).disabled = !renders || !['rendering', 'paused'].includes(state.status);
    }
    byId('restart').disabled = !renders;
    byId('settings-form').hidden = !renders;
    this.#showFigures(state.progress ?? {});
    const settings = JSON.stringify(state.settings);
    if (renders && settings !== this.#shown) this.#showSettings(state.settings);
    this.#shown = settings;
  }

  togglePause() {
    if (byId('pause').disabled) return;
    this.#send({ action: this.#state.status === 'paused' ? 'resume' : 'pause' });
  }

  restart() {
    this.#send({ action: 'restart' });
  }

  /// Renders only a rectangle of the picture: {x0, y0, x1, y1} as fractions of its sides.
  setCrop({ x0, y0, x1, y1 }) {
    const inside = [x0, x1, y0, y1].map((value) => Math.min(1, Math.max(0, value)));
    if (inside[0] < inside[1] && inside[2] < inside[3]) this.#send({ crop: inside });
  }

  async #send(body) {
    try {
      await this.#server.post('api/render', body);
    } catch (error) {
      this.#notify(error.message);
    }
  }

  #showFigures(progress) {
    const { seconds, passes, passes_wanted: wanted, seconds_left: left, error, photons,
      rays_per_second: rays } = progress;
    setFigures(byId('figures'), [
      ['Time', Number.isFinite(seconds) && formatDuration(seconds)],
      ['Left', Number.isFinite(left) && formatDuration(left)],
      ['Passes', Number.isFinite(passes) && (wanted ? `${passes} of ${wanted}` : passes)],
      ['Noise', Number.isFinite(error) && formatShare(error)],
      ['Rays', rays > 0 && `${formatCount(rays)} a second`],
      ['Photons', photons > 0 && (seconds > 0
        ? `${formatCount(photons)}, ${formatCount(photons / seconds)} a second`
        : formatCount(photons))],
    ]);
  }

  #showSettings(settings) {
    setOptions(byId('integrator'), settings.integrators.map((name) => [name, name]));
    byId('integrator').value = settings.integrator;
    byId('presets').replaceChildren(...settings.presets.map((value) =>
      element('option', { value })));
    byId('routes').value = settings.routes;
    byId('layer-choice').value = settings.layers;
    byId('seed').value = settings.seed;
    byId('time').value = settings.time ?? '';
    byId('noise').value = settings.noise === null ? '' : percentOf(settings.noise);
    [byId('width').value, byId('height').value] = settings.resolution;
    const whole = String(settings.crop) === String(kWhole);
    const percent = (value) => Math.round(100 * value);
    const [x0, x1, y0, y1] = settings.crop.map(percent);
    byId('crop-value').textContent = whole ? 'none' : `${x0}–${x1}, ${y0}–${y1} %`;
    byId('crop-clear').disabled = whole;
    this.#showApply();
  }

  // Settings of the form that differ from the program's.
  #changes() {
    const settings = this.#state.settings;
    const numberOrNull = (id) => (byId(id).value === '' ? null : byId(id).valueAsNumber);
    const noise = numberOrNull('noise');
    const keepsNoise = settings.noise !== null && noise === percentOf(settings.noise);
    const wanted = {
      integrator: byId('integrator').value,
      routes: byId('routes').value.trim(),
      layers: byId('layer-choice').value,
      seed: byId('seed').valueAsNumber,
      time: numberOrNull('time'),
      noise: noise === null ? null : keepsNoise ? settings.noise : noise / 100,
      resolution: [byId('width').valueAsNumber, byId('height').valueAsNumber],
    };
    return Object.fromEntries(Object.entries(wanted).filter(
      ([name, value]) => JSON.stringify(value) !== JSON.stringify(settings[name] ?? null)));
  }

  #showApply() {
    if (!this.#state?.settings) return;
    const valid = byId('settings-form').checkValidity();
    byId('apply').disabled = !valid || Object.keys(this.#changes()).length === 0;
  }
}

function percentOf(part) {
  return Number((100 * part).toPrecision(6));
}
