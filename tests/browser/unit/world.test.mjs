import assert from 'node:assert/strict';
import { test } from 'node:test';
import { AreaOf, FitCamera, GridStep, ToCanvas, ToWorld, ZoomCamera } from '../../../plugins/inspector/page/source/world/camera.js';
import { DrawItems } from '../../../plugins/inspector/page/source/world/draw.js';
import { ScanEnds, SeenFrom } from '../../../plugins/inspector/page/source/world/scan_geometry.js';
import { FindLayers, RobotRadius } from '../../../plugins/inspector/page/source/world/layers.js';
import { Catalogue } from '../../../plugins/inspector/page/source/model/catalogue.js';
import { Structure } from '../../../plugins/inspector/page/source/model/structure.js';
import { RobotStructure, kCatalogue } from '../mock/mock_structures.mjs';

const catalogue = new Catalogue(kCatalogue);
const size = { width: 400, height: 300 };

function Robot() {
  const structure = new Structure();
  structure.replaceAll({ revision: 1, ...RobotStructure() });
  return structure;
}

test('layers are the outputs of modules whose types have a meaning, the map at the bottom', () => {
  const { layers, pose } = FindLayers(Robot(), catalogue);
  assert.deepEqual(layers.map(({ port }) => port), ['/mock/world/map', '/mock/laser/scan', '/mock/world/goal', '/mock/world/pose']);
  assert.equal(pose, '/mock/world/pose');
});

test('what another application has is drawn as what modules have, and not once more where it leaves a group', () => {
  const structure = Robot();
  const port = { kind: 'port', direction: 'output', data_type: 'RangeScan', name: 'scan' };
  structure.change({ revision: 2, elements: [{ path: '/mock/network', kind: 'group' }, { path: '/mock/eyes', kind: 'group' },
    { ...port, path: '/mock/network/scan', owner: '/mock/network', interface: false },
    { ...port, path: '/mock/eyes/scan', owner: '/mock/eyes', interface: true }] });
  const scans = FindLayers(structure, catalogue).layers.filter(({ meaning }) => meaning === 'range_scan');
  assert.deepEqual(scans.map(({ port: path }) => path), ['/mock/laser/scan', '/mock/network/scan']);
});

test('of hundreds of scans only a few are shown at first', () => {
  const structure = Robot();
  for (let i = 0; i < 20; ++i) {
    const owner = `/mock/laser_${i}`;
    structure.change({ revision: 2 + i, elements: [{ path: owner, kind: 'module' }, { path: `${owner}/scan`, kind: 'port',
      name: 'scan', direction: 'output', data_type: 'RangeScan', owner }] });
  }
  const { layers } = FindLayers(structure, catalogue);
  const scans = layers.filter(({ meaning }) => meaning === 'range_scan');
  assert.equal(scans.length, 21);
  assert.deepEqual(scans.filter(({ atFirst }) => atFirst).map(({ port }) => port), ['/mock/laser/scan', '/mock/laser_0/scan', '/mock/laser_1/scan']);
});

test('a scan is seen from the pose that its module is told', () => {
  const { layers } = FindLayers(Robot(), catalogue);
  assert.equal(layers.find(({ meaning }) => meaning === 'range_scan').pose, '/mock/world/pose');
});

test('a point can be dragged if its module has settable parameters for it', () => {
  const structure = Robot();
  const goal = () => FindLayers(structure, catalogue).layers.find(({ meaning }) => meaning === 'point').goal;
  assert.deepEqual(goal(), { x: '/mock/world/goal_x', y: '/mock/world/goal_y', name: 'goal of world' });
  const fixed = { ...structure.get('/mock/world/goal_x'), settable: false };
  structure.change({ revision: 2, elements: [fixed] });
  assert.equal(goal(), null);
});

test('the robot is as large as a parameter of its module says', () => {
  const structure = Robot();
  assert.equal(RobotRadius(structure, '/mock/world/pose'), 0.15);
  structure.change({ revision: 2, elements: [{ path: '/mock/world/robot_radius', kind: 'parameter', name: 'robot_radius',
    unit: 'm', value: '0.4', owner: '/mock/world' }] });
  assert.equal(RobotRadius(structure, '/mock/world/pose'), 0.4);
});

