// A picture file instead of a scene: node tests/view/picture_file_test.mjs NEPHROID [--screenshots
// DIRECTORY]. The picture is written here, so each of its values is known.
import assert from 'node:assert/strict';
import { mkdirSync, mkdtempSync, readdirSync, rmSync } from 'node:fs';
import { get } from 'node:http';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { Chromium } from './chromium.mjs';
import { startView } from './program.mjs';
import { writeExr } from './small_exr.mjs';

const [program, , screenshots] = process.argv.slice(2);
const kWidth = 96;
const kHeight = 64;
const kMaxPages = 16; // of the program
const kBroken = [[10, 8], [11, 8]]; // NaN and infinity
const kChannels = ['R', 'G', 'B', 'Z', 'samples', 'bias.Y', 'albedo.R', 'albedo.G', 'albedo.B',
  'N.X', 'N.Y', 'N.Z', 'stderr.R', 'stderr.G', 'stderr.B'];

function value(channel, x, y) {
  if (channel === 'R' && x === kBroken[0][0] && y === kBroken[0][1]) return NaN;
  if (channel === 'G' && x === kBroken[1][0] && y === kBroken[1][1]) return Infinity;
  return { R: x / kWidth, G: y / kHeight, B: 0.25, Z: 1 + x, samples: 4 + y, 'bias.Y': 0.5 - x / 64,
    'N.Z': 1, 'stderr.R': 0.1, 'stderr.G': 0.1, 'stderr.B': 0.1 }[channel] ?? 0.5;
}

let folder;
let view;
let browser;
let page;

async function shot(name) {
  if (screenshots) await page.screenshot(join(screenshots, `${name}.png`));
}

const readPixel = (x, y) => page.evaluate((...at) => window.nephroid.readPixel(...at), x, y);
const choose = (name) => page.evaluate((wanted) => {
  const select = document.querySelector('#view');
  select.value = wanted;
  select.dispatchEvent(new Event('change'));
  return window.nephroid.settled();
}, name);

/// The middle of a pixel of the picture, in CSS pixels of the page; the picture fits the stage.
async function placeOf([x, y]) {
  const box = await page.evaluate(() => {
    const { left, top, width, height } = document.querySelector('#stage').getBoundingClientRect();
    return { left, top, width, height };
  });
  const zoom = Math.min(box.width / kWidth, box.height / kHeight);
  return [box.left + box.width / 2 + zoom * (x + 0.5 - kWidth / 2),
    box.top + box.height / 2 + zoom * (y + 0.5 - kHeight / 2)];
}

/// Colours of the screen at pixels of the picture.
async function colorsOnScreen(pixels) {
  const places = await Promise.all(pixels.map(placeOf));
  const { data } = await page.send('Page.captureScreenshot', { format: 'png' });
  return page.evaluate(async (base64, at) => {
    const bytes = Uint8Array.from(atob(base64), (letter) => letter.charCodeAt(0));
    const bitmap = await createImageBitmap(new Blob([bytes]));
    const context = new OffscreenCanvas(bitmap.width, bitmap.height).getContext('2d');
    context.drawImage(bitmap, 0, 0);
    return at.map(([x, y]) => [...context.getImageData(x, y, 1, 1).data].slice(0, 3));
  }, data, places);
}

before(async () => {
  if (screenshots) mkdirSync(screenshots, { recursive: true });
  folder = mkdtempSync(join(tmpdir(), 'nephroid-view-'));
  const file = join(folder, 'known.exr');
  writeExr(file, kWidth, kHeight, kChannels, value);
  view = await startView(program, file, '--save-to', folder);
  browser = new Chromium();
  page = await browser.open(1280, 800);
  await page.goto(view.address);
  await page.waitFor(() => window.nephroid?.frameVersion > 0);
});

after(async () => {
  await browser?.close();
  await view?.stop();
  rmSync(folder, { recursive: true });
});

test('the pixels are those of the file', async () => {
  const [red, green, blue] = await readPixel(24, 16);
  assert.ok(Math.abs(red - 0.25) < 2 ** -11 && Math.abs(green - 0.25) < 2 ** -11);
  assert.ok(Math.abs(blue - 0.25) < 2 ** -11);
  await shot('picture');
});

