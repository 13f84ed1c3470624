// Takes a picture of the page for docs/view.md.
//   node tests/view/docs_picture.mjs ADDRESS FILE.png SECONDS [lights | inspect X Y]
// It is taken after so many seconds of rendering, with the layers of lamps or an inspected pixel, given from 0 to 1.
import { Chromium } from './chromium.mjs';

const [address, file, seconds, what, x, y] = process.argv.slice(2);
const sleep = (milliseconds) => new Promise((resolve) => { setTimeout(resolve, milliseconds); });

const browser = new Chromium();
const page = await browser.open(1280, 800);
await page.goto(address);
await page.waitFor(() => window.nephroid?.frame);
await sleep(1000 * Number(seconds));
const open = (ids) => page.evaluate((wanted) => {
  for (const panel of document.querySelectorAll('details.panel')) panel.open = wanted.includes(panel.id);
}, ids);
if (what === 'lights') {
  await open(['layers-panel', 'render-panel']);
  await page.evaluate(() => {
    for (const button of document.querySelectorAll('#layers-panel button')) {
      if (button.textContent.trim() === 'Lights') button.click();
    }
    // A little of what the sliders are for.
    window.nephroid.setGain('strip', 2);
    window.nephroid.setGain('card', 0.5);
  });
  await page.evaluate(() => window.nephroid.settled());
} else if (what === 'inspect') {
  await open(['inspector-panel']);
  const box = await page.evaluate(() => {
    const { left, top, width, height } = document.querySelector('#stage').getBoundingClientRect();
    return [left, top, width, height];
  });
  await page.clickAt(box[0] + Number(x) * box[2], box[1] + Number(y) * box[3]);
  await page.waitFor(() => document.querySelector('#inspection .paths button'));
} else {
  await open(['display-panel', 'layers-panel']);
}
await sleep(1500);
await page.screenshot(file);
await browser.close();
