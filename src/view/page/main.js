// Puts the page together: server, models, picture and panels. Each of them is a file of its own.

import { CameraControls } from './camera_controls.js';
import { CameraPanel } from './camera_panel.js';
import { CameraSender } from './camera_sender.js';
import { ComparePanel } from './compare_panel.js';
import { Display } from './display.js';
import { DisplayPanel } from './display_panel.js';
import { byId } from './dom.js';
import { FailureMessage } from './failure_message.js';
import { firstPicturePainted, hideFirstPicture } from './first_picture.js';
import { InspectorPanel } from './inspector_panel.js';
import { Keyboard } from './keyboard.js';
import { LayersPanel } from './layers_panel.js';
import { Mix } from './mix.js';
import { PathOverlay } from './path_overlay.js';
import { PictureFeed } from './picture_feed.js';
import { PixelReadout } from './pixel_readout.js';
import { Server } from './protocol.js';
import { RenderPanel } from './render_panel.js';
import { setUpSaveLinks } from './save_links.js';
import { Stage } from './stage.js';
import { StatusBar } from './status_bar.js';
import { offerTestInterface } from './test_interface.js';
import { Tools } from './tools.js';
import { ViewTransform } from './view_transform.js';
import { setUpWindow } from './window_controls.js';

const kScenePanels = ['camera-panel', 'inspector-panel', 'render-panel', 'save-scene'];

function start() {
  const status = new StatusBar();
  const notify = (text) => status.notify(text);
  const server = new Server();
  const view = new ViewTransform();
  const display = new Display();
  const mix = new Mix();
  const sender = new CameraSender(server);
  const camera = new CameraControls(sender);
  let stage;
  try {
    stage = new Stage(byId('canvas'), view, display, mix);
  } catch (error) {
    status.setLasting(error.message, true);
    hideFirstPicture();
    return;
  }
  let state = null;
  const wanted = () => wantedLayers(mix, display, state);
  const feed = new PictureFeed(server, wanted, (frame) => stage.setFrame(frame));
  const overlay = new PathOverlay(view);
  const inspector = new InspectorPanel({ server, overlay, camera, view,
    announce: (text) => status.announce(text) });
  const compare = new ComparePanel(server, () => stage.renderer, mix, notify);
  const render = new RenderPanel(server, notify);
  const readout = new PixelReadout(server, stage, status);
  const tools = new Tools({ server, view, camera, inspector, render, overlay, readout, notify });
  const displayPanel = new DisplayPanel(display, stage);
  const layersPanel = new LayersPanel(mix);
  const windowControls = setUpWindow(view);
  const keyboard = new Keyboard({ ...keyActions({ camera, compare, display, render, tools, view }),
    panels: windowControls.togglePanels });
  const cameraPanel = new CameraPanel(camera, server,
    { setTool: (name) => tools.set(name), toggleFly: () => keyboard.toggleFly() }, notify);

  stage.setCompare(() => compare.drawn);
  // A pose that the program refuses is given up.
  sender.addEventListener('problem', (event) => {
    notify(event.detail);
    camera.forget();
    server.refresh().catch(() => {});
  });
  compare.addEventListener('change', () => stage.requestDraw());
  for (const model of [mix, display]) model.addEventListener('change', () => feed.update());
  mix.addEventListener('change', () => displayPanel.pictureChanged());
  feed.addEventListener('frame', () => displayPanel.pictureChanged());
  feed.addEventListener('frame', () => readout.refresh());
  feed.addEventListener('frame', hideFirstPicture, { once: true });
  feed.addEventListener('problem', (event) => notify(event.detail));
  stage.addEventListener('lost', () => status.setLasting('The graphics card was reset.'));
  stage.addEventListener('restored', () => {
    status.setLasting('');
    feed.reset();
    compare.load();
  });

  setUpSaveLinks(server, notify);

  const listeners = [status, new FailureMessage(), camera, render, compare, displayPanel,
    layersPanel, cameraPanel, tools, feed];
  server.addEventListener('state', (event) => {
    if (state && state.generation !== event.detail.generation) inspector.clear();
    const layersBefore = state?.settings.layers;
    state = event.detail;
    // Of a picture there is nothing to render, to inspect or to look around in.
    for (const id of kScenePanels) byId(id).hidden = state.kind === 'picture';
    const size = fullSize(state);
    if (size) view.setPicture(...size);
    // Lamps are shown to those who ask for them.
    const { layers } = state.settings;
    if (layers !== layersBefore) mix.kind = layers === 'routes' ? 'route' : 'light';
    mix.setLayers(state.layers);
    for (const listener of listeners) listener.setState(state);
  });
  server.addEventListener('lost', (event) => status.setLost(event.detail, 'Trying again.'));
  server.addEventListener('found', () => {
    status.setLasting('');
    camera.forget();
    feed.reset();
  });
  server.addEventListener('refused', () => status.setLost('The program was started again',
    'Open the address that it printed.', true));
  offerTestInterface({ state: () => state, stage, mix, feed });
  connectWhileSeen(server);
}

function connectWhileSeen(server) {
  const update = () => {
    if (document.hidden) server.close();
    else server.connect();
  };
  document.addEventListener('visibilitychange', update);
  update();
}

// Only what is needed: the picture alone as long as the mix changes nothing. Coarse pictures have
// no layers to mix.
function wantedLayers(mix, display, state) {
  if (state?.preview) return ['picture'];
  if (display.view !== '') return [display.view];
  return mix.neutral ? ['picture'] : mix.names;
}

// Pixels of the full picture; a coarse one has fewer. Null before the scene is read.
function fullSize({ kind, settings, width, height }) {
  const [fullWidth, fullHeight] = settings?.resolution ?? [0, 0];
  const known = kind === 'scene' && fullWidth > 0 && fullHeight > 0;
  if (known) return [fullWidth, fullHeight];
  return width > 0 && height > 0 ? [width, height] : null;
}

function keyActions({ camera, compare, display, render, tools, view }) {
  const expose = (step) => display.set({ stops: Math.round(3 * display.stops + step) / 3 });
  return {
    undo: () => camera.undo(),
    redo: () => camera.redo(),
    fit: () => view.fit(),
    actual: () => view.actual(),
    zoomIn: () => view.zoomBy(Math.SQRT2),
    zoomOut: () => view.zoomBy(Math.SQRT1_2),
    darker: () => expose(-1),
    brighter: () => expose(1),
    marks: () => display.set({ marks: !display.marks }),
    falseColor: () => display.set({ curve: display.curve === 'false' ? 'srgb' : 'false' }),
    snapshot: () => compare.snapshot(),
    blink: () => compare.blink(),
    pause: () => render.togglePause(),
    restart: () => render.restart(),
    escape: () => tools.set('camera'),
    dolly: (factor) => tools.dolly(factor),
    arrow: (dx, dy, shift) => tools.arrow(dx, dy, shift),
    fly: (...directions) => camera.fly(...directions),
    setFlying: (flying) => tools.setFlying(flying),
  };
}

// WebGL keeps the browser from painting while it begins.
firstPicturePainted().then(start);
