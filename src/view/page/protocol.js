// Speaks with the program: JSON requests, state events, and frames of float16 tiles.
// It must not know of WebGL or of the elements of the page.

const kMagic = 0x5648504e; // "NPHV", little endian
const kVersion = 1;
const kRetryMs = 2000;
const kNoConnection = 'The program has ended, or cannot be reached';

/// Splits a frame into its JSON header and its halves: {header, halves}.
export function decodeFrame(buffer) {
  const view = new DataView(buffer);
  if (buffer.byteLength < 12 || view.getUint32(0, true) !== kMagic) {
    throw new Error('frame: not a picture of Nephroid');
  }
  if (view.getUint32(4, true) !== kVersion) {
    throw new Error('frame: version of another program, reload the page');
  }
  const headerBytes = view.getUint32(8, true);
  const header = JSON.parse(new TextDecoder().decode(new Uint8Array(buffer, 12, headerBytes)));
  return { header, halves: new Uint16Array(buffer, 12 + headerBytes) };
}

/// Rectangle of a tile in pixels of the window: {x, y, width, height}.
export function tileRectangle(header, index) {
  const [width, height] = windowSize(header);
  const perRow = Math.ceil(width / header.tile);
  const x = (index % perRow) * header.tile;
  const y = Math.floor(index / perRow) * header.tile;
  return {
    x, y, width: Math.min(header.tile, width - x), height: Math.min(header.tile, height - y),
  };
}

/// Width and height of the pixels that a frame holds.
export function windowSize(header) {
  const [x0, y0, x1, y1] = header.window;
  return [x1 - x0, y1 - y0];
}

/// The program at the other end. Events: "state" (detail: the state), "lost" (detail: why),
/// "found", "refused".
export class Server extends EventTarget {
  #source = null;
  #lost = ''; // why there is no connection
  #retry = 0;

  /// Asks for states. Pages that nobody sees close(): browsers have six connections for all pages
  /// of a program.
  connect() {
    this.close();
    this.#source = new EventSource('api/events');
    this.#source.addEventListener('state', (event) => {
      this.#setLost('');
      this.dispatchEvent(new CustomEvent('state', { detail: JSON.parse(event.data) }));
    });
    this.#source.onerror = () => this.#afterError();
  }

  close() {
    clearTimeout(this.#retry);
    this.#source?.close();
    this.#source = null;
  }

  /// A frame that is newer than the query says, or null.
  async frame(query) {
    const response = await this.#request('api/frame?' + new URLSearchParams(query));
    return response.status === 204 ? null : decodeFrame(await response.arrayBuffer());
  }

  /// Asks for the state without waiting for the next event.
  async refresh() {
    const detail = await this.get('api/state');
    this.dispatchEvent(new CustomEvent('state', { detail }));
  }

  async get(path) {
    return (await this.#request(path)).json();
  }

  async text(path) {
    return (await this.#request(path)).text();
  }

  async blob(path) {
    return (await this.#request(path)).blob();
  }

  async post(path, body) {
    const response = await this.#request(path, {
      method: 'POST',
      headers: { 'Content-Type': 'application/json' },
      body: JSON.stringify(body),
    });
    return response.json();
  }

  async remove(path) {
    await this.#request(path, { method: 'DELETE' });
  }

  async upload(file) {
    const response = await this.#request('api/upload?name=' + encodeURIComponent(file.name), {
      method: 'POST',
      headers: { 'Content-Type': 'application/octet-stream' },
      body: file,
    });
    return response.json();
  }

  /// A file: {blob, name}, or {saved} if the program wrote it by itself.
  async file(path) {
    const response = await this.#request(path);
    const [, name] = /filename="([^"]*)"/.exec(response.headers.get('Content-Disposition')) ?? [];
    return name ? { blob: await response.blob(), name } : response.json();
  }

  async #request(path, options = {}) {
    const response = await fetch(path, { cache: 'no-store', ...options });
    if (response.ok) return response;
    const problem = await response.json().catch(() => ({}));
    throw new Error(problem.error || `The program answered ${response.status}.`);
  }

  #setLost(why) {
    if (why === this.#lost) return;
    this.#lost = why;
    this.dispatchEvent(why ? new CustomEvent('lost', { detail: why }) : new Event('found'));
  }

  // The browser connects again by itself, except after an answer that is an error.
  async #afterError() {
    const source = this.#source;
    if (source?.readyState !== EventSource.CLOSED) {
      this.#setLost(kNoConnection);
      return;
    }
    const { status, text } = await whyNoEvents();
    if (source !== this.#source) return; // closed or connected again
    if (status === 401 || status === 403) {
      this.dispatchEvent(new Event('refused'));
      return;
    }
    this.#setLost(text ?? kNoConnection);
    this.#retry = setTimeout(() => this.connect(), kRetryMs);
  }
}

// An EventSource does not tell what the answer was.
async function whyNoEvents() {
  const stop = new AbortController();
  try {
    const answer = await fetch('api/events', { cache: 'no-store', signal: stop.signal });
    const text = answer.ok ? undefined : (await answer.json()).error;
    return { status: answer.status, text };
  } catch {
    return {};
  } finally {
    stop.abort();
  }
}