test('the camera and its inverse agree, y is up', () => {
  const camera = { x: 1, y: 2, scale: 50 };
  const place = ToWorld(camera, size, ToCanvas(camera, size, { x: 3.5, y: -1 }));
  assert.ok(Math.abs(place.x - 3.5) < 1e-9 && Math.abs(place.y + 1) < 1e-9);
  assert.ok(ToCanvas(camera, size, { x: 0, y: 5 }).y < ToCanvas(camera, size, { x: 0, y: 4 }).y);
});

test('zooming the world leaves the place under the pointer where it is', () => {
  const camera = { x: 1, y: 2, scale: 50 };
  const point = { x: 10, y: 250 };
  const before = ToWorld(camera, size, point);
  const after = ToWorld(ZoomCamera(camera, size, point, 2), size, point);
  assert.ok(Math.hypot(before.x - after.x, before.y - after.y) < 1e-9);
});

test('an area is fitted whole; points that are no numbers do not count', () => {
  const area = AreaOf([{ x: -2, y: 0 }, { x: NaN, y: 7 }, { x: 6, y: 3 }]);
  assert.deepEqual(area, { left: -2, right: 6, bottom: 0, top: 3 });
  const camera = FitCamera(area, size);
  for (const corner of [{ x: -2, y: 0 }, { x: 6, y: 3 }]) {
    const { x, y } = ToCanvas(camera, size, corner);
    assert.ok(x >= 0 && x <= size.width && y >= 0 && y <= size.height);
  }
  assert.equal(AreaOf([]), null);
});

test('a grid has round distances', () => {
  assert.equal(GridStep(40), 1);
  assert.equal(GridStep(400, 28), 0.1);
  assert.equal(GridStep(2), 20);
});

test('rays end where they meet something, or as far as the laser sees', () => {
  const scan = { start_angle: 0, angle_step: Math.PI / 2, range_minimum: 0.1, range_maximum: 4, ranges: [1, Infinity, 5, 0.01] };
  const ends = ScanEnds(scan, { x: 1, y: 1, heading: 0 });
  assert.deepEqual(ends.map(({ isEcho }) => isEcho), [true, false, false, false]);
  assert.ok(Math.abs(ends[0].x - 2) < 1e-9 && Math.abs(ends[0].y - 1) < 1e-9);
  assert.ok(Math.abs(ends[1].y - 5) < 1e-9, 'nothing seen: the whole range');
});

test('what is drawn as seen from the robot lies where the robot is', () => {
  const { x, y } = SeenFrom({ x: 1, y: 2, heading: Math.PI / 2 }, { x: 3, y: 1 });
  assert.ok(Math.abs(x - 0) < 1e-9 && Math.abs(y - 5) < 1e-9);
});

test('a drawing is drawn item by item, and not without the pose that it is seen from', () => {
  const calls = [];
  const context = new Proxy({}, { set: () => true, get: (_, name) => (...args) => calls.push([name, ...args]) });
  const drawing = { context, camera: { x: 0, y: 0, scale: 10 }, size };
  const colour = { red: 1, green: 0, blue: 0, alpha: 1 };
  const items = [
    { kind: 'points', points: [{ x: 0, y: 0 }, { x: 1, y: 0 }], colour, size: 0.1, text: '' },
    { kind: 'closed_line', points: [{ x: 0, y: 0 }, { x: 1, y: 0 }], colour, size: 0.1, text: '' },
    { kind: 'text', points: [{ x: 0, y: 0 }], colour, size: 1, text: 'near' },
    { kind: 'line', points: [], colour, size: 1, text: '' }];
  DrawItems(drawing, { frame: 'robot', items }, null);
  assert.equal(calls.length, 0);
  DrawItems(drawing, { frame: '', items }, null);
  const count = (name) => calls.filter(([called]) => called === name).length;
  assert.deepEqual([count('arc'), count('closePath'), count('stroke'), count('fillText')], [2, 1, 1, 1]);
});
