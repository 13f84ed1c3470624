// The panel that explains a pixel: its shares by route, layer, light and technique, and its
// brightest paths, each of which can be drawn over the picture.

import { byId, element, scrollToPanel, setFigures, showPanel } from './dom.js';
import { formatColor, formatShare, formatValue, luminance } from './format.js';
import { drawablePixels } from './path_projection.js';

const kTables = [
  ['routes', 'Routes'], ['layers', 'Layers'], ['lights', 'Lights, estimated'],
  ['techniques', 'Techniques, estimated']];

export class InspectorPanel {
  #server;
  #overlay;
  #camera;
  #view;
  #announce;
  #asked = 0; // counts requests; only the answer of the last one is shown

  constructor({ server, overlay, camera, view, announce }) {
    this.#server = server;
    this.#overlay = overlay;
    this.#camera = camera;
    this.#view = view;
    this.#announce = announce;
    byId('inspect-form').addEventListener('submit', (event) => {
      event.preventDefault();
      this.inspect(byId('inspect-x').valueAsNumber, byId('inspect-y').valueAsNumber);
    });
  }

  /// Asks the program about a pixel of the full picture and shows the answer.
  async inspect(x, y) {
    const number = ++this.#asked;
    const scrolled = showPanel(byId('inspector-panel'));
    byId('inspect-x').value = x;
    byId('inspect-y').value = y;
    byId('inspect-hint').textContent = 'Tracing paths of this pixel.';
    byId('inspect-hint').hidden = false;
    this.#overlay.showPixel(x, y);
    try {
      const answer = await this.#server.post('api/inspect', { x, y });
      if (number !== this.#asked) return;
      this.#show(answer);
      // Now it is longer, so there is more to scroll.
      if (scrolled) scrollToPanel(byId('inspector-panel'));
    } catch (error) {
      if (number !== this.#asked) return;
      byId('inspection').replaceChildren();
      byId('inspect-hint').textContent = error.message;
    }
  }

  /// The picture is another one: what was found does not hold for it.
  clear() {
    ++this.#asked;
    byId('inspection').replaceChildren();
    byId('inspect-hint').textContent = 'Click the picture to see which paths made a pixel.';
    byId('inspect-hint').hidden = false;
    this.#overlay.clear();
  }

  #show(answer) {
    byId('inspect-hint').hidden = true;
    const parts = [valueFigures(answer)];
    for (const [name, title] of kTables) {
      if (answer[name]?.length > 0) parts.push(element('h3', { text: title }),
        shareTable(answer[name], answer.value, title));
    }
    if (answer.paths?.length > 0) {
      parts.push(element('h3', { text: 'Brightest paths' }), this.#pathList(answer.paths));
    }
    const notes = answer.notes ?? [answer.note].filter(Boolean);
    parts.push(...notes.map((text) => element('p', { class: 'fine', text })));
    byId('inspection').replaceChildren(...parts);
    this.#announce(summary(answer));
  }

  #draw(path) {
    this.#overlay.showPath(
      path && drawablePixels(path, this.#camera.pose, this.#view.pictureSize));
  }

  #pathList(paths) {
    const buttons = paths.map((path) => {
      const button = element('button', { type: 'button', 'aria-pressed': 'false' },
        element('span', { class: 'word', text: path.word }),
        element('span', { class: 'about' },
          element('span', { text: [path.route, path.light, path.technique].filter(Boolean)
            .join(' · ') }),
          element('span', { text: `${formatShare(path.share)} ± ${
            formatShare(path.share_error)}` })));
      button.addEventListener('click', () => {
        const drawn = button.getAttribute('aria-pressed') === 'true';
        for (const one of buttons) {
          one.setAttribute('aria-pressed', String(one === button && !drawn));
        }
        this.#draw(drawn ? null : path);
      });
      return button;
    });
    buttons[0].setAttribute('aria-pressed', 'true');
    this.#draw(paths[0]);
    return element('ul', { class: 'paths' }, ...buttons.map((button) => element('li', {}, button)));
  }
}

// The answer in a line, for screen readers.
function summary({ x, y, value, routes = [], paths = [] }) {
  const total = luminance(value);
  const shares = routes.map((one) => ({ name: one.name, light: luminance(one.value) }))
    .filter(({ light }) => light > 0).sort((a, b) => b.light - a.light)
    .map(({ name, light }) => `${name} ${formatShare(light / total)}`);
  const [path] = paths;
  const brightest = path ? [`brightest path: ${[path.route, path.light, path.technique]
    .filter(Boolean).join(', ')}, ${formatShare(path.share)}`] : [];
  return [`Pixel ${x}, ${y}: value ${formatColor(value)}`, ...shares, ...brightest].join('; ');
}

function valueFigures(answer) {
  const list = element('dl', { class: 'figures' });
  setFigures(list, [['Value', formatColor(answer.value)],
    ['Error', luminance(answer.error) > 0 && `± ${formatColor(answer.error)}`],
    ['Samples', answer.samples]]);
  return list;
}

// Names, and bars of their share of the pixel's luminance, the largest first.
function shareTable(shares, whole, title) {
  const total = luminance(whole);
  const sorted = shares.map((one) => ({ ...one, light: luminance(one.value) }))
    .sort((a, b) => b.light - a.light);
  const rows = sorted.map((one) => {
    const { name, light } = one;
    const share = one.share ?? (total > 0 ? light / total : 0);
    const error = one.share_error ?? (total > 0 ? one.error / total : NaN);
    const fill = element('span', { class: 'bar-fill' });
    fill.style.width = `${100 * Math.min(1, Math.max(0, share))}%`;
    return element('tr', {}, element('th', { scope: 'row', text: name, title: name }),
      element('td', { class: 'track' }, element('span', { class: 'bar-track' }, fill)),
      element('td', { class: 'amount', text: formatShare(share), title: formatValue(light) }),
      element('td', { class: 'spread', text: error >= 0 ? `± ${formatShare(error)}` : '' }));
  });
  return element('table', { class: 'shares', 'aria-label': title }, ...rows);
}
