// The camera as the user moves it: a pose ahead of the program's, its history, and flying.
// It must not know of the page's elements.

import * as math from './camera_math.js';

const kRadiansPerPixel = 0.006;
const kFlyDistancesPerSecond = 0.6;
const kMaxHistory = 200;
const kSameMoveMs = 600; // moves closer together are undone as one

/// Event "change" whenever the pose changes.
export class CameraControls extends EventTarget {
  #sender;
  #pose = null;
  #mirrored = false;
  #canMove = false;
  #undo = [];
  #redo = [];
  #lastMove = 0;
  #known = ''; // the program's camera, as it was last taken over
  #flying = null; // {right, up, forward} of the pressed keys

  constructor(sender) {
    super();
    this.#sender = sender;
  }

  get pose() { return this.#pose; }
  get canMove() { return this.#canMove; }
  get canUndo() { return this.#undo.length > 0; }
  get canRedo() { return this.#redo.length > 0; }

  /// Takes over the program's pose, unless the user is ahead of it.
  setState(state) {
    this.#canMove = Boolean(state.camera?.can_move);
    if (!state.camera || this.#sender.pending || state.generation < this.#sender.generation) return;
    const known = JSON.stringify(state.camera);
    if (known === this.#known) return;
    this.#known = known;
    const { type, can_move: _, mirrored, ...pose } = state.camera;
    this.#mirrored = Boolean(mirrored);
    this.#pose = Object.fromEntries(Object.entries(pose).filter(([, value]) => value !== null));
    this.#changed();
  }

  /// Takes over the next state whatever it counts: the program may be another one.
  forget() {
    this.#known = '';
    this.#sender.generation = 0;
  }

  orbit(dx, dy) {
    this.#move((pose) =>
      math.orbit(pose, -dx * kRadiansPerPixel, dy * kRadiansPerPixel, this.#mirrored));
  }

  look(dx, dy) {
    this.#move((pose) =>
      math.look(pose, dx * kRadiansPerPixel, -dy * kRadiansPerPixel, this.#mirrored));
  }

  /// Moves the scene with the pointer. shortSide: CSS pixels of the picture's shorter side.
  pan(dx, dy, shortSide) {
    this.#move((pose) => {
      const angle = ((pose.fov ?? 45) * Math.PI) / 360;
      const unit = (2 * math.distance(pose) * Math.tan(angle)) / shortSide;
      return math.shift(pose, -dx * unit, dy * unit, 0, this.#mirrored);
    });
  }

  dolly(factor) {
    this.#move((pose) => math.dolly(pose, factor));
  }

  /// Changes fov, lens_radius, focal_distance or shutter; moving while a slider is held.
  setLens(values, moving = false) {
    this.#move((pose) => ({ ...pose, ...values }), moving);
  }

  /// The next orbit turns about the point at this distance along the view. Moves nothing.
  setOrbitDepth(depth) {
    if (!this.#pose) return;
    this.#pose = math.retarget(this.#pose, depth);
    this.#changed();
  }

  undo() {
    this.#travel(this.#undo, this.#redo);
  }

  redo() {
    this.#travel(this.#redo, this.#undo);
  }

  /// Flies as long as a direction is given: numbers from -1 to 1 along the picture's axes.
  fly(right, up, forward) {
    const was = this.#flying;
    this.#flying = right || up || forward ? { right, up, forward } : null;
    if (this.#flying && !was) this.#flyOn(performance.now());
  }

  #flyOn(before) {
    requestAnimationFrame((now) => {
      if (!this.#flying || !this.#pose) return;
      const step = (Math.min(100, now - before) / 1000) * kFlyDistancesPerSecond *
        math.distance(this.#pose);
      const { right, up, forward } = this.#flying;
      this.#move((pose) =>
        math.shift(pose, right * step, up * step, forward * step, this.#mirrored));
      this.#flyOn(now);
    });
  }

  #move(change, moving = true) {
    if (!this.#pose || !this.#canMove) return;
    const now = performance.now();
    if (now - this.#lastMove > kSameMoveMs) {
      this.#undo.push(this.#pose);
      if (this.#undo.length > kMaxHistory) this.#undo.shift();
      this.#redo = [];
    }
    this.#lastMove = now;
    this.#pose = change(this.#pose);
    if (moving) this.#sender.move(this.#pose);
    else this.#sender.settle(this.#pose);
    this.#changed();
  }

  #travel(from, to) {
    if (from.length === 0) return;
    to.push(this.#pose);
    this.#pose = from.pop();
    this.#lastMove = 0;
    this.#sender.settle(this.#pose);
    this.#changed();
  }

  #changed() {
    this.dispatchEvent(new Event('change'));
  }
}
