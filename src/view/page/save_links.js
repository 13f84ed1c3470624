// Links that save. The page asks for the file by itself, so that it can tell what went wrong. The
// browser then downloads it, or the program has written it to a directory of its own.

import { byId, element } from './dom.js';

const kLinks = ['save-mix', 'save-exr', 'save-png', 'save-scene'];
const kKeptMs = 60000; // a download has begun long before

export function setUpSaveLinks(server, notify) {
  for (const id of kLinks) {
    byId(id).addEventListener('click', async (event) => {
      event.preventDefault();
      notify('Saving.');
      try {
        const { saved, blob, name } = await server.file(event.target.href);
        if (saved) notify(`Saved as ${saved}`);
        else download(blob, name);
      } catch (error) {
        notify(error.message);
      }
    });
  }
}

function download(blob, name) {
  const href = URL.createObjectURL(blob);
  element('a', { href, download: name }).click();
  setTimeout(() => URL.revokeObjectURL(href), kKeptMs);
}
