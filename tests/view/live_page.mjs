// The page in headless Chromium, for all tests: opened before them, closed after them.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { after, before } from 'node:test';
import { fileURLToPath } from 'node:url';

import { Chromium } from './chromium.mjs';
import { readFrame } from './frames.mjs';

const kHere = dirname(fileURLToPath(import.meta.url));
const kArguments = process.argv.slice(2);
const kScreenshotsAt = kArguments.indexOf('--screenshots');
const kScreenshots = kScreenshotsAt < 0 ? null : kArguments[kScreenshotsAt + 1];
const kAddress = kArguments.find((one) => one.startsWith('http'));
const kTolerance = 2 ** -10;
const kSquare = [[0.21, 0.33], [0.5, 0.5], [0.62, 0.81], [0.85, 0.4], [0.4, 0.93]];

export let mock = null;
export let mockAddress = '';
export let browser;
export let page;

/// What the program says right now.
export const state = () => page.evaluate(() => window.nephroid.state);
export const sleep = (milliseconds) =>
  new Promise((resolve) => { setTimeout(resolve, milliseconds); });

/// The file of a screenshot; null if none are wanted.
export const screenshots = kScreenshots && ((name) => join(kScreenshots, `${name}.png`));

export async function shot(name) {
  if (screenshots) await page.screenshot(screenshots(name));
}

/// Bytes that the page gets from the program.
export async function download(path) {
  const text = await page.evaluate(async (from) => {
    const bytes = new Uint8Array(await (await fetch(from)).arrayBuffer());
    let binary = '';
    for (let at = 0; at < bytes.length; at += 32768) {
      binary += String.fromCharCode(...bytes.subarray(at, at + 32768));
    }
    return btoa(binary);
  }, path);
  return Buffer.from(text, 'base64');
}

/// The frame of the program with those layers.
export async function frameOf(layers) {
  const query = new URLSearchParams({ layers: layers.join(','), generation: 0, since: 0 });
  return readFrame(await download(`api/frame?${query}`));
}

/// Asks for layers by route and by light, and pauses with their first pass.
export async function renderAllLayers() {
  const { generation } = await state();
  await page.evaluate(() => fetch('api/render', {
    method: 'POST', headers: { 'Content-Type': 'application/json' },
    body: JSON.stringify({ layers: 'lights' }) }));
  await page.waitFor((old) => window.nephroid.frame.generation > old &&
    window.nephroid.frame.passes > 0, [generation], 60000);
  await page.press('p', 'KeyP');
  await isPaused();
}

/// Compares pixels of the screen with the weighted sum of the program's layers.
export async function expectSum(weights) {
  assert.ok(await page.evaluate(() => window.nephroid.settled()), 'the layers never came');
  const frame = await frameOf(Object.keys(weights));
  const [x0, y0, x1, y1] = frame.header.window;
  for (const [u, v] of kSquare) {
    const x = Math.floor(u * (x1 - x0));
    const y = Math.floor(v * (y1 - y0));
    const shown = await page.evaluate((px, py) => window.nephroid.readPixel(px, py),
      x + x0, y + y0);
    for (let channel = 0; channel < 3; ++channel) {
      const expected = Object.entries(weights).reduce((sum, [name, weight]) =>
        sum + [weight].flat().at(channel % [weight].flat().length) *
          frame.value(name, x, y)[channel], 0);
      assert.ok(Math.abs(shown[channel] - expected) <= kTolerance * Math.abs(expected) + 1e-7,
        `pixel ${x}, ${y}, channel ${channel}: ${shown[channel]} instead of ${expected}`);
    }
  }
}

export async function setInput(selector, value, type = 'input') {
  await page.evaluate((found, wanted, name) => {
    const input = document.querySelector(found);
    input.value = wanted;
    input.dispatchEvent(new Event(name, { bubbles: true }));
  }, selector, value, type);
}

export const openPanel = (id) => page.evaluate((name) => {
  for (const panel of document.querySelectorAll('.panel')) panel.open = panel.id === name;
}, id);

export const isPaused = () => page.waitFor(() => window.nephroid.state.status !== 'rendering');

/// Starts the mock server and returns its address.
export async function startMock(...options) {
  mock = spawn('python3', [join(kHere, 'mock_server.py'), ...options],
    { stdio: ['ignore', 'pipe', 'inherit'] });
  return new Promise((resolve) => {
    mock.stdout.once('data', (bytes) => resolve(bytes.toString().trim()));
  });
}

export async function stopMock() {
  const ended = new Promise((resolve) => { mock.on('exit', resolve); });
  mock.kill();
  await ended;
}

before(async () => {
  if (kScreenshots) mkdirSync(kScreenshots, { recursive: true });
  let address = kAddress;
  if (!address) {
    address = mockAddress = await startMock('0');
  }
  browser = new Chromium();
  page = await browser.open(1280, 800);
  const begin = Date.now();
  await page.goto(address);
  // Reading a pixel waits until the picture is drawn.
  await page.waitFor(() => window.nephroid?.frameVersion > 0 &&
    window.nephroid.readPixel(...window.nephroid.frame.window));
  console.log(`a frame on the canvas after ${Date.now() - begin} ms`);
});

after(async () => {
  await browser?.close();
  mock?.kill();
});
