// Histogram of the shown picture in stops, and the shares that clip. Draws on a small canvas.

import { balanced } from './white_point.js';
import { formatShare } from './format.js';

const kFirstStop = -10; // relative to what the sRGB curve shows as white
const kLastStop = 4;
const kBins = 140;
const kColors = ['#e0564a', '#5fb85f', '#5b8fe8'];

/// Counts values of a grid (four numbers a pixel): {bins: [r, g, b], over, under, outside, broken}.
export function countValues(grid, exposure, balance) {
  const bins = [0, 1, 2].map(() => new Uint32Array(kBins));
  let over = 0;
  let under = 0;
  let outside = 0; // of the gamut of sRGB
  let broken = 0; // not finite
  for (let at = 0; at < grid.length; at += 4) {
    const rgb = balanced(balance, grid[at], grid[at + 1], grid[at + 2]).map((v) => v * exposure);
    if (!rgb.every(Number.isFinite)) {
      ++broken;
      continue;
    }
    const [low, high] = [Math.min(...rgb), Math.max(...rgb)];
    if (high > 1) ++over;
    if (high <= 0.0003) ++under;
    if (low < -1e-4) ++outside;
    rgb.forEach((value, channel) => {
      if (value > 0) ++bins[channel][binOf(value)];
    });
  }
  const pixels = Math.max(1, grid.length / 4);
  return { bins, over: over / pixels, under: under / pixels, outside: outside / pixels,
    broken: broken / pixels };
}

/// Smallest and largest size above 0 of a layer with one channel, without the outermost percent.
export function rangeOf(grid) {
  const values = grid.filter((value, at) => at % 4 === 0 && Number.isFinite(value))
    .map(Math.abs).filter((size) => size > 0).sort();
  if (values.length === 0) return [0, 1];
  const low = values[Math.floor(0.01 * values.length)];
  const high = values[Math.floor(0.99 * values.length)];
  return low < high ? [low, high] : [0, high];
}

/// One line on what clips.
export function clippingText({ over, under, outside, broken }) {
  const parts = [[over, 'white'], [under, 'black'], [outside, 'out of gamut'],
    [broken, 'not finite']].filter(([share]) => share > 0);
  if (parts.length === 0) return 'Nothing clips.';
  return parts.map(([share, text]) => `${formatShare(share)} ${text}`).join(' · ');
}

export function drawHistogram(canvas, { bins }) {
  const ratio = window.devicePixelRatio;
  const width = Math.max(1, Math.round(canvas.clientWidth * ratio));
  const height = Math.max(1, Math.round(canvas.clientHeight * ratio));
  if (canvas.width !== width || canvas.height !== height) {
    [canvas.width, canvas.height] = [width, height];
  }
  const context = canvas.getContext('2d');
  context.clearRect(0, 0, width, height);
  drawStops(context, width, height);
  // The bins at both ends collect what lies beyond, so they do not set the height.
  const peak = Math.max(1, ...bins.flatMap((channel) => [...channel.subarray(1, kBins - 1)]));
  context.globalCompositeOperation = 'lighter';
  bins.forEach((channel, index) => {
    context.fillStyle = kColors[index];
    context.beginPath();
    context.moveTo(0, height);
    channel.forEach((count, bin) => {
      const y = height * (1 - 0.94 * Math.min(1, Math.sqrt(count / peak)));
      context.lineTo((bin / kBins) * width, y);
      context.lineTo(((bin + 1) / kBins) * width, y);
    });
    context.lineTo(width, height);
    context.globalAlpha = 0.6;
    context.fill();
  });
  context.globalCompositeOperation = 'source-over';
  context.globalAlpha = 1;
}

function drawStops(context, width, height) {
  for (let stop = kFirstStop + 2; stop < kLastStop; stop += 2) {
    const x = Math.round(((stop - kFirstStop) / (kLastStop - kFirstStop)) * width);
    context.fillStyle = stop === 0 ? '#a0a0a0' : '#2e2e2e';
    context.fillRect(x, 0, 1, height);
  }
}

function binOf(value) {
  const part = (Math.log2(value) - kFirstStop) / (kLastStop - kFirstStop);
  return Math.min(kBins - 1, Math.max(0, Math.floor(part * kBins)));
}