test('there is nothing to render, to inspect or to look around in', async () => {
  for (const id of ['camera-panel', 'inspector-panel', 'render-panel', 'save-scene', 'save-mix']) {
    assert.ok(await page.evaluate((name) => document.querySelector(`#${name}`).hidden, id), id);
  }
  assert.ok(await page.evaluate(() => document.querySelector('[data-tool="camera"]').disabled));
  const note = await page.evaluate(() => document.querySelector('#layers-empty').textContent);
  assert.doesNotMatch(note, /Render/);
});

test('samples, bias, depth, albedo and normals are views', async () => {
  const expected = { samples: 4 + 16, bias: 0.5 - 24 / 64, Z: 25, albedo: 0.5, N: 0.5 };
  for (const [name, wanted] of Object.entries(expected)) {
    assert.ok(await choose(name), name);
    assert.ok(Math.abs((await readPixel(24, 16))[0] - wanted) < 1e-3 * wanted, name);
  }
  await choose('bias');
  await new Promise((resolve) => { setTimeout(resolve, 400); });
  await shot('bias');
  await choose('');
});

test('NaN and infinity are marked', async () => {
  const words = (x, y) => page.evaluate((...at) =>
    window.nephroid.readPixel(...at).map(String), x, y);
  assert.equal((await words(...kBroken[0]))[0], 'NaN');
  assert.equal((await words(...kBroken[1]))[1], 'Infinity');
  await page.waitFor(() => /not finite/.test(document.querySelector('#clip-note').textContent));
  await page.press('c', 'KeyC');
  const [nan, infinite, beside] = await colorsOnScreen([...kBroken, [30, 30]]);
  assert.deepEqual(nan, [0, 255, 0]);
  assert.deepEqual(infinite, [0, 255, 0]);
  assert.notDeepEqual(beside, [0, 255, 0]);
  await shot('not-finite');
  await page.press('c', 'KeyC');
});

test('the readout has the error of the picture, but not for a view', async () => {
  const place = await placeOf([48, 32]);
  await page.hover(...place);
  await page.waitFor(() => /±.*36 samples/.test(document.querySelector('#readout').textContent));
  await choose('Z');
  await page.waitFor(() => /48, 32 +49 /.test(document.querySelector('#readout').textContent));
  const text = await page.evaluate(() => document.querySelector('#readout').textContent);
  assert.doesNotMatch(text, /±/);
  await choose('');
});

test('what is saved goes to the directory, and the page says where', async () => {
  await page.evaluate(() => { document.querySelector('#save-panel').open = true; });
  await page.click('#save-exr');
  await page.waitFor(() => /Saved as .*known-2\.exr/.test(
    document.querySelector('#notice').textContent));
  await page.click('#save-png');
  await page.waitFor(() => /Saved as .*known\.png/.test(
    document.querySelector('#notice').textContent));
  assert.deepEqual(readdirSync(folder).sort(), ['known-2.exr', 'known.exr', 'known.png']);
});

test('a snapshot is compared', async () => {
  await page.evaluate(() => { document.querySelector('#compare-panel').open = true; });
  await page.click('#snapshot');
  await page.waitFor(() => /FLIP/.test(document.querySelector('#compare-figures').textContent));
});

test('a page too many says why it has no connection', async () => {
  const { cookies } = await page.send('Network.getCookies');
  const headers = { Cookie: cookies.map((one) => `${one.name}=${one.value}`).join('; ') };
  const events = new URL('/api/events', view.address);
  await page.goto('about:blank');
  const streams = [];
  const end = Date.now() + 20000;
  while (streams.length < kMaxPages) {
    const stream = get(events, { headers }).on('error', () => {});
    const { statusCode } = await new Promise((resolve) => { stream.once('response', resolve); });
    if (statusCode === 200) {
      streams.push(stream);
    } else {
      stream.destroy();
      await new Promise((resolve) => { setTimeout(resolve, 100); });
    }
    assert.ok(Date.now() < end, 'the first page does not give its connection back');
  }
  const other = await browser.open(800, 600);
  await other.goto(new URL('/', view.address).href);
  await other.waitFor(() => /too many pages/.test(document.querySelector('#notice')?.textContent));
  for (const stream of streams) stream.destroy();
  await other.waitFor(() => document.querySelector('#notice').hidden);
  await other.close();
});

test('nothing was complained of', () => {
  assert.deepEqual(page.problems, []);
});
