// The ground, and what stands on it.

import { BufferGeometry, EdgesGeometry, ExtrudeGeometry, Float32BufferAttribute, Group, LineBasicMaterial, LineSegments, Mesh,
  MeshLambertMaterial, Path, PlaneGeometry, Shape } from 'three';

const kHeight = 1; // m, of obstacles whose height nobody says
const kGridStep = 1;

/** {left, right, bottom, top} of a map, or null. */
export function AreaOfMap({ outlines = [], bounds = [] }) {
  const points = [...bounds, ...outlines.flatMap((outline) => outline.points)];
  if (points.length === 0) return null;
  const [xs, ys] = [points.map(({ x }) => x), points.map(({ y }) => y)];
  const [least, most] = [(list) => list.reduce((a, b) => Math.min(a, b)), (list) => list.reduce((a, b) => Math.max(a, b))];
  return { left: least(xs), right: most(xs), bottom: least(ys), top: most(ys) };
}

export function Ground(map, { colours }) {
  const area = AreaOfMap(map);
  if (!area) return null;
  const [width, depth] = [area.right - area.left, area.top - area.bottom];
  const group = new Group();
  const ground = new Mesh(new PlaneGeometry(width * 8, depth * 8), new MeshLambertMaterial({ color: colours.ground }));
  ground.position.set((area.left + area.right) / 2, (area.bottom + area.top) / 2, -0.004);
  ground.receiveShadow = true;
  group.add(ground, Grid(area, colours));
  return group;
}

function Grid({ left, right, bottom, top }, colours) {
  const step = kGridStep * Math.max(1, Math.round(Math.max(right - left, top - bottom) / 40));
  const spare = 3 * step;
  const [from, to] = [{ x: Math.floor(left / step) * step - spare, y: Math.floor(bottom / step) * step - spare },
    { x: Math.ceil(right / step) * step + spare, y: Math.ceil(top / step) * step + spare }];
  const places = [];
  for (let x = from.x; x <= to.x + 1e-6; x += step) places.push(x, from.y, 0, x, to.y, 0);
  for (let y = from.y; y <= to.y + 1e-6; y += step) places.push(from.x, y, 0, to.x, y, 0);
  const geometry = new BufferGeometry().setAttribute('position', new Float32BufferAttribute(places, 3));
  return new LineSegments(geometry, new LineBasicMaterial({ color: colours.wallEdge, transparent: true, opacity: 0.22 }));
}

/** Outlines as the map has them: a hole is in those before it. */
export function Obstacles({ outlines = [] }, { colours }) {
  const group = new Group();
  const material = new MeshLambertMaterial({ color: colours.wall });
  const edge = new LineBasicMaterial({ color: colours.wallEdge, transparent: true, opacity: 0.8 });
  for (const { shape, height } of ShapesOf(outlines)) {
    const geometry = new ExtrudeGeometry(shape, { depth: height, bevelEnabled: false, curveSegments: 4 });
    const body = new Mesh(geometry, material);
    body.castShadow = body.receiveShadow = true;
    group.add(body, new LineSegments(new EdgesGeometry(geometry, 28), edge));
  }
  return group;
}

function ShapesOf(outlines) {
  const shapes = [];
  for (const { points, height, is_hole: isHole } of outlines) {
    if (points.length < 3) continue;
    if (!isHole) {
      shapes.push({ shape: Traced(new Shape(), points), points, height: height > 0 ? height : kHeight });
      continue;
    }
    for (const each of shapes) if (IsIn(points[0], each.points)) each.shape.holes.push(Traced(new Path(), points));
  }
  return shapes;
}

function Traced(path, points) {
  points.forEach(({ x, y }, index) => (index === 0 ? path.moveTo(x, y) : path.lineTo(x, y)));
  path.closePath();
  return path;
}

export function IsIn({ x, y }, points) {
  let isIn = false;
  for (let i = 0, j = points.length - 1; i < points.length; j = i++) {
    const [a, b] = [points[i], points[j]];
    if ((a.y > y) !== (b.y > y) && x < ((b.x - a.x) * (y - a.y)) / (b.y - a.y) + a.x) isIn = !isIn;
  }
  return isIn;
}
