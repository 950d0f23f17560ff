// Where boxes stand: in rows that fit a window, or where somebody has put them; copies, notes, addresses.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ReadAddress, WriteAddress } from '../../../plugins/inspector/page/source/address.js';
import { GraphLayout } from '../../../plugins/inspector/page/source/graph/layout.js';
import { NoteLines } from '../../../plugins/inspector/page/source/graph/measure.js';
import { Pinch } from '../../../plugins/inspector/page/source/graph/pinch.js';
import { CopyOf, Outermost, PasteChanges } from '../../../plugins/inspector/page/source/model/copies.js';
import { Structure } from '../../../plugins/inspector/page/source/model/structure.js';
import { LargeStructure, RobotStructure } from '../mock/mock_structures.mjs';

function Load(told) {
  const structure = new Structure();
  structure.replaceAll({ revision: 1, ...told });
  return structure;
}

const kOpen = () => true;
const kShut = () => false;
const kWindow = { width: 960, height: 720 };

function Overlaps(boxes) {
  const some = [...boxes];
  return some.flatMap((a, index) => some.slice(index + 1).filter((b) =>
    a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height).map((b) => `${a.path} ${b.path}`));
}

const Scale = ({ width, height }) => Math.min(1, kWindow.width / width, kWindow.height / height);

/** A chain of 40 groups. */
function Chain() {
  const told = LargeStructure(40, 2);
  told.connections = told.connections.filter(({ from, to }) => !(from.endsWith('/exit') && to.endsWith('/entry')));
  for (let group = 1; group < 40; ++group) {
    told.connections.push({ from: `/large/group_${group - 1}/exit`, to: `/large/group_${group}/entry`, queue: 0 });
  }
  return Load(told);
}

test('a chain of 40 groups wraps into rows, in reading order, and can be read in a window', () => {
  const line = new GraphLayout().compute(Chain(), kShut);
  const layout = new GraphLayout().compute(Chain(), kShut, { area: kWindow });
  assert.ok(Scale(line) < 0.15, 'one line is too small');
  assert.ok(Scale(layout) > 0.6, `${Scale(layout)}`);
  assert.deepEqual(Overlaps(layout.boxes.values()), []);
  const order = [...layout.boxes.values()].sort((a, b) => (Math.abs(a.y - b.y) < 40 ? a.x - b.x : a.y - b.y)).map(({ path }) => path);
  assert.deepEqual(order, Array.from({ length: 40 }, (_, group) => `/large/group_${group}`));
  assert.equal(layout.edges.length, 39);
  for (const edge of layout.edges) assert.ok(edge.left >= 0 && edge.right <= layout.width, edge.key);
});

test('open groups wrap, too: a thousand modules fill the window and do not overlap', () => {
  for (const told of [LargeStructure(40, 25), LargeStructure(1, 1000)]) {
    const structure = Load(told);
    const { boxes, width, height } = new GraphLayout().compute(structure, kOpen, { area: kWindow });
    const shape = (width / height) / (kWindow.width / kWindow.height);
    assert.ok(shape > 0.45 && shape < 2.2, `${Math.round(width)} x ${Math.round(height)}`);
    const first = structure.membersOf('/large/group_0').map((path) => boxes.get(path));
    assert.deepEqual(Overlaps(first.slice(0, 200)), []);
    const group = boxes.get('/large/group_0');
    for (const box of first) assert.ok(box.x >= group.x && box.x + box.width <= group.x + group.width, box.path);
  }
});

test('a layout that fits is not broken into rows', () => {
  const structure = Load(RobotStructure());
  const wide = new GraphLayout().compute(structure, kOpen, { area: { width: 3000, height: 2000 } });
  const free = new GraphLayout().compute(structure, kOpen);
  assert.deepEqual([...wide.boxes].map(([path, { x, y }]) => [path, x, y]), [...free.boxes].map(([path, { x, y }]) => [path, x, y]));
});

test('boxes stay where they have been put; what is new finds a place; what has grown makes room', () => {
  const told = RobotStructure();
  const structure = Load(told);
  const put = new Map([['/mock/world', { x: 400, y: 80 }], ['/mock/laser', { x: -120, y: 300 }]]);
  const placeOf = (path) => put.get(path);
  const layouter = new GraphLayout();
  const layout = layouter.compute(structure, kShut, { area: kWindow, placeOf });
  for (const [path, place] of put) {
    const { x, y } = layout.boxes.get(path);
    assert.deepEqual({ x, y }, place);
  }
  assert.equal(layout.left, -120);
  assert.deepEqual(Overlaps(layout.boxes.values()), []);
  assert.equal(layout.edges.length, 5);
  put.set('/mock/robot', { x: 400 + layout.boxes.get('/mock/world').width + 20, y: 80 });
  const open = layouter.compute(structure, kOpen, { area: kWindow, placeOf });
  const top = ['/mock/world', '/mock/laser', '/mock/robot'].map((path) => open.boxes.get(path));
  assert.deepEqual(Overlaps(top), []);
});

