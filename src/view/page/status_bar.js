// The bar on top, the readout below, notices and the report: what the program says of itself.

import { byId, element } from './dom.js';
import {
  formatColor, formatCount, formatDuration, formatNumberOf, formatShare, luminance,
} from './format.js';

const kStatus = {
  loading: 'Loading', rendering: 'Rendering', paused: 'Paused', done: 'Done', failed: 'Failed' };
const kNoticeMs = 4000;

export class StatusBar {
  #spoken = ''; // status that was announced last
  #timer = 0;
  #lasting = ''; // notice that stays until it is cleared
  #report = '';

  setState(state) {
    document.title = `${state.scene} – Nephroid`;
    byId('scene-name').textContent = state.scene;
    byId('scene-name').title = state.scene;
    const text = statusText(state);
    byId('status-text').textContent = text;
    byId('status-text').title = text;
    byId('status-text').classList.toggle('bad', state.status === 'failed');
    byId('progress').value = state.progress?.fraction ?? 0;
    const rays = state.progress?.rays_per_second;
    byId('speed').textContent = state.status === 'rendering' && rays > 0
      ? `${formatCount(rays)} rays a second` : '';
    const spoken = state.status === 'rendering' ? kStatus.rendering : text;
    // Screen readers hear of changes of the status, not of each pass.
    if (spoken !== this.#spoken) this.announce(spoken);
    this.#spoken = spoken;
    this.#showReport(state);
  }

  /// Says a line to screen readers.
  announce(text) {
    byId('announcer').textContent = text;
  }

  /// A short word to the user that goes by itself.
  notify(text) {
    this.#showNotice(text);
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.#showNotice(this.#lasting), kNoticeMs);
  }

  /// A word that stays; '' takes it away.
  setLasting(text, large = false) {
    this.#lasting = text;
    clearTimeout(this.#timer);
    byId('notice').classList.toggle('large', large);
    this.#showNotice(text);
  }

  /// There is no connection: nothing is known of the program any more. `advice` is a sentence.
  setLost(why, advice, large = false) {
    byId('status-text').textContent = byId('status-text').title = why;
    byId('status-text').classList.add('bad');
    byId('speed').textContent = '';
    byId('progress').value = 0;
    this.#spoken = why;
    this.setLasting(`${why}. ${advice}`, large);
  }

  /// The pixel below the pointer; null clears. Errors and samples come later than the value.
  showPixel(pixel) {
    if (!pixel) {
      byId('readout').textContent = '';
      return;
    }
    const parts = [`${pixel.x}, ${pixel.y}`];
    if (pixel.value) parts.push(formatColor(pixel.value));
    if (pixel.error && luminance(pixel.error) > 0 && luminance(pixel.value) > 0) {
      parts.push(`± ${formatShare(luminance(pixel.error) / luminance(pixel.value))}`);
    }
    if (pixel.samples > 0) parts.push(formatNumberOf(pixel.samples, 'sample', 'samples'));
    byId('readout').textContent = parts.join('   ');
  }

  #showNotice(text) {
    byId('notice').textContent = text;
    byId('notice').hidden = text === '';
  }

  #showReport({ warnings = [], notes = [], report = [] }) {
    const key = JSON.stringify([warnings, notes, report]);
    if (key === this.#report) return;
    this.#report = key;
    byId('warning-count').hidden = warnings.length === 0;
    byId('warning-count').textContent = formatNumberOf(warnings.length, 'warning', 'warnings');
    const part = (title, lines, name) => (lines.length === 0 ? [] : [
      element('h3', { text: title }),
      ...lines.map((text) => element('p', { text, class: name }))]);
    byId('report').replaceChildren(...part('Warnings', warnings, 'warning'),
      ...part('Notes', notes), ...part('Choices of the program', report));
    if (byId('report').childElementCount === 0) {
      byId('report').append(element('p', { class: 'fine', text: 'Nothing to report yet.' }));
    }
  }
}

function statusText({ kind, status, message, progress = {} }) {
  if (kind === 'picture') return message || 'Picture';
  const parts = [kStatus[status] ?? status];
  if (message) parts.push(message);
  if (['rendering', 'paused', 'done'].includes(status) && progress.passes > 0) {
    parts.push(formatNumberOf(progress.passes, 'pass', 'passes'));
    parts.push(formatDuration(progress.seconds));
    if (Number.isFinite(progress.seconds_left)) {
      parts.push(`${formatDuration(progress.seconds_left)} left`);
    }
  }
  return parts.join(' · ');
}
