import assert from 'node:assert/strict';
import { test } from 'node:test';
import { GraphLayout } from '../../../plugins/inspector/page/source/graph/layout.js';
import { ClosingEdges, PlaceOf } from '../../../plugins/inspector/page/source/graph/levels.js';
import { FitView, ShowBox, ToGraph, VisibleArea, ZoomAt } from '../../../plugins/inspector/page/source/graph/viewport.js';
import { Structure } from '../../../plugins/inspector/page/source/model/structure.js';
import { LargeStructure, RobotStructure } from '../mock/mock_structures.mjs';

function Load(told) {
  const structure = new Structure();
  structure.replaceAll({ revision: 1, ...told });
  return structure;
}

const robot = () => Load(RobotStructure());
const kOpen = () => true;
const kShut = () => false;

function Overlap(a, b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

test('boxes of one level do not overlap, and members lie within their group', () => {
  const { boxes } = new GraphLayout().compute(robot(), kOpen);
  const top = ['/mock/world', '/mock/laser', '/mock/robot'].map((path) => boxes.get(path));
  for (const a of top) for (const b of top) if (a !== b) assert.ok(!Overlap(a, b), `${a.path} ${b.path}`);
  const [group, planner] = [boxes.get('/mock/robot'), boxes.get('/mock/robot/planner')];
  assert.ok(planner.x > group.x && planner.y > group.y);
  assert.ok(planner.x + planner.width < group.x + group.width && planner.y + planner.height < group.y + group.height);
});

test('data flows from left to right, and back in a lane below', () => {
  const { boxes, edges } = new GraphLayout().compute(robot(), kOpen);
  assert.ok(boxes.get('/mock/world').x < boxes.get('/mock/laser').x);
  assert.ok(boxes.get('/mock/laser').x < boxes.get('/mock/robot').x);
  const back = edges.find((edge) => edge.to === '/mock/world/twist');
  const passed = [...boxes.values()].filter((box) => box.x < back.right && box.x + box.width > back.left);
  assert.equal(passed.length, boxes.size);
  assert.ok(back.bottom > Math.max(...passed.map((box) => box.y + box.height)));
});

test('each connection that can be seen is drawn once, from port to port', () => {
  const structure = robot();
  const { edges, ports } = new GraphLayout().compute(structure, kOpen);
  assert.deepEqual(edges.map((edge) => edge.key).sort(), [...structure.connections.keys()].sort());
  for (const edge of edges) {
    const place = ports.get(edge.from);
    assert.ok(Math.abs(place.y - edge.start.y) < 0.01, edge.key);
  }
});

test('a folded group hides its members and the connections in it', () => {
  const { boxes, edges } = new GraphLayout().compute(robot(), kShut);
  assert.deepEqual([...boxes.keys()], ['/mock/world', '/mock/laser', '/mock/robot']);
  assert.equal(boxes.get('/mock/robot').hidden, 1);
  assert.equal(edges.length, 5);
});

test('a connection belongs to the innermost group that holds both ends', () => {
  const structure = robot();
  assert.deepEqual(PlaceOf(structure, { from: '/mock/world/pose', to: '/mock/laser/pose' }),
    { level: '/mock', source: '/mock/world', target: '/mock/laser' });
  assert.deepEqual(PlaceOf(structure, { from: '/mock/robot/pose', to: '/mock/robot/planner/pose' }),
    { level: '/mock/robot', source: '@in', target: '/mock/robot/planner' });
  assert.deepEqual(PlaceOf(structure, { from: '/mock/world/pose', to: '/mock/robot/planner/pose' }),
    { level: '/mock', source: '/mock/world', target: '/mock/robot' });
});

test('what a group gives back to itself runs around it, whether it is open or not', () => {
  const told = RobotStructure();
  told.elements.push({ ...told.elements.find(({ path }) => path === '/mock/robot/twist'), path: '/mock/robot/before', name: 'before', direction: 'input' });
  told.connections.push({ from: '/mock/robot/twist', to: '/mock/robot/before' });
  const structure = Load(told);
  assert.deepEqual(PlaceOf(structure, told.connections.at(-1)), { level: '/mock', source: '/mock/robot', target: '/mock/robot' });
  for (const isOpen of [kOpen, kShut]) {
    const { boxes, edges } = new GraphLayout().compute(structure, isOpen);
    const box = boxes.get('/mock/robot');
    const loop = edges.find(({ to }) => to === '/mock/robot/before');
    assert.ok(loop.left < box.x && loop.right > box.x + box.width);
  }
  const through = { from: '/mock/robot/before', to: '/mock/robot/twist' };
  assert.deepEqual(PlaceOf(structure, through), { level: '/mock/robot', source: '@in', target: '@out' });
});

// STOP is sent by the thread that computes it.
test('connections that pass many boxes do not hold the page up', () => {
  const root = '/long';
  const at = (number) => `${root}/m${number}`;
  const elements = [{ path: root, kind: 'application' }];
  const connections = [];
  for (let number = 0; number < 140; ++number) {
    elements.push({ path: at(number), kind: 'module', type: 'long' });
    for (const [name, direction] of [['in', 'input'], ['out', 'output']]) {
      elements.push({ path: `${at(number)}/${name}`, kind: 'port', name, direction, data_type: 'double', owner: at(number) });
    }
    for (const before of [number - 1, Math.floor(number / 2), Math.floor(number / 3)]) {
      if (before >= 0 && before < number) connections.push({ from: `${at(before)}/out`, to: `${at(number)}/in` });
    }
  }
  const begin = process.cpuUsage();
  const { edges } = new GraphLayout().compute(Load({ elements, connections }), kOpen, { area: { width: 1200, height: 800 } });
  const { user, system } = process.cpuUsage(begin);
  assert.equal(new Set(edges.map(({ key }) => key)).size, new Set(connections.map(({ from, to }) => `${from} ${to}`)).size);
  assert.ok(user + system < 1.5e6, `${(user + system) / 1e6} s of computing`);
});

test('a connection past the border of a group is drawn, whether the group is open or not', () => {
  const told = RobotStructure();
  told.connections.push({ from: '/mock/world/goal', to: '/mock/robot/planner/goal', queue: 0 });
  const structure = Load(told);
  const key = '/mock/world/goal → /mock/robot/planner/goal';
  for (const isOpen of [kOpen, kShut]) {
    const { edges, boxes } = new GraphLayout().compute(structure, isOpen);
    const found = edges.filter((edge) => edge.key === key);
    assert.equal(found.length, 1);
    const target = boxes.get('/mock/robot/planner') ?? boxes.get('/mock/robot');
    assert.equal(found[0].end.x, target.x);
  }
});

test('of a circle one edge closes it, the one back to where the walk began', () => {
  const edges = [['a', 'b'], ['b', 'c'], ['c', 'a'], ['b', 'd']].map(([source, target]) => ({ source, target }));
  assert.deepEqual([...ClosingEdges(['a', 'b', 'c', 'd'], edges)], ['c a']);
  assert.deepEqual([...ClosingEdges(['a'], [{ source: 'a', target: 'a' }])], ['a a']);
});

test('levels that have not changed are not laid out again', () => {
  const structure = robot();
  const layouter = new GraphLayout();
  const before = layouter.compute(structure, kOpen).boxes.get('/mock/robot').level;
  structure.change({ revision: 2, disconnected: [{ from: '/mock/world/pose', to: '/mock/laser/pose' }] });
  const after = layouter.compute(structure, kOpen);
  assert.equal(after.boxes.get('/mock/robot').level, before);
  assert.equal(after.edges.length, structure.connections.size);
});

test('a thousand modules: folded only their groups are laid out, open all of them are, none over another', () => {
  const structure = Load(LargeStructure(40, 25));
  const layouter = new GraphLayout();
  assert.equal(layouter.compute(structure, kShut).boxes.size, 40);
  const { boxes, edges } = layouter.compute(structure, kOpen);
  assert.equal(boxes.size, 1040);
  assert.equal(edges.length, structure.connections.size);
  const inner = structure.membersOf('/large/group_3').map((path) => boxes.get(path));
  for (const a of inner) for (const b of inner) if (a !== b) assert.ok(!Overlap(a, b), `${a.path} ${b.path}`);
});

test('a thousand modules in one group are laid out too, without overlap', () => {
  const structure = Load(LargeStructure(1, 1000));
  const { boxes } = new GraphLayout().compute(structure, kOpen);
  const inner = structure.membersOf('/large/group_0').map((path) => boxes.get(path)).sort((a, b) => a.x - b.x);
  assert.equal(inner.length, 1000);
  for (let i = 0; i < inner.length; ++i) {
    for (let j = i + 1; j < inner.length && inner[j].x < inner[i].x + inner[i].width; ++j) {
      assert.ok(!Overlap(inner[i], inner[j]), `${inner[i].path} ${inner[j].path}`);
    }
  }
});

test('an application without anything has no boxes', () => {
  assert.equal(new GraphLayout().compute(new Structure(), kOpen).boxes.size, 0);
  const alone = Load({ elements: [{ path: '/a', kind: 'application' }], connections: [] });
  assert.equal(new GraphLayout().compute(alone, kOpen).boxes.size, 0);
});

test('zooming leaves the place under the pointer where it is', () => {
  const view = { x: 30, y: -20, scale: 0.7 };
  const point = { x: 200, y: 120 };
  const before = ToGraph(view, point);
  const after = ToGraph(ZoomAt(view, point, 1.6), point);
  assert.ok(Math.abs(before.x - after.x) < 1e-9 && Math.abs(before.y - after.y) < 1e-9);
});

test('what is fitted is on the screen, and never larger than life', () => {
  const size = { width: 800, height: 600 };
  const area = { x: 0, y: 0, width: 4000, height: 500 };
  const shown = VisibleArea(FitView(area, size), size, 0);
  assert.ok(shown.left <= 0 && shown.right >= 4000 && shown.top <= 0 && shown.bottom >= 500);
  assert.equal(FitView({ x: 0, y: 0, width: 10, height: 10 }, size).scale, 1);
});

test('a box that is on the screen does not move the view, another one does', () => {
  const size = { width: 800, height: 600 };
  const view = { x: 0, y: 0, scale: 1 };
  assert.deepEqual(ShowBox(view, size, { x: 100, y: 100, width: 50, height: 50 }), view);
  const moved = ShowBox(view, size, { x: 1000, y: 100, width: 50, height: 50 });
  assert.equal(moved.x, -(1050 - 760));
});
