// Links that save. The browser downloads the file, or the program writes it to a directory of its
// own and says where.

import { byId } from './dom.js';

const kLinks = ['save-mix', 'save-exr', 'save-png', 'save-scene'];

/// directory: () => where the program writes, or nothing if files are downloaded.
export function setUpSaveLinks(server, directory, notify) {
  for (const id of kLinks) {
    byId(id).addEventListener('click', async (event) => {
      if (!directory()) return;
      event.preventDefault();
      try {
        const { saved } = await server.get(event.target.href);
        notify(`Saved as ${saved}`);
      } catch (error) {
        notify(error.message);
      }
    });
  }
}
