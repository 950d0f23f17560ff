// The world as it is now: the newest value of each layer, the camera, and when to draw.

import { batch, effect, signal } from '@preact/signals';
import { isDark } from '../state/choices.js';
import { isConnected, structure, watches } from '../state/store.js';
import { AreaOf, FitCamera, ZoomCamera } from './camera.js';
import { DrawWorld } from './draw.js';
import { RobotRadius } from './layers.js';

const kRate = 20;
const kElements = 5000; // of lists: scans and paths are wanted whole
const kTrail = 4000;

// What a user has chosen stays while layers come and go.
const kept = { camera: null, chosen: new Map(), following: false }; // chosen: port -> whether it is shown

export class WorldScene {
  constructor({ layers, cameras, pose }) {
    this.layers = layers;
    this.cameras = cameras;
    this.pose = pose;
    this.values = new Map();
    this.trail = [];
    this.camera = signal(kept.camera ?? { x: 0, y: 0, scale: 40 });
    this.size = signal({ width: 0, height: 0 });
    this.following = signal(kept.following);
    this.goals = signal([]); // {layer, place} of points that can be dragged
    this.choices = signal(0); // counts what the user has chosen of the layers
    this.watched = new Map(); // port -> the end of its watch
    this.fitted = kept.camera !== null;
    this.frame = 0;
    this.solid = null; // what shows it in three dimensions, while somebody looks
  }

  attach(host, canvas) {
    this.host = host;
    this.canvas = canvas;
    this.watchShown();
    const observer = new ResizeObserver(() => this.resize());
    observer.observe(host);
    const detach = this.attachPointer();
    const stop = effect(() => { isDark.value; isConnected.value; this.colours = null; this.askForFrame(); });
    return () => {
      for (const end of [...this.watched.values(), detach, stop]) end();
      this.watched.clear();
      observer.disconnect();
      cancelAnimationFrame(this.frame);
    };
  }

  receive(layer, item) {
    if (item === null) {
      this.values.delete(layer.port);
      if (layer.port === this.pose) this.trail = [];
      if (layer.goal) this.tellGoals();
      return this.askForFrame();
    }
    const { value } = item;
    this.values.set(layer.port, value);
    if (layer.port === this.pose) this.onPose(value);
    if (layer.goal) this.tellGoals();
    if (!this.fitted) this.fit(false);
    this.askForFrame();
  }

  isShown(layer) {
    return kept.chosen.get(layer.port) ?? layer.atFirst;
  }

  show(layer, isShown) {
    kept.chosen.set(layer.port, isShown);
    this.choices.value += 1;
    this.watchShown();
    this.tellGoals();
    this.askForFrame();
  }

  /** Only what is drawn is watched, and the poses that it is seen from. */
  watchShown() {
    const shown = this.layers.filter((layer) => this.isShown(layer));
    const wanted = new Set([this.pose, ...shown.flatMap((layer) => [layer.port, layer.pose]),
      ...this.cameras.map((camera) => camera.pose)].filter(Boolean));
    for (const [port, end] of this.watched) {
      if (wanted.has(port)) continue;
      end();
      this.watched.delete(port);
      this.values.delete(port);
    }
    for (const port of wanted) {
      if (this.watched.has(port)) continue;
      const layer = this.layers.find((each) => each.port === port) ?? { port };
      this.watched.set(port, watches.watch(port, {
        rate: kRate, elements: kElements, onValue: (item) => this.receive(layer, item) }).end);
    }
  }

  follow(following) {
    kept.following = this.following.value = following;
    const pose = this.values.get(this.pose);
    if (following && pose) this.move({ ...this.camera.value, x: pose.x, y: pose.y });
  }

  /** Map and room. */
  fitAll() {
    this.fit();
    this.solid?.fit();
  }

  /** Shows all that there is; `byUser` keeps it so. */
  fit(byUser = true) {
    const area = AreaOf(this.allPoints());
    if (!area || this.size.value.width === 0) return;
    this.following.value = kept.following = byUser ? false : this.following.value;
    const isMapThere = this.layers.some((layer) => layer.meaning === 'world_map' && this.values.has(layer.port));
    const space = isMapThere ? 0.1 : 1.5;
    this.camera.value = FitCamera({ left: area.left - space, right: area.right + space,
      bottom: area.bottom - space, top: area.top + space }, this.size.value);
    kept.camera = null;
    // Without a map nothing says how large the world is: the view grows with what is known.
    this.fitted = byUser || isMapThere;
    this.askForFrame();
  }

  * allPoints() {
    for (const layer of this.layers) {
      const value = this.values.get(layer.port);
      if (!value) continue;
      if (layer.meaning === 'world_map') for (const outline of value.outlines ?? []) yield* outline.points;
      if (layer.meaning === 'pose' || layer.meaning === 'point') yield value;
      if (layer.meaning === 'path') yield* value.points;
      if (layer.meaning === 'drawing' && !value.frame) for (const item of value.items ?? []) yield* item.points;
    }
  }

