// Figures and heat map of a comparison. They are measured again while they are seen, since the
// picture goes on. It must not know how they are drawn.

const kTickMs = 500;
const kRenewMs = 4000;
const kIdlePerMeasure = 10; // times as long as the measure took

/// wanted: () => {id, heat, mix, version}: the picture to compare with, the kind of heat map or '',
/// the mix as JSON or '', and what changes with the picture; null if nobody looks.
/// receive: ({figures, bitmap}, wanted) => void; the bitmap is null without a heat map.
export class CompareMeasure {
  #server;
  #wanted;
  #receive;
  #measured = ''; // what was asked for last
  #next = 0; // time from which on it may be measured again
  #running = Promise.resolve();
  #busy = false;

  constructor(server, wanted, receive) {
    this.#server = server;
    this.#wanted = wanted;
    this.#receive = receive;
    setInterval(() => this.#renew(), kTickMs);
  }

  /// Measures at once. Throws if that is not possible.
  async now() {
    await this.settled();
    this.#running = this.#measure(this.#wanted());
    await this.#running;
  }

  /// Waits until nothing is measured.
  async settled() {
    await this.#running.catch(() => {});
  }

  #renew() {
    const wanted = this.#wanted();
    if (this.#busy || !wanted || document.hidden) return;
    const { id, heat, mix, version } = wanted;
    const isSame = this.#measured === JSON.stringify([id, heat, mix, version]);
    if (isSame || performance.now() < this.#next) return;
    // Why it cannot be measured was told when the picture was chosen.
    this.#running = this.#measure(wanted).catch(() => {});
  }

  async #measure(wanted) {
    if (!wanted) return;
    const { id, heat, mix, version } = wanted;
    this.#busy = true;
    this.#measured = JSON.stringify([id, heat, mix, version]);
    const begin = performance.now();
    try {
      const query = new URLSearchParams(mix ? { with: id, mix } : { with: id });
      const figures = await this.#server.get(`api/compare?${query}`);
      let bitmap = null;
      if (heat) {
        query.set('kind', heat);
        bitmap = await createImageBitmap(await this.#server.blob(`api/heat?${query}`));
      }
      this.#receive({ figures, bitmap }, wanted);
      bitmap?.close();
    } catch (error) {
      this.#measured = ''; // again after a while
      throw error;
    } finally {
      const took = performance.now() - begin;
      this.#next = performance.now() + Math.max(kRenewMs, kIdlePerMeasure * took);
      this.#busy = false;
    }
  }
}
