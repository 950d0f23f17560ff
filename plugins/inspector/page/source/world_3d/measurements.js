// What is measured, gone, and drawn: rays, ways, and what modules have in mind.

import { BufferGeometry, CanvasTexture, Color, DoubleSide, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshBasicMaterial, Points, PointsMaterial, Sprite, SpriteMaterial } from 'three';
import { ScanEnds, SeenFrom } from '../world/scan_geometry.js';

const kScanHeight = 0.22; // m, where a scan is drawn
const kRays = 46;          // that are drawn at most: with more of them only a cloud is seen
const kPathWidth = 0.05;

/** Some of the rays, the area that all of them pass, and where they hit something. */
export function Scan(scan, pose, { colours }) {
  const ends = ScanEnds(scan, pose);
  const z = kScanHeight;
  const group = new Group();
  const step = Math.ceil(ends.length / kRays);
  const area = [];
  const rays = [];
  const echoes = [];
  ends.forEach((end, index) => {
    const next = ends[index + 1];
    if (next) area.push(pose.x, pose.y, z, end.x, end.y, z, next.x, next.y, z);
    if (index % step === 0 || index === ends.length - 1) rays.push(pose.x, pose.y, z, end.x, end.y, z);
    if (end.isEcho) echoes.push(end.x, end.y, z);
  });
  group.add(new Mesh(Places(area), Clear(colours.echo, 0.1)),
    new LineSegments(Places(rays), new LineBasicMaterial({ color: colours.echo, transparent: true, opacity: 0.3, depthWrite: false })),
    new Points(Places(echoes), new PointsMaterial({ color: colours.echo, size: 0.075 })));
  return group;
}

export function Path(points = [], { colours }) {
  return points.length < 2 ? null : Ribbon(points, kPathWidth, Clear(colours.path, 0.95), 0.014);
}

/** What a module draws. */
export function Drawn({ frame, items = [] }, pose) {
  const group = new Group();
  items.forEach((item, index) => {
    const places = frame ? item.points.map((point) => SeenFrom(pose, point)) : item.points;
    if (places.length === 0) return;
    const { red, green, blue, alpha } = item.colour;
    const colour = new Color(red, green, blue);
    const z = 0.02 + index * 0.001;
    if (item.kind === 'points') {
      group.add(new Points(Places(places.flatMap(({ x, y }) => [x, y, 0.06])),
        new PointsMaterial({ color: colour, size: Math.max(0.04, item.size), transparent: alpha < 1, opacity: alpha })));
    } else if (item.kind === 'text') group.add(Label(item, places[0], colour));
    else group.add(Ribbon(item.kind === 'closed_line' ? [...places, places[0]] : places, Math.max(0.02, item.size), Clear(colour, alpha), z));
  });
  return group;
}

/** A line as wide as it is in the world, flat on the ground. */
function Ribbon(points, width, material, z) {
  const triangles = [];
  for (let index = 0; index + 1 < points.length; ++index) {
    const [a, b] = [points[index], points[index + 1]];
    const length = Math.hypot(b.x - a.x, b.y - a.y);
    if (!(length > 0)) continue;
    const [along, half] = [{ x: (b.x - a.x) / length, y: (b.y - a.y) / length }, width / 2];
    const corner = (at, forward, side) => [at.x + half * (forward * along.x - side * along.y), at.y + half * (forward * along.y + side * along.x), z];
    // A little longer than the way, so that there are no gaps at corners.
    const [p, q, r, s] = [corner(a, -1, 1), corner(a, -1, -1), corner(b, 1, -1), corner(b, 1, 1)];
    triangles.push(...p, ...q, ...r, ...p, ...r, ...s);
  }
  return new Mesh(Places(triangles), material);
}

function Label({ text, size }, { x, y }, colour) {
  const canvas = document.createElement('canvas');
  const context = canvas.getContext('2d');
  const font = '48px system-ui, sans-serif';
  context.font = font;
  Object.assign(canvas, { width: Math.ceil(context.measureText(text).width) + 8, height: 60 });
  context.font = font;
  context.fillStyle = `#${colour.getHexString()}`;
  context.fillText(text, 4, 46);
  const sprite = new Sprite(new SpriteMaterial({ map: new CanvasTexture(canvas), transparent: true, depthWrite: false }));
  const height = Math.max(0.12, size) * 1.25;
  sprite.scale.set((height * canvas.width) / canvas.height, height, 1);
  sprite.position.set(x, y, 0.25);
  return sprite;
}

function Places(numbers) {
  return new BufferGeometry().setAttribute('position', new Float32BufferAttribute(numbers, 3));
}

function Clear(color, opacity) {
  return new MeshBasicMaterial({ color, transparent: opacity < 1, opacity, side: DoubleSide, depthWrite: false });
}
