// Where a path leaves the picture: the program gives the pixels of its vertices, but none for those
// behind the camera. This finds the direction in which the line goes there.

import { add, axes, dot, subtract } from './camera_math.js';

const kNearest = 1e-3; // depth at which a line is cut, as a part of the depth of its other end

/// The pixels of a path's vertices, with those behind the camera replaced by points on the way.
/// path: {points, pixels}; pose: of the camera; size: [width, height] of the picture.
export function drawablePixels(path, pose, size) {
  const { points, pixels } = path;
  if (!points || pose?.fov === undefined) return pixels;
  return pixels.map((pixel, index) => {
    if (pixel || index === 0 || !pixels[index - 1]) return pixel;
    return cut(points[index - 1], pixels[index - 1], points[index], pose, size);
  });
}

// The pixel of the last point before the line from `a` to `b` goes behind the camera.
function cut(a, pixelOfA, b, pose, size) {
  const to = axes(pose, false);
  const depth = (point) => dot(subtract(point, pose.eye), to.forward);
  const depthA = depth(a);
  const depthB = depth(b);
  if (!(depthA > 0) || depthB >= depthA) return null;
  const part = (depthA * (1 - kNearest)) / (depthA - depthB);
  const [x, y] = project(add(a, subtract(b, a), part), pose, to, size);
  const [xOfA] = project(a, pose, to, size);
  // A mirrored camera has x the other way round; the known pixel tells.
  const mirrored = Math.abs(size[0] - xOfA - pixelOfA[0]) < Math.abs(xOfA - pixelOfA[0]);
  return [mirrored ? size[0] - x : x, y];
}

function project(point, pose, to, [width, height]) {
  const offset = subtract(point, pose.eye);
  const scale = Math.min(width, height) /
    (2 * Math.tan((pose.fov * Math.PI) / 360) * dot(offset, to.forward));
  return [width / 2 + dot(offset, to.right) * scale, height / 2 - dot(offset, to.up) * scale];
}
