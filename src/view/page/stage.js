// The picture on the screen: owns the renderer, draws when something changed, and survives the loss
// of the graphics card. It must not know of the server.

import { Renderer } from './renderer.js';

/// Event "drawn" after each drawing, "restored" when all pictures have to be fetched again,
/// "lost" when the graphics card went away.
export class Stage extends EventTarget {
  renderer;
  #canvas;
  #view;
  #display;
  #mix;
  #compare = () => ({ mode: 'none', split: 0 });
  #requested = false;

  /// Throws if the browser cannot show pictures.
  constructor(canvas, view, display, mix) {
    super();
    this.#canvas = canvas;
    this.#view = view;
    this.#display = display;
    this.#mix = mix;
    this.renderer = new Renderer(canvas);
    for (const source of [view, display, mix]) {
      source.addEventListener('change', () => this.requestDraw());
    }
    canvas.addEventListener('webglcontextlost', (event) => {
      event.preventDefault();
      this.dispatchEvent(new Event('lost'));
    });
    canvas.addEventListener('webglcontextrestored', () => {
      this.renderer = new Renderer(canvas);
      this.dispatchEvent(new Event('restored'));
    });
    new ResizeObserver(() => this.#resize()).observe(canvas);
    this.#resize();
    this.renderer.warmUp(view, display.look());
  }

  /// compare: () => what ComparePanel wants drawn.
  setCompare(compare) {
    this.#compare = compare;
  }

  setFrame(frame) {
    this.renderer.setFrame('current', frame);
    this.#draw();
  }

  requestDraw() {
    if (this.#requested) return;
    this.#requested = true;
    requestAnimationFrame(() => {
      this.#requested = false;
      this.#draw();
    });
  }

  /// Name of the first layer of the picture on the screen.
  get shownLayer() { return this.renderer.header('current')?.layers[0].name; }

  /// Whether the picture on the screen is a coarse one of a moving camera.
  get isPreview() { return Boolean(this.renderer.header('current')?.preview); }

  /// Of the picture on the screen; it changes when a render begins anew.
  get generation() { return this.renderer.header('current')?.generation; }

  /// Linear value that is shown at a pixel of the full picture, or null.
  readPixel(x, y) {
    const header = this.renderer.header('current');
    if (!header) return null;
    this.#sum();
    const [width, height] = this.#view.pictureSize;
    return this.renderer.readPixel((x * header.width) / width, (y * header.height) / height);
  }

  #draw() {
    if (this.renderer.contextLost) return;
    this.#sum();
    this.renderer.draw(this.#view, this.#display.look(this.shownLayer), this.#compare());
    this.dispatchEvent(new Event('drawn'));
  }

  #sum() {
    this.renderer.sum('current', (name) => this.#mix.weight(name));
  }

  #resize() {
    const ratio = window.devicePixelRatio;
    const width = Math.max(1, Math.round(this.#canvas.clientWidth * ratio));
    const height = Math.max(1, Math.round(this.#canvas.clientHeight * ratio));
    if (this.#canvas.width !== width || this.#canvas.height !== height) {
      [this.#canvas.width, this.#canvas.height] = [width, height];
    }
    this.#view.setViewport(width, height, ratio);
    if (!this.renderer.contextLost) this.#draw();
  }
}
