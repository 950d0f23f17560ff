// The world as a room that one looks into: a script of its own, since three.js is larger than all the rest of the page.
// It knows nothing of the page: it is handed layers and their values, and draws when one of them is another one.

import { AmbientLight, Color, DirectionalLight, Fog, HemisphereLight, PCFSoftShadowMap, PerspectiveCamera, Scene, Vector3,
  WebGLRenderer } from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { AreaOfMap, Ground, Obstacles } from './obstacles.js';
import { CameraFrustum, GoalMark, HitMarks, OtherPose, Robot } from './things.js';
import { Drawn, Path, Scan } from './measurements.js';
import { Release } from './release.js';

const kMakers = {
  world_map: (value, tools) => [Ground(value, tools), Obstacles(value, tools)],
  path: (value, tools) => [Path(value.points, tools)],
  hit_and_leave_points: (value, tools) => [HitMarks(value, tools)],
  range_scan: (value, tools, pose) => (pose ? [Scan(value, pose, tools)] : []),
  drawing: (value, tools, pose) => (value.frame && !pose ? [] : [Drawn(value, pose, tools)]),
  point: (value, tools) => [GoalMark(value, tools)],
  camera: (value, tools, pose) => (pose ? [CameraFrustum(value, pose, tools)] : []),
};

/** Throws where the browser has no WebGL. `onMove`: the user has turned or moved it. */
export class World3D {
  #parts = new Map(); // layer -> {objects, of: what they were made from}
  #frame = 0;
  #isFitted = false;

