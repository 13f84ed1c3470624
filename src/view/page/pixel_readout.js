// The value below the pointer: at once from the picture on the screen, error and samples from the
// program as fast as it answers.

const kProbeMs = 120;
const kAgainMs = 1000;

export class PixelReadout {
  #server;
  #stage;
  #status;
  #pixel = null;
  #probed = {}; // error and samples of the pixel, as soon as they are known
  #busy = false;
  #again = 0; // time from which on the same pixel is asked about again

  constructor(server, stage, status) {
    this.#server = server;
    this.#stage = stage;
    this.#status = status;
  }

  show([x, y]) {
    const pixel = { x: Math.floor(x), y: Math.floor(y) };
    if (this.#pixel?.x === pixel.x && this.#pixel?.y === pixel.y) return;
    this.#pixel = pixel;
    this.#probed = {};
    if (this.#print()) this.#probe();
    else this.clear();
  }

  /// The picture below the pointer is another one. Coarse ones have no errors worth a question.
  refresh() {
    if (!this.#pixel) return;
    if (!this.#print()) this.clear();
    else if (!this.#stage.isPreview && performance.now() > this.#again) this.#probe();
  }

  clear() {
    this.#pixel = null;
    this.#status.showPixel(null);
  }

  // False outside of the picture.
  #print() {
    const { x, y } = this.#pixel;
    const value = this.#stage.readPixel(x, y);
    if (!value) return false;
    // Error and samples of another render say nothing of this one.
    const isOld = this.#probed.generation !== this.#stage.generation;
    const { error, samples } = isOld ? {} : this.#probed;
    // The program knows the error of the picture, not that of a mix or of a view.
    const known = this.#stage.shownLayer === 'picture' ? error : null;
    this.#status.showPixel({ x, y, value, error: known, samples });
    return true;
  }

  async #probe() {
    if (this.#busy) return;
    this.#busy = true;
    const pixel = this.#pixel;
    const { generation } = this.#stage;
    try {
      const probed = await this.#server.get(`api/probe?x=${pixel.x}&y=${pixel.y}`);
      if (pixel === this.#pixel) {
        this.#probed = { ...probed, generation };
        this.#print();
      }
    } catch {
      // The value of the picture is shown already; a program without an answer is told elsewhere.
    }
    this.#again = performance.now() + kAgainMs;
    await new Promise((resolve) => { setTimeout(resolve, kProbeMs); });
    this.#busy = false;
    if (this.#pixel && this.#pixel !== pixel) this.#probe();
  }
}