test('boxes that have all been put far up take no more room than they need', () => {
  const structure = Load(RobotStructure());
  const Height = (up) => new GraphLayout().compute(structure, kShut, { area: kWindow,
    placeOf: (path) => ({ x: 400 * ['/mock/world', '/mock/laser', '/mock/robot'].indexOf(path), y: -up }) }).height;
  assert.equal(Height(2000), Height(0));
});

test('members of a group that have been put somewhere stay within it', () => {
  const structure = Load(RobotStructure());
  const { boxes } = new GraphLayout().compute(structure, kOpen, { placeOf: (path) => (path === '/mock/robot/planner' ? { x: -500, y: -500 } : undefined) });
  const [group, planner] = [boxes.get('/mock/robot'), boxes.get('/mock/robot/planner')];
  assert.ok(planner.x > group.x && planner.y > group.y);
  assert.ok(planner.x + planner.width < group.x + group.width && planner.y + planner.height < group.y + group.height);
});

test('a note makes its box higher, and is cut after some lines', () => {
  const structure = Load(RobotStructure());
  const bare = new GraphLayout().compute(structure, kShut).boxes.get('/mock/laser').height;
  const noted = new GraphLayout().compute(structure, kShut, { noteOf: (path) => (path === '/mock/laser' ? 'from Sick' : undefined) });
  assert.ok(noted.boxes.get('/mock/laser').height > bare);
  assert.deepEqual(NoteLines(''), []);
  assert.deepEqual(NoteLines('one two'), ['one two']);
  assert.equal(NoteLines('word '.repeat(100)).length, 4);
});

test('copies have new names, the values that were set, and the connections between them', () => {
  const told = RobotStructure();
  told.elements.find(({ path }) => path === '/mock/robot/planner/speed').value = '2';
  const structure = Load(told);
  const copy = CopyOf(structure, ['/mock/laser', '/mock/robot', '/mock/robot/planner']);
  assert.deepEqual(copy.roots.map(({ name }) => name), ['laser', 'robot'], 'the planner comes with its group');
  const { changes, paths } = PasteChanges(structure, copy, '/mock');
  assert.deepEqual(paths, ['/mock/laser_2', '/mock/robot_2']);
  const made = changes.filter(({ change }) => change === 'create');
  assert.deepEqual(made.find(({ path }) => path === '/mock/robot_2/planner').settings, { speed: '2' });
  assert.ok(changes.some(({ change, path }) => change === 'create_group' && path === '/mock/robot_2'));
  assert.equal(changes.filter(({ change }) => change === 'create_port').length, 4);
  const wires = changes.filter(({ change }) => change === 'connect').map(({ from, to }) => `${from} ${to}`);
  assert.ok(wires.includes('/mock/laser_2/scan /mock/robot_2/scan'));
  assert.ok(wires.includes('/mock/robot_2/planner/twist /mock/robot_2/twist'));
  assert.ok(!wires.some((wire) => wire.includes('/mock/world')), 'to nobody else');
  assert.deepEqual(Outermost(['/a/b', '/a', '/ab']), ['/a', '/ab']);
});

test('two of the same name from different groups get different ones', () => {
  const structure = Load(LargeStructure(2, 1));
  const copy = CopyOf(structure, ['/large/group_0/filter_0', '/large/group_1/filter_0']);
  const { paths } = PasteChanges(structure, copy, '/large');
  assert.equal(new Set(paths).size, 2, `${paths}`);
});

test('an address says what is looked at, and a broken one is no harm', () => {
  const looked = { chosen: ['/a/b', '/a/c → /a/d'], open: { '/a': true, '/b': false },
    plots: [{ port: '/a/b', field: ['ranges', 3], unit: 'm' }], panels: { tab: 'log', dockOpen: true } };
  assert.deepEqual(ReadAddress(WriteAddress(looked)), looked);
  assert.deepEqual(ReadAddress(''), { chosen: [], open: {}, plots: [], panels: {} });
  assert.deepEqual(ReadAddress('#plot=%5B%22/a&at=x').plots, []);
});

test('two fingers move and enlarge what is between them', () => {
  const pinch = new Pinch();
  assert.equal(pinch.down(1, { x: 100, y: 100 }), false);
  assert.equal(pinch.move(1, { x: 100, y: 100 }), null);
  assert.equal(pinch.down(2, { x: 200, y: 100 }), true);
  const after = pinch.move(2, { x: 300, y: 100 })({ x: 0, y: 0, scale: 1 });
  assert.equal(after.scale, 2);
  pinch.up(1);
  assert.equal(pinch.move(2, { x: 400, y: 100 }), null);
});
