// Sends poses to the program: at most one request at a time, always the newest pose, and a last one
// when the camera stands still.

const kStillMs = 250;

/// Event "problem" (detail: text) if the program refuses a pose.
export class CameraSender extends EventTarget {
  #server;
  #next = null; // waits for the request in flight
  #busy = false;
  #timer = 0;
  generation = 0; // of the newest answer

  constructor(server) {
    super();
    this.#server = server;
  }

  /// Whether the program does not know the newest pose yet, or thinks that the camera moves.
  get pending() { return this.#busy || this.#next !== null || this.#timer !== 0; }

  /// A pose on the way to another one.
  move(pose) {
    clearTimeout(this.#timer);
    this.#timer = setTimeout(() => this.settle(pose), kStillMs);
    this.#send({ ...pose, moving: true });
  }

  /// A pose that stays.
  settle(pose) {
    clearTimeout(this.#timer);
    this.#timer = 0;
    this.#send({ ...pose, moving: false });
  }

  async #send(body) {
    this.#next = body;
    if (this.#busy) return;
    this.#busy = true;
    while (this.#next) {
      const sent = this.#next;
      this.#next = null;
      try {
        this.generation = (await this.#server.post('api/camera', sent)).generation;
      } catch (error) {
        this.dispatchEvent(new CustomEvent('problem', { detail: error.message }));
      }
    }
    this.#busy = false;
  }
}
