// A scene that cannot be read: node tests/view/failed_reading_test.mjs NEPHROID [--screenshots
// DIRECTORY]. A missing file ends the program, one with a mistake is waited for.
import assert from 'node:assert/strict';
import { spawnSync } from 'node:child_process';
import { mkdirSync, mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';

import { Chromium } from './chromium.mjs';
import { startView } from './program.mjs';

const [program, , screenshots] = process.argv.slice(2);
const kScene = 'Film "rgb" "integer xresolution" 64 "integer yresolution" 48\n' +
  'LookAt 0 0 -4  0 0 0  0 1 0\nCamera "perspective"\nWorldBegin\nLightSource "infinite"\n' +
  'Shape "sphere"\n';
const kLongest = { encoding: 'utf8', timeout: 20000 };

let folder;

before(() => {
  if (screenshots) mkdirSync(screenshots, { recursive: true });
  folder = mkdtempSync(join(tmpdir(), 'nephroid-view-'));
});

after(() => rmSync(folder, { recursive: true }));

function endOf(command, ...parameters) {
  const { status, stderr } = spawnSync(program, [command, ...parameters], kLongest);
  return { status, stderr };
}

test('a missing file, and one that is no scene, end it as they end a render', () => {
  const picture = join(folder, 'picture.png');
  writeFileSync(picture, '\x89PNG\r\n\x1a\n', 'latin1');
  for (const file of [join(folder, 'nix.obj'), picture]) {
    const ended = endOf('view', file, '--no-browser');
    assert.deepEqual(ended, endOf('render', file, '-o', join(folder, 'out.exr')));
    assert.notEqual(ended.status, 0);
  }
});

test('a file that is no picture in spite of its name ends it', () => {
  const text = join(folder, 'text.exr');
  writeFileSync(text, 'hello\n');
  const { status, stderr } = endOf('view', text, '--no-browser');
  assert.equal(status, 4);
  assert.match(stderr, /text\.exr" is not an OpenEXR file/);
});

test('a scene with a mistake is waited for until it is mended', async () => {
  const file = join(folder, 'scene.pbrt');
  writeFileSync(file, kScene.replace('"sphere"', '"sphere'));
  const { stderr } = endOf('render', file, '-o', join(folder, 'out.exr'));
  const view = await startView(program, file);
  const browser = new Chromium();
  try {
    assert.ok(view.said().startsWith(stderr), view.said());
    const page = await browser.open(1280, 800);
    await page.goto(view.address);
    await page.waitFor(() => window.nephroid?.state?.status === 'failed');
    if (screenshots) await page.screenshot(join(screenshots, 'failed.png'));
    const told = await page.evaluate(() => document.querySelector('#failure').innerText);
    assert.match(told, /scene\.pbrt:6:7: the string has no closing quote/);
    writeFileSync(file, kScene);
    await page.waitFor(() => window.nephroid.frameVersion > 0 &&
      document.querySelector('#failure').hidden);
    if (screenshots) await page.screenshot(join(screenshots, 'mended.png'));
    assert.deepEqual(page.problems, []);
  } finally {
    await browser.close();
    assert.equal(await view.stop(), 0);
  }
});
