// The small picture that index.html shows until WebGL draws the same one.

import { byId } from './dom.js';

const kLongestWaitMs = 1000; // a hidden page is never painted

/// Resolves when the browser has painted it, or if there is none.
export async function firstPicturePainted() {
  const image = byId('first-picture');
  const painted = image.decode().then(nextFrame).then(nextFrame);
  const tooLong = new Promise((resolve) => { setTimeout(resolve, kLongestWaitMs); });
  await Promise.race([painted, tooLong]).catch(hideFirstPicture);
}

export function hideFirstPicture() {
  byId('first-picture').hidden = true;
}

function nextFrame() {
  return new Promise((resolve) => { requestAnimationFrame(() => setTimeout(resolve)); });
}
