// What tests of the page may use: window.nephroid. Nothing of the page itself uses it.

const kSettleMs = 20000;

export function offerTestInterface({ state, stage, mix, feed }) {
  window.nephroid = {
    get state() { return state(); },
    /// Number of the picture on the screen; 0 before the first one.
    get frameVersion() { return feed.shown?.version ?? 0; },
    get frame() { return feed.shown; },
    /// Linear value that is shown at a pixel, before the tone curve: [r, g, b], or null.
    readPixel: (x, y) => stage.readPixel(x, y),
    setGain: (layer, gain) => mix.set(layer, { gain }),
    /// Waits until the screen shows the layers that the mix needs. False if it takes too long.
    async settled() {
      const end = performance.now() + kSettleMs;
      while (!feed.upToDate && performance.now() < end) {
        await new Promise((resolve) => { setTimeout(resolve, 20); });
      }
      return feed.upToDate;
    },
  };
}
