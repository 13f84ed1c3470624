// How soon a person sees something: node tests/view/first_picture_test.mjs NEPHROID, on a machine
// that does nothing else. Program and tab are new, the browser is open, as a user's is.
import assert from 'node:assert/strict';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

import { Chromium } from './chromium.mjs';
import { startView } from './program.mjs';

const kScenes = join(dirname(fileURLToPath(import.meta.url)), '..', '..', 'scenes');
const kLimitMs = 1500;
const [program] = process.argv.slice(2);

/// When the browser put the first picture on the screen, in milliseconds from the start of the
/// navigation to the printed address. Chromium tells it of images with an "elementtiming".
function timeOfPicture() {
  return new Promise((resolve) => {
    new PerformanceObserver((list) => resolve(list.getEntries()[0].renderTime))
      .observe({ type: 'element', buffered: true });
  });
}

/// Smallest and largest byte of the first picture, so that a black one does not count.
function rangeOfPicture() {
  const image = document.querySelector('#first-picture');
  const canvas = document.createElement('canvas');
  [canvas.width, canvas.height] = [image.naturalWidth, image.naturalHeight];
  const context = canvas.getContext('2d');
  context.drawImage(image, 0, 0);
  const colors = context.getImageData(0, 0, canvas.width, canvas.height).data
    .filter((value, at) => at % 4 !== 3);
  return [colors.reduce((a, b) => Math.min(a, b)), colors.reduce((a, b) => Math.max(a, b))];
}

for (const scene of ['coffee-cup', 'pool']) {
  test(`${scene} at its own size is seen within ${kLimitMs} ms`, async () => {
    const browser = new Chromium();
    const page = await browser.open(1280, 800);
    const view = await startView(program, join(kScenes, scene, 'scene.pbrt'));
    try {
      await page.goto(view.address);
      const painted = await page.evaluate(timeOfPicture);
      await page.waitFor(() => window.nephroid?.frameVersion > 0 &&
        window.nephroid.readPixel(...window.nephroid.frame.window));
      const sharp = await page.evaluate(() => performance.now());
      console.log(`${scene}: first picture after ${painted.toFixed(0)} ms, ` +
        `WebGL's after ${sharp.toFixed(0)} ms`);
      const [darkest, brightest] = await page.evaluate(rangeOfPicture);
      assert.ok(brightest - darkest > 100, `the picture has values from ${darkest} to ${brightest}`);
      assert.ok(await page.evaluate(() => document.querySelector('#first-picture').hidden),
        'the first picture still lies on the canvas');
      assert.ok(painted > 0 && painted < kLimitMs, `seen after ${painted} ms`);
      assert.deepEqual(page.problems, []);
    } finally {
      await view.stop();
      await browser.close();
    }
  });
}
