// Zoom buttons, full screen, and panels that are shown, hidden or pulled up as a sheet.

import { byId, scrollToPanel } from './dom.js';

const kNarrow = '(max-width: 719px)';

/// Returns {togglePanels}.
export function setUpWindow(view) {
  byId('zoom-fit').addEventListener('click', () => view.fit());
  byId('zoom-actual').addEventListener('click', () => view.actual());
  view.addEventListener('change', () => showZoom(view));
  byId('full-screen').addEventListener('click', () => {
    if (document.fullscreenElement) document.exitFullscreen();
    else document.documentElement.requestFullscreen?.(); // iPhones have none
  });
  byId('toggle-panels').addEventListener('click', togglePanels);
  byId('sheet-handle').addEventListener('click', togglePanels);
  if (matchMedia(kNarrow).matches) closePanels(byId('layers-panel'));
  for (const panel of document.querySelectorAll('.panel')) {
    panel.addEventListener('toggle', () => showInSheet(panel));
  }
  return { togglePanels };
}

function togglePanels() {
  if (matchMedia(kNarrow).matches) {
    const open = byId('panels').classList.toggle('open');
    byId('sheet-handle').setAttribute('aria-expanded', String(open));
  } else {
    const hidden = document.body.classList.toggle('no-panels');
    byId('toggle-panels').setAttribute('aria-expanded', String(!hidden));
  }
}

// The sheet has room for one panel, at its top.
function showInSheet(panel) {
  if (!panel.open || !matchMedia(kNarrow).matches) return;
  closePanels(panel);
  scrollToPanel(panel);
}

function closePanels(except) {
  for (const panel of document.querySelectorAll('.panel')) {
    if (panel !== except) panel.open = false;
  }
}

function showZoom(view) {
  byId('zoom-value').textContent = view.hasPicture ? `${Math.round(100 * view.zoom)} %` : '';
  byId('zoom-fit').setAttribute('aria-pressed', String(view.fitted));
  byId('zoom-actual').setAttribute('aria-pressed', String(!view.fitted && view.zoom === 1));
}
