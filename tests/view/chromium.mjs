// A headless Chromium driven over its debugging pipe. Needs node 18 or newer, no packages.
import { spawn } from 'node:child_process';
import { mkdtempSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

const kFlags = [
  '--headless=new', '--no-sandbox', '--remote-debugging-pipe',
  '--enable-unsafe-swiftshader', // WebGL without a graphics card
  '--disable-dev-shm-usage', '--no-first-run', '--disable-background-networking',
  '--disable-component-update', '--hide-scrollbars=false'];
const kAnswerMs = 30000;

export class Chromium {
  #process;
  #profile;
  #waiting = new Map(); // id of a command to {resolve, reject}
  #listeners = new Map(); // session to function of (method, params)
  #nextId = 1;
  #rest = '';

  constructor(program = process.env.CHROMIUM ?? 'chromium') {
    this.#profile = mkdtempSync(join(tmpdir(), 'nephroid-view-'));
    this.#process = spawn(program, [...kFlags, `--user-data-dir=${this.#profile}`, 'about:blank'],
      { stdio: ['ignore', 'ignore', 'ignore', 'pipe', 'pipe'] });
    this.#process.on('error', (error) => { throw new Error(`${program}: ${error.message}`); });
    this.#process.stdio[4].on('data', (bytes) => this.#read(bytes.toString()));
  }

  /// A new tab of that size in CSS pixels.
  async open(width, height) {
    const { targetId } = await this.send('Target.createTarget', { url: 'about:blank' });
    const { sessionId } = await this.send('Target.attachToTarget', { targetId, flatten: true });
    const page = new Page(this, sessionId, targetId);
    this.#listeners.set(sessionId, (method, params) => page.receive(method, params));
    for (const domain of ['Page', 'Runtime', 'Log']) await page.send(`${domain}.enable`);
    await page.resize(width, height);
    return page;
  }

  send(method, params = {}, sessionId = undefined) {
    const id = this.#nextId++;
    this.#process.stdio[3].write(JSON.stringify({ id, method, params, sessionId }) + '\0');
    return new Promise((resolve, reject) => {
      const timer = setTimeout(() => reject(new Error(`${method}: no answer`)), kAnswerMs);
      const done = (finish) => (value) => { clearTimeout(timer); finish(value); };
      this.#waiting.set(id, { resolve: done(resolve), reject: done(reject) });
    });
  }

  async close() {
    const ended = new Promise((resolve) => { this.#process.on('exit', resolve); });
    await this.send('Browser.close').catch(() => this.#process.kill());
    await ended;
    rmSync(this.#profile, { recursive: true, force: true, maxRetries: 5 });
  }

  #read(text) {
    const messages = (this.#rest + text).split('\0');
    this.#rest = messages.pop();
    for (const message of messages.map((one) => JSON.parse(one))) {
      if (message.id === undefined) {
        this.#listeners.get(message.sessionId)?.(message.method, message.params);
        continue;
      }
      const waiting = this.#waiting.get(message.id);
      this.#waiting.delete(message.id);
      if (message.error) waiting?.reject(new Error(message.error.message));
      else waiting?.resolve(message.result);
    }
  }
}

/// A tab. What it complains of is kept in `problems`.
export class Page {
  problems = [];
  #browser;
  #session;
  #target;
  #pointer = [0, 0];

  constructor(browser, session, target) {
    this.#browser = browser;
    this.#session = session;
    this.#target = target;
  }

  send(method, params = {}) {
    return this.#browser.send(method, params, this.#session);
  }

  receive(method, params) {
    if (method === 'Runtime.exceptionThrown') {
      const { exception, text } = params.exceptionDetails;
      this.problems.push(exception?.description ?? text);
    } else if (method === 'Log.entryAdded' && params.entry.level === 'error') {
      this.problems.push(`${params.entry.text} ${params.entry.url ?? ''}`);
    } else if (method === 'Runtime.consoleAPICalled' &&
               ['error', 'warning', 'assert'].includes(params.type)) {
      this.problems.push(params.args.map((one) => one.value ?? one.description).join(' '));
    }
  }

  /// Runs a function in each page that is opened from now on, before the page's own scripts.
  async runFirst(call) {
    await this.send('Page.addScriptToEvaluateOnNewDocument', { source: `(${call})()` });
  }

  async goto(url) {
    await this.send('Page.navigate', { url });
  }

  async resize(width, height, deviceScaleFactor = 1) {
    await this.send('Emulation.setDeviceMetricsOverride',
      { width, height, deviceScaleFactor, mobile: false });
  }

  /// Calls a function in the page and returns its value, a promise's too.
  async evaluate(call, ...values) {
    const { result, exceptionDetails } = await this.send('Runtime.evaluate', {
      expression: `(${call})(...${JSON.stringify(values)})`, awaitPromise: true,
      returnByValue: true });
    if (exceptionDetails) {
      throw new Error(exceptionDetails.exception?.description ?? exceptionDetails.text);
    }
    return result.value;
  }

  /// Waits until a function in the page returns something true, and returns that.
  async waitFor(call, values = [], milliseconds = 20000) {
    const end = Date.now() + milliseconds;
    for (;;) {
      const value = await this.evaluate(call, ...values).catch((error) => {
        if (!/context was destroyed|navigat|Cannot find/i.test(error.message)) throw error;
      });
      if (value) return value;
      if (Date.now() > end) throw new Error(`waited too long for ${call}`);
      await new Promise((resolve) => { setTimeout(resolve, 50); });
    }
  }

  /// Middle of an element in CSS pixels.
  async middle(selector) {
    return this.evaluate((found) => {
      const element = document.querySelector(found);
      element.scrollIntoView({ block: 'nearest' });
      const box = element.getBoundingClientRect();
      return [box.left + box.width / 2, box.top + box.height / 2];
    }, selector);
  }

  async click(selector) {
    await this.clickAt(...await this.middle(selector));
  }

  async clickAt(x, y) {
    await this.#mouse('mouseMoved', x, y);
    await this.#mouse('mousePressed', x, y, 'left');
    await this.#mouse('mouseReleased', x, y, 'left');
  }

  async drag([x0, y0], [x1, y1], button = 'left') {
    await this.#mouse('mouseMoved', x0, y0);
    await this.#mouse('mousePressed', x0, y0, button);
    for (let step = 1; step <= 8; ++step) {
      const part = step / 8;
      await this.#mouse('mouseMoved', x0 + part * (x1 - x0), y0 + part * (y1 - y0), button);
    }
    await this.#mouse('mouseReleased', x1, y1, button);
  }

  async hover(x, y) {
    await this.#mouse('mouseMoved', x, y);
  }

  async wheel(x, y, deltaY) {
    await this.send('Input.dispatchMouseEvent', { type: 'mouseWheel', x, y, deltaX: 0, deltaY });
  }

  /// Presses and releases a key, given as KeyboardEvent.key and .code.
  async press(key, code, modifiers = 0) {
    const windowsVirtualKeyCode = key.length === 1 ? key.toUpperCase().charCodeAt(0) : 0;
    const text = key.length === 1 && modifiers === 0 ? key : undefined;
    await this.send('Input.dispatchKeyEvent',
      { type: 'keyDown', key, code, modifiers, text, windowsVirtualKeyCode });
    await this.send('Input.dispatchKeyEvent',
      { type: 'keyUp', key, code, modifiers, windowsVirtualKeyCode });
  }

  /// Chooses a file in a file input.
  async chooseFile(selector, file) {
    const { root } = await this.send('DOM.getDocument');
    const { nodeId } = await this.send('DOM.querySelector', { nodeId: root.nodeId, selector });
    await this.send('DOM.setFileInputFiles', { nodeId, files: [file] });
  }

  async screenshot(file) {
    // A page that another one has covered is never painted.
    await this.send('Page.bringToFront');
    const { data } = await this.send('Page.captureScreenshot', { format: 'png' });
    writeFileSync(file, Buffer.from(data, 'base64'));
  }

  async close() {
    await this.#browser.send('Target.closeTarget', { targetId: this.#target });
  }

  async #mouse(type, x, y, button = 'none') {
    this.#pointer = [x, y];
    await this.send('Input.dispatchMouseEvent',
      { type, x, y, button, clickCount: type === 'mouseMoved' ? 0 : 1 });
  }
}
