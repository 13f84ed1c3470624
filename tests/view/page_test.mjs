// End to end: the page in headless Chromium against a live view.
//   node tests/view/page_test.mjs [ADDRESS] [--screenshots DIRECTORY]
// ADDRESS is what the program prints, with its token; without one the mock server is started.
import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { dirname, join } from 'node:path';
import { after, before, test } from 'node:test';
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

let mock = null;
let mockAddress = '';
let browser;
let page;

/// What the program says right now.
const state = () => page.evaluate(() => window.nephroid.state);
const sleep = (milliseconds) => new Promise((resolve) => { setTimeout(resolve, milliseconds); });

async function shot(name) {
  if (kScreenshots) await page.screenshot(join(kScreenshots, `${name}.png`));
}

/// Bytes that the page gets from the program.
async function download(path) {
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
async function frameOf(layers) {
  const query = new URLSearchParams({ layers: layers.join(','), generation: 0, since: 0 });
  return readFrame(await download(`api/frame?${query}`));
}

/// Asks for layers by route and by light, and pauses with their first pass.
async function renderAllLayers() {
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
async function expectSum(weights) {
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

async function setInput(selector, value, type = 'input') {
  await page.evaluate((found, wanted, name) => {
    const input = document.querySelector(found);
    input.value = wanted;
    input.dispatchEvent(new Event(name, { bubbles: true }));
  }, selector, value, type);
}

const openPanel = (id) => page.evaluate((name) => {
  for (const panel of document.querySelectorAll('.panel')) panel.open = panel.id === name;
}, id);

const isPaused = () => page.waitFor(() => window.nephroid.state.status !== 'rendering');

/// Starts the mock server and returns its address.
async function startMock(...options) {
  mock = spawn('python3', [join(kHere, 'mock_server.py'), ...options],
    { stdio: ['ignore', 'pipe', 'inherit'] });
  return new Promise((resolve) => {
    mock.stdout.once('data', (bytes) => resolve(bytes.toString().trim()));
  });
}

async function stopMock() {
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
  console.log(`first picture after ${Date.now() - begin} ms`);
});

after(async () => {
  await browser?.close();
  mock?.kill();
});

test('the first picture fills the stage', async () => {
  await page.waitFor(() => !window.nephroid.frame.preview && window.nephroid.frame.passes > 0, [],
    60000);
  const { width, height } = await state();
  assert.equal((await page.evaluate(() => window.nephroid.frame)).width, width);
  const value = await page.evaluate((x, y) => window.nephroid.readPixel(x, y),
    Math.floor(width / 2), Math.floor(height / 2));
  assert.equal(value.length, 3);
  assert.ok(value.every(Number.isFinite));
  assert.equal(await page.evaluate(() => window.nephroid.readPixel(-1, 0)), null);
  await shot('first-picture');
});

test('the picture alone is fetched as long as nothing is mixed', async () => {
  const { layers } = await page.evaluate(() => window.nephroid.frame);
  assert.deepEqual(layers.map((layer) => layer.name), ['picture']);
  await page.press('p', 'KeyP');
  await isPaused();
  await expectSum({ picture: 1 });
});

for (const kind of ['route', 'light']) {
  test(`gains of ${kind}s change the pixels exactly`, async (t) => {
    const { kind: source, settings } = await state();
    if (source === 'scene' && settings.layers === 'routes') await renderAllLayers();
    const names = (await state()).layers.filter((one) => one.kind === kind).map((one) => one.name);
    if (names.length === 0) return t.skip(`the picture has no ${kind}s`);
    await openPanel('layers-panel');
    await page.click(`#layers-panel [data-kind="${kind}"]`);
    const weights = Object.fromEntries(names.map((name, index) => [name, 0.25 + 0.75 * index]));
    for (const [name, gain] of Object.entries(weights)) {
      await page.evaluate((layer, value) => window.nephroid.setGain(layer, value), name, gain);
    }
    await expectSum(weights);
    await shot(`gains-${kind}`);
    await page.click('#mix-reset');
    await page.evaluate(() => window.nephroid.settled());
    const { layers } = await page.evaluate(() => window.nephroid.frame);
    assert.deepEqual(layers.map((layer) => layer.name), ['picture']);
  });
}

test('sliders, solo, off and tint are what they say', async () => {
  await openPanel('layers-panel');
  const names = await page.evaluate(() =>
    [...document.querySelectorAll('.layer-name')].map((one) => one.textContent));
  const others = (value) => Object.fromEntries(names.slice(1).map((name) => [name, value]));
  const [first] = names;
  await setInput(`[aria-label="${first}: gain"]`, '1');
  await expectSum({ [first]: 2, ...others(1) });
  await page.click(`[aria-label="${first}: solo"]`);
  await expectSum({ [first]: 2, ...others(0) });
  await page.click(`[aria-label="${first}: solo"]`);
  await page.click(`[aria-label="${first}: on"]`);
  await expectSum({ [first]: 0, ...others(1) });
  await page.click(`[aria-label="${first}: on"]`);
  await setInput(`[aria-label="${first}: tint"]`, '#ff8000');
  const half = ((0x80 / 255 + 0.055) / 1.055) ** 2.4;
  await expectSum({ [first]: [2, 2 * half, 0], ...others(1) });
  await setInput(`[aria-label="${first}: gain"]`, '-10');
  await expectSum({ [first]: 0, ...others(1) });
  await setInput(`[aria-label="${first}: gain"]`, '1.5');
  await shot('tint');
});

test('the mix is in the link that saves it', async () => {
  const href = await page.evaluate(() => document.querySelector('#save-mix').href);
  const query = new URL(href).searchParams;
  assert.equal(query.get('kind'), 'exr');
  const mix = Object.values(JSON.parse(query.get('mix')));
  assert.ok(mix.some((value) => Array.isArray(value) && Math.abs(value[0] - 2 ** 1.5) < 1e-9));
  const answer = await page.evaluate(async (url) => {
    const response = await fetch(url);
    return [response.status, response.headers.get('Content-Disposition')];
  }, href);
  assert.equal(answer[0], 200);
  assert.match(answer[1], /^attachment/);
  await page.click('#mix-reset');
});

test('the display: false colour with its legend, clipping marks, white, views', async () => {
  await openPanel('display-panel');
  await page.press('v', 'KeyV');
  await page.waitFor(() => !document.querySelector('#legend').hidden);
  await shot('false-colour');
  await page.press('v', 'KeyV');
  await page.press('c', 'KeyC');
  await setInput('#exposure', '1.5');
  await page.waitFor(() => /white/.test(document.querySelector('#clip-note').textContent));
  await shot('clipping');
  await page.click('#display-reset');
  await setInput('#kelvin', '3200');
  await sleep(400);
  await shot('white-point');
  await page.click('#display-reset');
  const features = (await state()).layers.filter((one) => one.kind === 'feature');
  for (const { name } of features) {
    await setInput('#view', name, 'change');
    assert.ok(await page.evaluate(() => window.nephroid.settled()));
    await sleep(400);
    await shot(`view-${name}`);
  }
  await setInput('#view', '', 'change');
  await page.evaluate(() => window.nephroid.settled());
});

test('a click explains a pixel', async () => {
  await openPanel('inspector-panel');
  const [x, y] = await page.middle('#stage');
  await page.clickAt(x + 60, y + 200);
  await page.waitFor(() => document.querySelector('#inspection .paths button'));
  const rows = await page.evaluate(() => [...document.querySelectorAll('.shares')].map((table) =>
    [...table.querySelectorAll('.amount')].map((cell) => parseFloat(cell.textContent))));
  assert.ok(rows.length >= 2);
  const sum = rows[0].reduce((a, b) => a + b, 0);
  assert.ok(Math.abs(sum - 100) < 1, `the routes sum to ${sum} %`);
  const length = await page.evaluate(() =>
    document.querySelector('#overlay .path').getTotalLength());
  assert.ok(length > 5, `a line of ${length} pixels`);
  await page.waitFor(() => /\d/.test(document.querySelector('#readout').textContent));
  await shot('inspector');
});

test('a snapshot is compared by slider, blink, difference and heat map', async () => {
  await openPanel('compare-panel');
  await page.click('#snapshot');
  await page.waitFor(() => !document.querySelector('#split').hidden);
  await page.evaluate(() => window.nephroid.setGain(window.nephroid.state.layers[1].name, 3));
  await page.evaluate(() => window.nephroid.settled());
  const [x, y] = await page.middle('#split');
  await page.drag([x, y], [x - 150, y]);
  const place = await page.evaluate(() => Number(document.querySelector('#split').ariaValueNow));
  assert.ok(place > 20 && place < 45, `the slider is at ${place} %`);
  await shot('compare');
  for (const mode of ['blink', 'difference', 'flip', 'relmse']) {
    await page.click(`[data-compare="${mode}"]`);
    await sleep(900);
    await shot(`compare-${mode}`);
  }
  await page.waitFor(() => /relMSE/.test(document.querySelector('#compare-figures').textContent));
  await setInput('#compare-with', '', 'change');
  await openPanel('layers-panel');
  await page.click('#mix-reset');
});

test('a saved picture is opened and compared', async () => {
  const file = join(tmpdir(), `nephroid-view-${process.pid}.exr`);
  writeFileSync(file, await download('api/save?kind=exr'));
  await openPanel('compare-panel');
  await page.chooseFile('#compare-file', file);
  await page.waitFor((name) => {
    const [chosen] = document.querySelector('#compare-with').selectedOptions;
    return chosen.textContent.includes(name);
  }, [`nephroid-view-${process.pid}`]);
  await page.waitFor(() => /FLIP0/.test(document.querySelector('#compare-figures').textContent));
  rmSync(file);
  await page.click('#compare-remove');
  await page.waitFor((name) => !document.querySelector('#compare-with').textContent.includes(name),
    [`nephroid-view-${process.pid}`]);
});

test('a drag orbits with one request at a time, and Ctrl+Z goes back', async (t) => {
  const { camera, generation, width } = await state();
  if (!camera?.can_move) return t.skip('the camera cannot move');
  await page.evaluate(() => {
    window.cameraRequests = { now: 0, most: 0, bodies: [] };
    const original = window.fetch;
    window.fetch = async (path, options) => {
      if (!String(path).startsWith('api/camera')) return original(path, options);
      const count = window.cameraRequests;
      count.most = Math.max(count.most, ++count.now);
      count.bodies.push(JSON.parse(options.body));
      try { return await original(path, options); } finally { --count.now; }
    };
  });
  await openPanel('camera-panel');
  const [x, y] = await page.middle('#stage');
  await page.drag([x, y], [x + 120, y - 30]);
  await page.waitFor((old) => window.nephroid.frame.generation > old, [generation]);
  await shot('moving');
  await page.waitFor((full) => window.nephroid.frame.width === full &&
    !window.nephroid.state.preview && !window.nephroid.frame.preview, [width], 30000);
  const requests = await page.evaluate(() => window.cameraRequests);
  assert.equal(requests.most, 1);
  assert.equal(requests.bodies.at(-1).moving, false);
  assert.ok(requests.bodies.slice(0, -1).every((body) => body.moving));
  const moved = (await state()).camera;
  const length = ({ eye, target }) => Math.hypot(...eye.map((value, axis) => value - target[axis]));
  const step = Math.hypot(...moved.eye.map((value, axis) => value - camera.eye[axis]));
  assert.ok(step > 0.1 * length(camera));
  assert.ok(Math.abs(length(moved) / length(camera) - 1) < 1e-3);
  await shot('orbited');
  await page.press('z', 'KeyZ', 2);
  await page.waitFor((eye) => window.nephroid.state.camera.eye.every(
    (value, axis) => Math.abs(value - eye[axis]) < 1e-4), [camera.eye]);
});

test('a pan moves the scene with the pointer', async (t) => {
  const { camera, width, height } = await state();
  if (!camera?.can_move) return t.skip('the camera cannot move');
  const pick = (x, y) => page.evaluate(async (body) => (await (await fetch('api/pick', {
    method: 'POST', headers: { 'Content-Type': 'application/json' }, body: JSON.stringify(body),
  })).json()).point, { x, y });
  const [column, row] = [Math.floor(width / 2), Math.floor(0.6 * height)];
  const middle = await pick(column, row);
  const right = await pick(column + Math.ceil(width / 100), row);
  if (!middle || !right) return t.skip('the middle of the picture is empty');
  const [x, y] = await page.middle('#stage');
  await page.drag([x, y], [x + 60, y], 'right');
  await page.waitFor((old) => String(window.nephroid.state.camera.eye) !== String(old) &&
    !window.nephroid.state.preview, [camera.eye]);
  await sleep(500);
  const now = await pick(column, row);
  const along = now.reduce((sum, value, axis) =>
    sum + (value - middle[axis]) * (right[axis] - middle[axis]), 0);
  assert.ok(along < 0, 'what was to the left is in the middle now');
  await page.press('z', 'KeyZ', 2);
});

test('the wheel dollies, arrow keys orbit, focus is clicked', async (t) => {
  const { camera } = await state();
  if (!camera?.can_move) return t.skip('the camera cannot move');
  const [x, y] = await page.middle('#stage');
  await page.wheel(x, y, -200);
  await page.waitFor((eye) => Math.hypot(...window.nephroid.state.camera.eye.map(
    (value, axis) => value - eye[axis])) > 1e-3, [camera.eye]);
  await page.press('z', 'KeyZ', 2);
  await sleep(500);
  const before = (await state()).camera.eye;
  await page.evaluate(() => document.querySelector('#stage').focus());
  await page.press('ArrowLeft', 'ArrowLeft');
  await page.waitFor((eye) => Math.hypot(...window.nephroid.state.camera.eye.map(
    (value, axis) => value - eye[axis])) > 1e-3, [before]);
  await page.click('#focus-pick');
  await page.clickAt(x, y);
  await page.waitFor((old) => window.nephroid.state.camera.focal_distance !== old,
    [camera.focal_distance]);
});

test('a drawn rectangle is rendered alone', async (t) => {
  if ((await state()).kind !== 'scene') return t.skip('nothing renders');
  await page.evaluate(() => document.querySelector('#pause-icon').click());
  await page.click('[data-tool="crop"]');
  const [x, y] = await page.middle('#stage');
  await page.drag([x - 100, y - 80], [x + 120, y + 90]);
  await page.waitFor(() => {
    const { window: at, width } = window.nephroid.frame;
    return !window.nephroid.frame.preview && at[2] - at[0] < width;
  }, [], 30000);
  await openPanel('render-panel');
  await shot('crop');
  await page.click('#crop-clear');
  await page.waitFor(() => {
    const { window: at, width } = window.nephroid.frame;
    return !window.nephroid.frame.preview && at[2] - at[0] === width;
  }, [], 30000);
});

test('settings are applied, and only those that were changed', async (t) => {
  const { kind, generation } = await state();
  if (kind !== 'scene') return t.skip('nothing renders');
  assert.ok(await page.evaluate(() => document.querySelector('#apply').disabled));
  await setInput('#seed', '7');
  await setInput('#noise', '2.5');
  await page.click('#apply');
  await page.waitFor((old) => window.nephroid.state.generation > old &&
    window.nephroid.state.settings.seed === 7, [generation]);
  const { settings } = await state();
  assert.ok(Math.abs(settings.noise - 0.025) < 1e-6);
  await page.waitFor(() => document.querySelector('#apply').disabled);
  await setInput('#seed', '0');
  await setInput('#noise', '');
  await page.click('#apply');
  await page.waitFor(() => window.nephroid.state.settings.noise === null);
});

test('the help lists the keys', async () => {
  await page.press('?', 'Slash');
  await page.waitFor(() => document.querySelector('#help').open);
  await shot('help');
  await page.click('#help button');
  await page.waitFor(() => !document.querySelector('#help').open);
});

test('every control has a name', async () => {
  const unnamed = await page.evaluate(() => [...document.querySelectorAll(
    'button, input, select, textarea, a, summary, [role=slider]')].filter((one) =>
    !(one.textContent.trim() || one.ariaLabel || one.labels?.length > 0)).map((one) =>
    one.outerHTML));
  assert.deepEqual(unnamed, []);
});

test('text has contrast enough for AA', async () => {
  const low = await page.evaluate(() => {
    const numbers = (color) => color.match(/[\d.]+/g).map(Number);
    const light = (color) => {
      const [r, g, b] = numbers(color).map((value) => {
        const part = value / 255;
        return part <= 0.04045 ? part / 12.92 : ((part + 0.055) / 1.055) ** 2.4;
      });
      return 0.2126 * r + 0.7152 * g + 0.0722 * b;
    };
    const groundOf = (one) => {
      const color = getComputedStyle(one).backgroundColor;
      return numbers(color)[3] === 0 && one.parentElement ? groundOf(one.parentElement) : color;
    };
    const ratio = (a, b) => (Math.max(a, b) + 0.05) / (Math.min(a, b) + 0.05);
    return [...document.querySelectorAll('body *:not(:disabled, option)')]
      .filter((one) => [...one.childNodes].some((node) =>
        node.nodeType === Node.TEXT_NODE && node.textContent.trim()))
      .filter((one) => ratio(light(getComputedStyle(one).color), light(groundOf(one))) < 4.5)
      .map((one) => one.outerHTML);
  });
  assert.deepEqual(low, []);
});

test('at 360 pixels nothing is cut off', async () => {
  await page.resize(360, 740);
  await sleep(500);
  await shot('narrow');
  await page.click('#sheet-handle');
  const panels = await page.evaluate(() =>
    [...document.querySelectorAll('.panel')].map((one) => one.id));
  for (const id of panels) {
    await openPanel(id);
    await sleep(150);
    await shot(`narrow-${id}`);
    const wide = await page.evaluate(() =>
      [...document.querySelectorAll('body *:not(#overlay *, .unseen)')].filter((one) => {
        const box = one.getBoundingClientRect();
        return box.width > 1 && (box.right > 360.5 || box.left < -0.5);
      }).map((one) => one.id || one.className || one.tagName));
    assert.deepEqual(wide, [], `in the panel ${id}`);
    assert.ok(await page.evaluate(() => document.scrollingElement.scrollWidth <= innerWidth));
  }
  await page.resize(1280, 800);
});

test('the picture comes back after the graphics card was reset', async () => {
  await page.evaluate(() => {
    window.card = document.querySelector('#canvas').getContext('webgl2')
      .getExtension('WEBGL_lose_context');
    window.card.loseContext();
  });
  await page.waitFor(() => /was reset/.test(document.querySelector('#notice').textContent));
  await page.evaluate(() => window.card.restoreContext());
  await page.waitFor(() => window.nephroid.frame && document.querySelector('#notice').hidden);
  await page.evaluate(() => document.querySelector('#pause-icon').click());
  await isPaused();
  await sleep(500);
  await expectSum({ picture: 1 });
});

test('without WebGL 2 the page says so', async () => {
  const other = await browser.open(800, 600);
  await other.runFirst(() => {
    HTMLCanvasElement.prototype.getContext = () => null;
  });
  await other.goto(new URL('/', await page.evaluate(() => location.href)).href);
  await other.waitFor(() => /WebGL 2/.test(document.querySelector('#notice')?.textContent));
  assert.deepEqual(other.problems, []);
  await other.close();
});

test('nothing was complained of', () => {
  assert.deepEqual(page.problems, []);
});

test('a lost connection is told and found again', async (t) => {
  if (!mock) return t.skip('only with the mock server');
  const { port, searchParams } = new URL(mockAddress);
  await stopMock();
  await page.waitFor(() => /No connection/.test(document.querySelector('#notice').textContent));
  await shot('lost');
  await startMock(port, searchParams.get('token'));
  await page.waitFor(() => document.querySelector('#notice').hidden);
  await page.waitFor(() => window.nephroid.frame?.generation === window.nephroid.state.generation);
});

test('a program started again wants its new address', async (t) => {
  if (!mock) return t.skip('only with the mock server');
  await stopMock();
  await startMock(new URL(mockAddress).port, 'another');
  await page.waitFor(() => /started again/.test(document.querySelector('#notice').textContent));
  await shot('refused');
});
