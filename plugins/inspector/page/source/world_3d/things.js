// The robot, its goal, and marks.

import { BufferGeometry, CircleGeometry, ConeGeometry, CylinderGeometry, DoubleSide, ExtrudeGeometry, Float32BufferAttribute, Group, LineBasicMaterial,
  LineSegments, Mesh, MeshBasicMaterial, MeshLambertMaterial, RingGeometry, Shape, TorusGeometry } from 'three';

const kRound = 40; // segments of a circle

/** A cylinder on which an arrow says where ahead is, with a turret from which it looks. */
export function Robot(radius, { colours }, isTouching) {
  const group = new Group();
  const height = radius * 1.2;
  const body = Upright(new CylinderGeometry(radius, radius, height, kRound), new MeshLambertMaterial({ color: colours.robotBody }));
  body.position.z = radius * 0.15 + height / 2;
  const skirt = Upright(new CylinderGeometry(radius * 1.03, radius * 1.03, radius * 0.25, kRound),
    new MeshLambertMaterial({ color: isTouching ? colours.hit : colours.robotDark }));
  skirt.position.z = radius * 0.3;
  const arrow = new Shape();
  arrow.moveTo(radius * 0.78, 0);
  arrow.lineTo(-radius * 0.35, radius * 0.5);
  arrow.lineTo(-radius * 0.1, 0);
  arrow.lineTo(-radius * 0.35, -radius * 0.5);
  const sign = new Mesh(new ExtrudeGeometry(arrow, { depth: radius * 0.1, bevelEnabled: false }),
    new MeshLambertMaterial({ color: colours.robotSign }));
  sign.position.z = radius * 0.15 + height;
  const shadow = new Mesh(new CircleGeometry(radius * 1.2, kRound), Flat('#000000', 0.2));
  shadow.position.z = 0.008;
  group.add(shadow, body, skirt, sign);
  return group;
}

/** Where something else believes the robot to be. */
export function OtherPose(radius, { colours }) {
  const ring = new Mesh(new RingGeometry(radius * 1.18, radius * 1.28, kRound), Flat(colours.robot, 0.8));
  ring.position.z = 0.012;
  const group = new Group();
  group.add(ring);
  return group;
}

export function GoalMark({ x, y }, { colours }) {
  if (!Number.isFinite(x) || !Number.isFinite(y)) return null;
  const group = new Group();
  const beam = Upright(new CylinderGeometry(0.09, 0.09, 1.4, kRound, 1, true),
    new MeshBasicMaterial({ color: colours.goal, transparent: true, opacity: 0.22, side: DoubleSide, depthWrite: false }));
  beam.position.z = 0.7;
  const ring = new Mesh(new TorusGeometry(0.2, 0.028, 12, kRound), new MeshLambertMaterial({ color: colours.goal }));
  ring.position.z = 0.03;
  const dot = new Mesh(new CylinderGeometry(0.07, 0.07, 0.03, kRound), new MeshLambertMaterial({ color: colours.goal }));
  dot.rotation.x = Math.PI / 2;
  dot.position.z = 0.02;
  group.add(beam, ring, dot);
  group.position.set(x, y, 0);
  return group;
}

export function HitMarks({ hits = [], leaves = [] }, { colours }) {
  const group = new Group();
  for (const [points, colour, isDown] of [[hits, colours.hit, true], [leaves, colours.leave, false]]) {
    for (const { x, y } of points) {
      const cone = new Mesh(new ConeGeometry(0.09, 0.22, 24), new MeshLambertMaterial({ color: colour }));
      cone.rotation.x = isDown ? -Math.PI / 2 : Math.PI / 2;
      cone.position.set(x, y, isDown ? 0.3 : 0.16);
      group.add(cone);
    }
  }
  return group;
}

/** What a camera sees: {fov, aspect} in radians, from a pose at a height, level. */
export function CameraFrustum({ fov, aspect, reach = 0.9, height = 0.3 }, pose, { colours }) {
  const [side, up] = [Math.tan(fov / 2) * reach, (Math.tan(fov / 2) * reach) / aspect];
  const corners = [[reach, side, up], [reach, -side, up], [reach, -side, -up], [reach, side, -up]];
  const lines = corners.flatMap((corner, index) => [[0, 0, 0], corner, corner, corners[(index + 1) % 4]]);
  const group = new Group();
  group.add(new LineSegments(new BufferGeometry().setAttribute('position', new Float32BufferAttribute(lines.flat(), 3)),
    new LineBasicMaterial({ color: colours.echo })));
  const faces = [0, 1, 2, 3].flatMap((index) => [[0, 0, 0], corners[index], corners[(index + 1) % 4]]);
  group.add(new Mesh(new BufferGeometry().setAttribute('position', new Float32BufferAttribute(faces.flat(), 3)),
    new MeshBasicMaterial({ color: colours.echo, transparent: true, opacity: 0.09, side: DoubleSide, depthWrite: false })));
  group.position.set(pose.x, pose.y, height);
  group.rotation.z = pose.heading;
  return group;
}

/** Cylinders of three.js lie along y; here up is z. */
function Upright(geometry, material) {
  const mesh = new Mesh(geometry, material);
  mesh.rotation.x = Math.PI / 2;
  return mesh;
}

function Flat(color, opacity) {
  return new MeshBasicMaterial({ color, transparent: opacity < 1, opacity, side: DoubleSide, depthWrite: false });
}
