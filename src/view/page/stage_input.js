// Pointer and wheel on the picture: which tool a drag or a click means. Tools are "camera",
// "picture", "focus" and "crop". It must not know what the tools do; it calls handlers.

const kClickPixels = 4;
const kClickMs = 600; // a longer press is no click
const kDoubleClickMs = 350; // the second click of two is none of its own
const kWheelStep = 0.0015;

/// Handlers: orbit, pan, look, movePicture (dx, dy); dolly, zoom (factor, x, y); hover, click,
/// pickOrbit (x, y); leave (); crop ({x0, y0, x1, y1}, done). Places are CSS pixels of the stage.
export class StageInput {
  tool = 'camera';
  flying = false;
  canMove = false;
  #stage;
  #handlers;
  #pointers = new Map();
  #start = null;
  #moved = false;
  #lastClick = -Infinity;
  #action = '';

  constructor(stage, handlers) {
    this.#stage = stage;
    this.#handlers = handlers;
    stage.addEventListener('pointerdown', (event) => this.#down(event));
    stage.addEventListener('pointermove', (event) => this.#move(event));
    stage.addEventListener('pointerup', (event) => this.#up(event));
    stage.addEventListener('pointercancel', (event) => this.#forget(event));
    stage.addEventListener('pointerleave', (event) => {
      if (event.pointerType === 'mouse') handlers.leave(); // after each touch, too
    });
    stage.addEventListener('wheel', (event) => this.#wheel(event), { passive: false });
    stage.addEventListener('contextmenu', (event) => event.preventDefault());
    stage.addEventListener('dblclick', (event) => {
      if (this.tool === 'camera' && this.canMove) handlers.pickOrbit(...this.#place(event));
    });
  }

  #place(event) {
    const box = this.#stage.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  }

  #down(event) {
    if (event.target.id === 'split') return;
    this.#stage.setPointerCapture(event.pointerId);
    this.#pointers.set(event.pointerId, this.#place(event));
    if (this.#pointers.size > 1) {
      this.#action = 'pinch';
      this.#moved = true;
      return;
    }
    this.#start = { place: this.#place(event), time: performance.now(), button: event.button };
    this.#moved = false;
    this.#action = this.#actionOf(event);
  }

  #actionOf(event) {
    if (this.tool === 'crop' && event.button === 0) return 'crop';
    if (this.tool === 'picture' || !this.canMove) return 'movePicture';
    if (this.flying) return 'look';
    return event.button !== 0 || event.shiftKey ? 'pan' : 'orbit';
  }

  #move(event) {
    const place = this.#place(event);
    const before = this.#pointers.get(event.pointerId);
    if (!before) {
      if (event.pointerType === 'mouse') this.#handlers.hover(...place);
      return;
    }
    if (this.#action === 'pinch') this.#pinch(event.pointerId, place);
    else this.#drag(before, place);
    if (this.#moved) this.#pointers.set(event.pointerId, place);
  }

  #drag(before, place) {
    const { place: start } = this.#start;
    if (Math.hypot(place[0] - start[0], place[1] - start[1]) > kClickPixels) this.#moved = true;
    if (!this.#moved) return;
    this.#stage.classList.add('dragging');
    if (this.#action === 'crop') this.#handlers.crop(rectangle(start, place), false);
    else this.#handlers[this.#action](place[0] - before[0], place[1] - before[1]);
  }

  // Two fingers: their distance dollies or zooms, their middle pans.
  #pinch(id, place) {
    const others = [...this.#pointers].filter(([key]) => key !== id);
    if (others.length === 0) return; // the other finger has gone
    const before = this.#pointers.get(id);
    const [, fixed] = others[0];
    const ratio = Math.hypot(place[0] - fixed[0], place[1] - fixed[1]) /
      Math.max(1, Math.hypot(before[0] - fixed[0], before[1] - fixed[1]));
    const middle = [(place[0] + fixed[0]) / 2, (place[1] + fixed[1]) / 2];
    const [dx, dy] = [(place[0] - before[0]) / 2, (place[1] - before[1]) / 2];
    if (this.tool === 'camera' && this.canMove) {
      this.#handlers.dolly(1 / ratio);
      this.#handlers.pan(dx, dy);
    } else {
      this.#handlers.zoom(ratio, ...middle);
      this.#handlers.movePicture(dx, dy);
    }
  }

  #up(event) {
    const known = this.#pointers.has(event.pointerId);
    const place = this.#place(event);
    const action = this.#action;
    this.#forget(event);
    if (!known || action === 'pinch') return;
    if (action === 'crop' && this.#moved) {
      this.#handlers.crop(rectangle(this.#start.place, place), true);
      return;
    }
    if (this.#moved || this.#start.button !== 0) return;
    const now = performance.now();
    const single = now - this.#start.time < kClickMs && now - this.#lastClick > kDoubleClickMs;
    this.#lastClick = now;
    if (single) this.#handlers.click(...place);
  }

  #forget(event) {
    this.#pointers.delete(event.pointerId);
    if (this.#pointers.size === 0) this.#stage.classList.remove('dragging');
  }

  #wheel(event) {
    event.preventDefault();
    const lines = event.deltaMode === WheelEvent.DOM_DELTA_LINE ? 20 : 1;
    const amount = Math.max(-300, Math.min(300, event.deltaY * lines)) * kWheelStep;
    const onPicture = this.tool !== 'camera' || !this.canMove || event.ctrlKey || event.metaKey;
    if (onPicture) this.#handlers.zoom(Math.exp(-amount), ...this.#place(event));
    else this.#handlers.dolly(Math.exp(amount));
  }
}

function rectangle(a, b) {
  return {
    x0: Math.min(a[0], b[0]), y0: Math.min(a[1], b[1]),
    x1: Math.max(a[0], b[0]), y1: Math.max(a[1], b[1]),
  };
}
