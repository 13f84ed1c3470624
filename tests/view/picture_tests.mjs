// The picture, its layers and its display.
// Run by page_test.mjs.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  expectSum, isPaused, openPanel, page, renderAllLayers, setInput, shot, sleep, state,
} from './live_page.mjs';

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

test('a histogram is drawn when its panel is opened', async () => {
  await openPanel('layers-panel');
  await page.evaluate(() => { document.querySelector('#histogram').width = 1; });
  await openPanel('display-panel');
  await page.waitFor(() => document.querySelector('#histogram').width > 100);
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
