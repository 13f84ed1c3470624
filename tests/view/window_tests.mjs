// The page itself: names, contrast, narrow windows, lost connections and graphics cards.
// Run by page_test.mjs.
import assert from 'node:assert/strict';
import { test } from 'node:test';

import {
  browser, expectSum, isPaused, mock, mockAddress, openPanel, page, screenshots, shot, sleep,
  startMock, state, stopMock,
} from './live_page.mjs';

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

test('panels that are hidden in a wide window are there in a narrow one', async () => {
  await page.press('h', 'KeyH');
  const isShown = () => page.evaluate(() =>
    getComputedStyle(document.querySelector('#panels')).display !== 'none');
  assert.equal(await isShown(), false);
  await page.resize(360, 740);
  assert.equal(await isShown(), true);
  await page.resize(1280, 800);
  await page.press('h', 'KeyH');
  assert.equal(await isShown(), true);
});

test('Caps Lock and R do not throw the picture away', async () => {
  const { generation } = await state();
  await page.press('R', 'KeyR');
  await sleep(500);
  assert.equal((await state()).generation, generation);
});

test('a page that nobody sees gives its connection back', async () => {
  const see = (seen) => page.evaluate((value) => {
    Object.defineProperty(document, 'hidden', { value: !value, configurable: true });
    document.dispatchEvent(new Event('visibilitychange'));
  }, seen);
  await page.evaluate(() => fetch('api/render', { method: 'POST',
    headers: { 'Content-Type': 'application/json' }, body: '{"action":"restart"}' }));
  await see(false);
  await sleep(300);
  const { version } = await state();
  const newest = () => page.evaluate(async () => (await (await fetch('api/state')).json()).version);
  const end = Date.now() + 20000;
  while (await newest() <= version && Date.now() < end) await sleep(200);
  assert.ok(await newest() > version, 'the render goes on');
  assert.equal((await state()).version, version);
  await see(true);
  await page.waitFor((old) => window.nephroid.state.version > old, [version]);
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

// Makes a page believe that no picture came, because its scene is wrong.
const believeFailure = () => {
  const failed = { status: 'failed', version: 0, width: 0, height: 0, layers: [],
    message: `/a/long/way/${'of/folders/'.repeat(12)}bad.pbrt:4:7: the string has no closing ` +
      'quote on its line' };
  window.EventSource = class extends window.EventSource {
    addEventListener(name, listener) {
      super.addEventListener(name, ({ data }) => {
        const { settings, ...state } = JSON.parse(data);
        listener({ data: JSON.stringify({ ...state, ...failed,
          settings: { ...settings, resolution: [0, 0] } }) });
      });
    }
  };
};

test('why a scene cannot be read is told whole, and nothing else is offered', async () => {
  const other = await browser.open(1280, 800);
  await other.runFirst(believeFailure);
  await other.goto(new URL('/', await page.evaluate(() => location.href)).href);
  await other.waitFor(() => window.nephroid?.state?.status === 'failed' &&
    !document.querySelector('#failure').hidden);
  if (screenshots) await other.screenshot(screenshots('failure'));
  const [message, shown, told, cut, controls, zoom] = await other.evaluate(() => {
    const box = document.querySelector('#failure');
    const seen = [...document.querySelectorAll('#panels, [data-tool], #zoom-fit, #zoom-value')]
      .filter((one) => one.getBoundingClientRect().width > 0).map((one) => one.id || one.outerHTML);
    return [window.nephroid.state.message, box.getBoundingClientRect().width > 300,
      document.querySelector('#failure-text').textContent, box.scrollWidth > box.clientWidth, seen,
      document.querySelector('#zoom-value').textContent];
  });
  assert.equal(told, message);
  assert.ok(shown && !cut);
  assert.deepEqual(controls, []);
  assert.equal(zoom, '');
  await other.close();
});

test('who asks for lamps sees the lamps', async () => {
  const { layers } = (await state()).settings;
  const other = await browser.open(1280, 800);
  await other.goto(new URL('/', await page.evaluate(() => location.href)).href);
  await other.waitFor(() => window.nephroid?.frameVersion > 0 &&
    window.nephroid.state.layers.some(({ kind }) => kind === 'light'));
  assert.equal(layers, 'lights');
  assert.equal(await other.evaluate(() =>
    document.querySelector('#layers-panel [aria-pressed="true"]').dataset.kind), 'light');
  await other.close();
});

test('a file of the command line is compared at once', async () => {
  // A file needs the first whole pass, and a test before has paused a render that had just begun.
  await page.evaluate(() => {
    if (window.nephroid.state.status === 'paused') document.querySelector('#pause-icon').click();
  });
  await page.waitFor(() => window.nephroid.state.progress.passes > 0);
  const key = await page.evaluate(async () => {
    const picture = await (await fetch('api/save?kind=exr')).blob();
    return (await (await fetch('api/upload?name=other.exr', { method: 'POST', body: picture,
      headers: { 'Content-Type': 'application/octet-stream' } })).json()).id;
  });
  const other = await browser.open(1280, 800);
  await other.goto(new URL('/', await page.evaluate(() => location.href)).href);
  await other.waitFor(() => !document.querySelector('#split')?.hidden &&
    /FLIP/.test(document.querySelector('#compare-figures')?.textContent));
  if (screenshots) await other.screenshot(screenshots('compare-at-once'));
  assert.equal(await other.evaluate(() => document.querySelector('#tag-left').textContent),
    'other.exr');
  assert.ok(await other.evaluate(() => {
    const { top, bottom } = document.querySelector('#compare-panel').getBoundingClientRect();
    return document.querySelector('#compare-panel').open && top >= 0 && bottom <= innerHeight;
  }));
  assert.deepEqual(other.problems, []);
  await other.close();
  await page.evaluate((id) => fetch(`api/snapshot?id=${id}`, { method: 'DELETE' }), key);
});

test('nothing was complained of', () => {
  assert.deepEqual(page.problems, []);
});

const statusText = () => page.evaluate(() =>
  document.querySelector('#status-text').textContent);

test('a lost connection is told and found again', async (t) => {
  if (!mock) return t.skip('only with the mock server');
  const { port, searchParams } = new URL(mockAddress);
  await stopMock();
  await page.waitFor(() => /has ended/.test(document.querySelector('#notice').textContent));
  assert.match(await statusText(), /^The program has ended/);
  await shot('lost');
  await startMock(port, searchParams.get('token'));
  await page.waitFor(() => document.querySelector('#notice').hidden);
  await page.waitFor(() => window.nephroid.frame?.generation === window.nephroid.state.generation);
  assert.match(await statusText(), /^(Rendering|Done)/);
});

test('a program started again wants its new address', async (t) => {
  if (!mock) return t.skip('only with the mock server');
  await stopMock();
  await startMock(new URL(mockAddress).port, 'another');
  await page.waitFor(() => /started again/.test(document.querySelector('#notice').textContent));
  await shot('refused');
});