  move(camera) {
    this.fitted = true;
    kept.camera = this.camera.value = camera;
    this.askForFrame();
  }

  onPose(pose) {
    const last = this.trail[this.trail.length - 1];
    if (!last || Math.hypot(pose.x - last.x, pose.y - last.y) > 0.03) {
      this.trail.push({ x: pose.x, y: pose.y });
      if (this.trail.length > kTrail) this.trail.shift();
    }
    if (this.following.value) this.camera.value = { ...this.camera.value, x: pose.x, y: pose.y };
  }

  tellGoals() {
    const isPlace = (value) => value && Number.isFinite(value.x) && Number.isFinite(value.y);
    this.goals.value = this.layers
      .filter((layer) => layer.goal && this.isShown(layer) && isPlace(this.values.get(layer.port)))
      .map((layer) => ({ layer, place: this.values.get(layer.port) }));
  }

  resize() {
    const { clientWidth: width, clientHeight: height } = this.host;
    const ratio = devicePixelRatio || 1;
    this.canvas.width = Math.round(width * ratio);
    this.canvas.height = Math.round(height * ratio);
    batch(() => {
      this.size.value = { width, height };
      if (!kept.camera) this.fit(false);
    });
    this.askForFrame();
  }

  attachPointer() {
    let press = null;
    const at = (event) => ({ x: event.offsetX, y: event.offsetY });
    const handlers = {
      pointerdown: (event) => {
        press = { x: event.clientX, y: event.clientY, camera: this.camera.value };
        this.host.setPointerCapture(event.pointerId);
      },
      pointermove: (event) => {
        if (!press) return;
        this.following.value = kept.following = false;
        const { camera } = press;
        this.move({ scale: camera.scale, x: camera.x - (event.clientX - press.x) / camera.scale,
          y: camera.y + (event.clientY - press.y) / camera.scale });
      },
      pointerup: () => { press = null; },
      pointercancel: () => { press = null; },
      wheel: (event) => {
        event.preventDefault();
        this.move(ZoomCamera(this.camera.value, this.size.value, at(event), Math.exp(-event.deltaY * 0.0015)));
      },
    };
    for (const [name, handler] of Object.entries(handlers)) this.host.addEventListener(name, handler, { passive: false });
    return () => {
      for (const [name, handler] of Object.entries(handlers)) this.host.removeEventListener(name, handler);
    };
  }

  onKey(event) {
    const step = 40 / this.camera.value.scale;
    const { x, y, scale } = this.camera.value;
    const middle = { x: this.size.value.width / 2, y: this.size.value.height / 2 };
    const views = {
      ArrowLeft: { scale, x: x - step, y }, ArrowRight: { scale, x: x + step, y },
      ArrowUp: { scale, x, y: y + step }, ArrowDown: { scale, x, y: y - step },
      '+': ZoomCamera(this.camera.value, this.size.value, middle, 1.25),
      '-': ZoomCamera(this.camera.value, this.size.value, middle, 0.8),
    };
    if (!views[event.key]) return;
    event.preventDefault();
    this.move(views[event.key]);
  }

  /** Has `view` shown all that there is, from now on; the function ends it. */
  showIn(view) {
    this.solid = view;
    this.askForFrame();
    return () => { if (this.solid === view) this.solid = null; };
  }

  askForFrame() {
    if (this.frame === 0 && this.canvas) this.frame = requestAnimationFrame(() => { this.frame = 0; this.draw(); });
  }

  draw() {
    const layers = this.layers.filter((layer) => this.isShown(layer));
    const hasPath = layers.some((layer) => layer.meaning === 'path' && this.values.get(layer.port)?.points?.length > 0);
    const trail = hasPath ? [] : this.trail;
    const radius = RobotRadius(structure, this.pose);
    this.solid?.show({ layers: [...layers, ...this.cameras], values: this.values, trail, pose: this.pose, radius });
    if (this.size.value.width === 0) return;
    const context = this.canvas.getContext('2d');
    const ratio = devicePixelRatio || 1;
    context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.colours ??= Colours(this.host);
    DrawWorld({ context, colours: this.colours, camera: this.camera.value, size: this.size.value, radius }, layers, this.values, trail);
  }
}

function Colours(host) {
  const style = getComputedStyle(host);
  const names = { ground: '--world-ground', wall: '--world-wall', wallEdge: '--world-wall-edge', grid: '--world-grid',
    path: '--world-path', scan: '--world-scan', echo: '--world-echo', hit: '--world-hit', leave: '--world-leave',
    goal: '--world-goal', robot: '--world-robot', text: '--quiet' };
  return Object.fromEntries(Object.entries(names).map(([name, variable]) => [name, style.getPropertyValue(variable).trim()]));
}