  constructor(canvas, { onMove } = {}) {
    this.canvas = canvas;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, powerPreference: 'low-power' });
    this.renderer.shadowMap.enabled = true;
    this.renderer.shadowMap.type = PCFSoftShadowMap;
    this.renderer.shadowMap.autoUpdate = false; // of what stands still; it is dear
    this.scene = new Scene();
    this.camera = new PerspectiveCamera(42, 1, 0.05, 500);
    this.camera.up.set(0, 0, 1);
    this.camera.position.set(-4, -7, 7);
    this.controls = new OrbitControls(this.camera, canvas);
    Object.assign(this.controls, { maxPolarAngle: Math.PI / 2 - 0.02, minDistance: 0.5, maxDistance: 200, zoomToCursor: true,
      screenSpacePanning: false });
    this.controls.addEventListener('change', () => this.#ask());
    this.controls.addEventListener('start', () => { this.#isFitted = true; onMove?.(); });
    this.hemisphere = new HemisphereLight(0xffffff, 0x8899aa, 1.3);
    this.sun = new DirectionalLight(0xffffff, 1.9);
    this.sun.castShadow = true;
    this.sun.shadow.mapSize.set(2048, 2048);
    this.sun.shadow.radius = 5;
    this.sun.shadow.bias = -0.0006;
    this.sun.shadow.normalBias = 0.02;
    this.scene.add(this.hemisphere, new AmbientLight(0xffffff, 0.35), this.sun, this.sun.target);
  }

  /** `colours`: as the map has them, with isDark. */
  setColours(colours) {
    this.colours = colours;
    this.scene.background = new Color(colours.ground);
    this.hemisphere.groundColor.set(colours.isDark ? '#1a2230' : '#aab4c2');
    this.hemisphere.intensity = colours.isDark ? 0.9 : 1.5;
    this.sun.intensity = colours.isDark ? 1.5 : 1.7;
    this.#setFog();
    this.#forget();
  }

  resize(width, height, ratio) {
    if (width === 0 || height === 0) return;
    this.renderer.setPixelRatio(Math.min(2, ratio));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    if (!this.#isFitted && this.map) this.fit();
    this.#ask();
  }

  /** What is to be seen now: layers {port, meaning, pose} with the values of ports, the trail, the robot's radius. */
  show({ layers, values, trail, pose, radius }) {
    if (!this.colours) return;
    const wanted = new Map();
    let poses = 0;
    for (const layer of layers) {
      const value = layer.meaning === 'camera' ? layer.camera : values.get(layer.port);
      const from = layer.pose ? values.get(layer.pose) : null;
      if (!value) continue;
      if (layer.meaning === 'pose') wanted.set(layer.port, { value, isMain: layer.port === pose, number: poses++ });
      else if (kMakers[layer.meaning]) wanted.set(layer.port, { value, from, make: kMakers[layer.meaning] });
      if (layer.meaning === 'world_map') this.#takeMap(value);
    }
    if (trail.length > 1) wanted.set('trail', { value: trail.length + trail[trail.length - 1].x, trail, make: (_, tools) => [Path(trail, tools)] });
    const contact = layers.find((layer) => layer.meaning === 'contact');
    const isTouching = contact && Object.values(values.get(contact.port) ?? {}).includes(true);
    for (const [key, part] of this.#parts) if (!wanted.has(key)) this.#remove(key, part);
    for (const [key, part] of wanted) this.#put(key, part, { radius, isTouching });
    const at = values.get(pose);
    if (at && !this.map && !this.#isFitted) this.#look({ x: at.x, y: at.y }, 4);
    this.at = at;
    if (this.following && at) this.#follow(at);
    this.#ask();
  }

  follow(following) {
    this.following = following;
    this.before = null;
    if (following && this.at) this.#follow(this.at);
    this.#ask();
  }

  /** All of the map, from above and aside. */
  fit() {
    const area = this.map ? AreaOfMap(this.map) : null;
    if (area) this.#look({ x: (area.left + area.right) / 2, y: (area.bottom + area.top) / 2 }, area);
    else if (this.at) this.#look(this.at, 4);
    this.#isFitted = false;
    this.#ask();
  }

  dispose() {
    cancelAnimationFrame(this.#frame);
    this.#forget();
    this.controls.dispose();
    this.renderer.dispose();
  }

  #takeMap(map) {
    if (this.map === map) return;
    const isFirst = !this.map || this.map.name !== map.name;
    this.map = map;
    this.#light(AreaOfMap(map));
    this.#setFog();
    if (isFirst && !this.#isFitted) this.fit();
  }

  #light(area) {
    if (!area) return;
    const reach = Math.max(area.right - area.left, area.top - area.bottom) / 2 + 1;
    const middle = new Vector3((area.left + area.right) / 2, (area.bottom + area.top) / 2, 0);
    this.sun.position.copy(middle).add(new Vector3(-0.55, -0.4, 1.15).multiplyScalar(reach * 1.4));
    this.sun.target.position.copy(middle);
    Object.assign(this.sun.shadow.camera, { left: -reach * 1.3, right: reach * 1.3, bottom: -reach * 1.3, top: reach * 1.3, far: reach * 5 });
    this.sun.shadow.camera.updateProjectionMatrix();
  }

  #setFog() {
    const area = this.map ? AreaOfMap(this.map) : null;
    const reach = area ? Math.max(area.right - area.left, area.top - area.bottom) : 20;
    this.scene.fog = this.colours ? new Fog(this.colours.ground, reach * 1.8, reach * 5) : null;
  }

  #put(key, part, { radius, isTouching }) {
    const known = this.#parts.get(key);
    if (part.make) {
      if (known && known.of === part.value && SamePose(known.from, part.from)) return;
      if (known) this.#remove(key, known);
      const objects = part.make(part.value, this.#tools(), part.from).filter(Boolean);
      for (const object of objects) this.scene.add(object);
      this.#parts.set(key, { objects, of: part.value, from: part.from && { ...part.from } });
      if (part.make === kMakers.world_map) this.renderer.shadowMap.needsUpdate = true;
      return;
    }
    // A pose only moves what is there already.
    const look = `${radius} ${part.isMain} ${part.isMain && isTouching}`;
    let place = known;
    if (!known || known.look !== look) {
      if (known) this.#remove(key, known);
      const object = part.isMain ? Robot(radius, this.#tools(), isTouching) : OtherPose(radius, this.#tools());
      this.scene.add(object);
      place = { objects: [object], look };
      this.#parts.set(key, place);
    }
    place.objects[0].position.set(part.value.x, part.value.y, 0);
    place.objects[0].rotation.z = part.value.heading;
  }

  #tools() {
    return { colours: this.colours };
  }

  #remove(key, part) {
    for (const object of part.objects) Release(object);
    this.#parts.delete(key);
  }

  #forget() {
    for (const [key, part] of [...this.#parts]) this.#remove(key, part);
  }

  /** `size`: how much of the ground is to be seen: metres, or an area. */
  #look(middle, size) {
    const half = Math.tan((this.camera.fov * Math.PI) / 360);
    const [width, depth] = typeof size === 'number' ? [size, size] : [size.right - size.left + 0.6, size.top - size.bottom + 0.6];
    // Seen from 50 degrees above, what is deep looks shorter.
    const distance = Math.max(width / 2 / (half * this.camera.aspect), (depth * 0.42) / half) + depth * 0.28;
    this.controls.target.set(middle.x, middle.y - depth * 0.03, 0);
    this.camera.position.set(middle.x, middle.y - distance * Math.cos(0.95), distance * Math.sin(0.95));
    this.controls.update();
  }

  #follow(at) {
    if (this.before) {
      const step = new Vector3(at.x - this.before.x, at.y - this.before.y, 0);
      this.camera.position.add(step);
      this.controls.target.add(step);
    } else {
      const step = new Vector3(at.x, at.y, 0).sub(this.controls.target);
      this.camera.position.add(step);
      this.controls.target.add(step);
    }
    this.before = { x: at.x, y: at.y };
    this.controls.update();
  }

  /** How many pictures have been drawn; for tests. */
  drawn = 0;

  #ask() {
    if (this.#frame !== 0) return;
    this.#frame = requestAnimationFrame(() => {
      this.#frame = 0;
      this.renderer.render(this.scene, this.camera);
      this.drawn += 1;
      this.canvas.dataset.drawn = String(this.drawn);
    });
  }
}

function SamePose(one, other) {
  return one === other || (one && other && one.x === other.x && one.y === other.y && one.heading === other.heading);
}
