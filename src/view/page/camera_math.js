// Moves of a camera pose {eye, target, up}: orbit, pan, dolly, look, fly. All return a new pose.
// It must not know of the page or of the server.

const kMaxElevation = (89.5 * Math.PI) / 180;

export function add(a, b, scale = 1) {
  return [a[0] + scale * b[0], a[1] + scale * b[1], a[2] + scale * b[2]];
}

export function subtract(a, b) {
  return add(a, b, -1);
}

export function dot(a, b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

export function cross(a, b) {
  return [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
}

export function normalize(a) {
  const length = Math.hypot(...a);
  return length > 0 ? a.map((value) => value / length) : a;
}

export function distance(pose) {
  return Math.hypot(...subtract(pose.target, pose.eye));
}

/// Directions of the picture in the scene: {right, up, forward}. LookAt of pbrt is left-handed; a
/// mirrored camera has its right where the other one has its left.
export function axes(pose, mirrored) {
  const forward = normalize(subtract(pose.target, pose.eye));
  const right = normalize(cross(pose.up, forward)).map((value) => (mirrored ? -value : value));
  const across = cross(forward, right);
  return { right, up: mirrored ? across.map((value) => -value) : across, forward };
}

/// Moves the eye around the target by angles to the right and upwards.
export function orbit(pose, toRight, upwards, mirrored) {
  const offset = subtract(pose.eye, pose.target);
  return { ...pose, eye: add(pose.target, turned(offset, pose, toRight, upwards, mirrored)) };
}

/// Turns the view about the eye by angles to the right and upwards.
export function look(pose, toRight, upwards, mirrored) {
  const offset = subtract(pose.target, pose.eye);
  return { ...pose, target: add(pose.eye, turned(offset, pose, toRight, upwards, mirrored)) };
}

/// Moves eye and target by distances along the picture's axes.
export function shift(pose, right, up, forward, mirrored) {
  const to = axes(pose, mirrored);
  const step = add(add(to.right.map((v) => v * right), to.up, up), to.forward, forward);
  return { ...pose, eye: add(pose.eye, step), target: add(pose.target, step) };
}

/// Multiplies the distance to the target.
export function dolly(pose, factor) {
  const offset = subtract(pose.eye, pose.target);
  return { ...pose, eye: add(pose.target, offset, factor) };
}

/// Puts the target at that distance along the view, so that the next orbit turns about it.
export function retarget(pose, depth) {
  return { ...pose, target: add(pose.eye, axes(pose, false).forward, depth) };
}

// The offset turned: towards the picture's right about the up direction, and in its elevation.
function turned(offset, pose, toRight, upwards, mirrored) {
  const length = Math.hypot(...offset);
  const up = normalize(pose.up);
  const height = dot(offset, up) / length;
  const level = normalize(add(offset, up, -dot(offset, up)));
  const right = axes(pose, mirrored).right;
  const heading = add(level.map((v) => v * Math.cos(toRight)), right, Math.sin(toRight));
  const elevation = Math.min(kMaxElevation,
    Math.max(-kMaxElevation, Math.asin(Math.min(1, Math.max(-1, height))) + upwards));
  return add(heading.map((v) => v * length * Math.cos(elevation)), up,
    length * Math.sin(elevation));
}
