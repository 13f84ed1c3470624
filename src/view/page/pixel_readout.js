// The value below the pointer: at once from the picture on the screen, error and samples from the
// program as fast as it answers.

const kProbeMs = 120;

export class PixelReadout {
  #server;
  #stage;
  #status;
  #pixel = null;
  #busy = false;

  constructor(server, stage, status) {
    this.#server = server;
    this.#stage = stage;
    this.#status = status;
  }

  show([x, y]) {
    const pixel = { x: Math.floor(x), y: Math.floor(y) };
    if (this.#pixel?.x === pixel.x && this.#pixel?.y === pixel.y) return;
    this.#pixel = pixel;
    const value = this.#stage.readPixel(pixel.x, pixel.y);
    if (!value) {
      this.clear();
      return;
    }
    this.#status.showPixel({ ...pixel, value });
    this.#probe();
  }

  clear() {
    this.#pixel = null;
    this.#status.showPixel(null);
  }

  async #probe() {
    if (this.#busy) return;
    this.#busy = true;
    const pixel = this.#pixel;
    try {
      const { error, samples } = await this.#server.get(`api/probe?x=${pixel.x}&y=${pixel.y}`);
      const value = this.#stage.readPixel(pixel.x, pixel.y);
      if (pixel === this.#pixel && value) {
        this.#status.showPixel({ ...pixel, value, error, samples });
      }
    } catch {
      // The value of the picture is shown already; a program without an answer is told elsewhere.
    }
    await new Promise((resolve) => { setTimeout(resolve, kProbeMs); });
    this.#busy = false;
    if (this.#pixel && this.#pixel !== pixel) this.#probe();
  }
}
