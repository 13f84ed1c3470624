// What a person does with the picture: inspect, compare, move the camera, crop, settings.
// Run by page_test.mjs.
import assert from 'node:assert/strict';
import { mkdtempSync, readdirSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';

import {
  browser, download, isPaused, mock, openPanel, page, setInput, shot, sleep, state,
} from './live_page.mjs';

test('a click brings the inspector into sight', async () => {
  await page.evaluate(() => {
    for (const panel of document.querySelectorAll('.panel')) {
      panel.open = panel.id !== 'inspector-panel';
    }
    document.querySelector('#sections').scrollTop = 0;
  });
  await page.resize(1280, 500);
  const [x, y] = await page.middle('#stage');
  await page.clickAt(x + 20, y + 20);
  await page.waitFor(() => document.querySelector('#inspection .paths button'));
  await shot('inspector-in-sight');
  const [list, panel] = await page.evaluate(() => ['#sections', '#inspector-panel'].map((one) =>
    document.querySelector(one).getBoundingClientRect().top));
  assert.ok(Math.abs(list - panel) < 2, `the panel is at ${panel}, the list at ${list}`);
  assert.equal(await page.evaluate(() => document.body.scrollTop), 0);
  await page.resize(1280, 800);
});

test('a click explains a pixel', async () => {
  await openPanel('inspector-panel');
  const [x, y] = await page.middle('#stage');
  await page.clickAt(x + 60, y + 200);
  await page.waitFor(() => document.querySelector('#overlay .path'));
  const rows = await page.evaluate(() => [...document.querySelectorAll('.shares')].map((table) =>
    [...table.querySelectorAll('.amount')].map((cell) => parseFloat(cell.textContent))));
  assert.ok(rows.length >= 2);
  const sum = rows[0].reduce((a, b) => a + b, 0);
  assert.ok(Math.abs(sum - 100) < 1, `the routes sum to ${sum} %`);
  const length = await page.evaluate(() =>
    document.querySelector('#overlay .path').getTotalLength());
  assert.ok(length > 5, `a line of ${length} pixels`);
  const [spoken, role] = await page.evaluate(() => [
    document.querySelector('#announcer').textContent, document.activeElement.role]);
  assert.match(spoken, /^Pixel \d+, \d+: value .*; brightest path: .* %$/);
  assert.equal(role, 'application');
  await page.waitFor(() => /\d/.test(document.querySelector('#readout').textContent));
  await shot('inspector');
});

test('a snapshot is compared by slider, blink, difference and heat map', async () => {
  await openPanel('compare-panel');
  await page.click('#snapshot');
  await page.waitFor(() => !document.querySelector('#split').hidden);
  await page.evaluate(() => {
    const [route] = window.nephroid.state.layers.filter(({ kind }) => kind === 'route');
    window.nephroid.setGain(route.name, 3);
  });
  await page.evaluate(() => window.nephroid.settled());
  const [x, y] = await page.middle('#split');
  await page.drag([x, y], [x - 150, y]);
  const place = await page.evaluate(() => Number(document.querySelector('#split').ariaValueNow));
  assert.ok(place > 20 && place < 45, `the slider is at ${place} %`);
  await shot('compare');
  for (const mode of ['blink', 'difference', 'flip', 'relmse']) {
    await page.click(`[data-compare="${mode}"]`);
    await page.waitFor(() => !/Measuring/.test(document.querySelector('#tag-right').textContent));
    await sleep(900);
    await shot(`compare-${mode}`);
  }
  await page.waitFor(() => /relMSE/.test(document.querySelector('#compare-figures').textContent));
  await setInput('#compare-with', '', 'change');
  await openPanel('layers-panel');
  await page.click('#mix-reset');
});

test('what is compared is the mix, and its figures follow it', async () => {
  await page.evaluate(() => {
    if (window.nephroid.state.status === 'rendering') document.querySelector('#pause').click();
  });
  await isPaused();
  await openPanel('compare-panel');
  await page.click('#snapshot');
  await setInput('#compare-with', '', 'change');
  const newest = () => page.evaluate(() =>
    [...document.querySelectorAll('#compare-with option')].at(-1).value);
  await setInput('#compare-with', await newest(), 'change');
  const relmse = () => page.evaluate(() => {
    const text = document.querySelector('#compare-figures').textContent;
    const [, value] = text.match(/relMSE([-+.e\d]+?)relMSE/) ?? [];
    return { value: parseFloat(value), mix: /mix/.test(text) };
  });
  await page.waitFor(() => /Measured/.test(document.querySelector('#compare-figures').textContent));
  assert.deepEqual(await relmse(), { value: 0, mix: false });
  await page.evaluate(() => {
    for (const { name, kind } of window.nephroid.state.layers) {
      if (kind === 'route') window.nephroid.setGain(name, 3);
    }
  });
  await page.waitFor(() => /mix/.test(document.querySelector('#compare-figures').textContent));
  assert.ok((await relmse()).value > 1, 'three times the light');
  const before = await newest();
  await page.click('#snapshot');
  await page.waitFor((old) => [...document.querySelectorAll('#compare-with option')].at(-1).value
    !== old, [before]);
  await setInput('#compare-with', await newest(), 'change');
  await page.waitFor(() => /relMSE0relMSE trim0FLIP0/.test(
    document.querySelector('#compare-figures').textContent));
  assert.deepEqual(await relmse(), { value: 0, mix: true });
  await setInput('#compare-with', '', 'change');
});

test('the error of the readout is not that of a mix', async () => {
  const [x, y] = await page.middle('#stage');
  await page.hover(x + 3, y + 9);
  await page.waitFor(() => /sample|pass/.test(document.querySelector('#readout').textContent));
  assert.doesNotMatch(await page.evaluate(() => document.querySelector('#readout').textContent),
    /±/);
  await openPanel('layers-panel');
  await page.click('#mix-reset');
  await page.evaluate(() => window.nephroid.settled());
  await page.hover(x + 5, y + 9);
  if (mock) {
    await page.waitFor(() => /±/.test(document.querySelector('#readout').textContent));
  }
});

test('a file is downloaded, and the page says why if it is not', async () => {
  const folder = mkdtempSync(join(tmpdir(), 'nephroid-view-'));
  await browser.send('Browser.setDownloadBehavior', { behavior: 'allow', downloadPath: folder });
  await openPanel('save-panel');
  await page.click('#save-exr');
  const end = Date.now() + 20000;
  while (!readdirSync(folder).some((name) => name.endsWith('.exr')) && Date.now() < end) {
    await sleep(100);
  }
  assert.match(readdirSync(folder).join(), /^[\w-]+\.exr$/);
  rmSync(folder, { recursive: true });
  await page.evaluate(() => {
    document.querySelector('#save-png').href = 'api/save?kind=nonsense';
  });
  await page.click('#save-png');
  await page.waitFor(() => /nonsense.*not valid/.test(
    document.querySelector('#notice').textContent));
  // Chromium tells of each answer that is an error.
  assert.match(page.problems.pop(), /nonsense/);
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
