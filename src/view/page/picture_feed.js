// Gets the pictures that the page wants to show: one request at a time, only what changed.
// It must not know of the page; frames go to a receiver.

/// Event "frame" after each frame, "problem" (detail: text) if one cannot be had.
export class PictureFeed extends EventTarget {
  #server;
  #wanted; // () => names of layers
  #receive; // (frame) => void, may throw
  #state = null;
  #shown = null; // header of the last frame
  #layers = ''; // what it was asked for
  #asked = ''; // the last request, so that none is made twice
  #busy = false;
  #again = false;
  #resets = 0; // a frame that was asked for before a reset lacks tiles

  constructor(server, wanted, receive) {
    super();
    this.#server = server;
    this.#wanted = wanted;
    this.#receive = receive;
  }

  /// Header of the picture on the screen, or null.
  get shown() { return this.#shown; }

  /// Whether the picture on the screen has the layers that are wanted now.
  get upToDate() {
    return this.#shown !== null && this.#layers === this.#wanted().join(',');
  }

  setState(state) {
    this.#state = state;
    this.update();
  }

  /// Forgets what is on the screen, for example after the graphics card did.
  reset() {
    this.#shown = null;
    this.#asked = '';
    ++this.#resets;
    this.update();
  }

  /// Fetches if the program has something else than what is shown.
  async update() {
    if (this.#busy) {
      this.#again = true;
      return;
    }
    this.#busy = true;
    do {
      this.#again = false;
      await this.#fetchOnce();
    } while (this.#again);
    this.#busy = false;
  }

  async #fetchOnce() {
    if (!this.#state || !this.#state.version) return;
    const layers = this.#wanted().join(',');
    const since = this.#shown && layers === this.#layers ? this.#shown.version : 0;
    const asked = [this.#state.generation, this.#state.version, layers].join('/');
    if (layers === '' || asked === this.#asked) return;
    this.#asked = asked;
    const resets = this.#resets;
    const generation = this.#shown?.generation ?? this.#state.generation;
    try {
      const frame = await this.#server.frame({ layers, generation, since });
      if (!frame || frame.header.layers.length === 0 || resets !== this.#resets) return;
      this.#receive(frame);
      this.#shown = frame.header;
      this.#layers = layers;
      this.dispatchEvent(new Event('frame'));
    } catch (error) {
      if (resets === this.#resets) this.#asked = '';
      this.dispatchEvent(new CustomEvent('problem', { detail: error.message }));
    }
  }
}
