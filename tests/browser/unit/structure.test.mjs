import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Structure, ThreadOf } from '../../../plugins/inspector/page/source/model/structure.js';
import { OriginsOf } from '../../../plugins/inspector/page/source/model/origin.js';
import { Connectable, Partners } from '../../../plugins/inspector/page/source/model/compatibility.js';
import { FindElements } from '../../../plugins/inspector/page/source/model/element_search.js';
import { RobotStructure } from '../mock/mock_structures.mjs';

function Robot() {
  const structure = new Structure();
  structure.replaceAll({ revision: 1, ...RobotStructure() });
  return structure;
}

test('a structure knows its members, ports and parameters, and leaves out what holds threads', () => {
  const structure = Robot();
  assert.equal(structure.root, '/mock');
  assert.deepEqual(structure.membersOf('/mock'), ['/mock/world', '/mock/laser', '/mock/robot']);
  assert.deepEqual(structure.portsOf('/mock/robot').map((port) => port.name), ['scan', 'pose', 'goal', 'twist']);
  assert.deepEqual(structure.parametersOf('/mock/world').map((parameter) => parameter.name), ['goal_x', 'goal_y']);
});

test('a group that holds threads only has no box, whether the server calls it plain or not', () => {
  const structure = new Structure();
  structure.replaceAll({ revision: 1, connections: [], elements: [{ path: '/a', kind: 'application' },
    { path: '/a/threads', kind: 'group' }, { path: '/a/threads/t', kind: 'thread' }, { path: '/a/empty', kind: 'group' }] });
  assert.deepEqual(structure.membersOf('/a'), ['/a/empty']);
});

test('a change takes out what is gone with all in it, its connections too', () => {
  const structure = Robot();
  structure.change({ revision: 2, gone: ['/mock/robot'] });
  assert.equal(structure.get('/mock/robot/planner/twist'), undefined);
  assert.deepEqual(structure.membersOf('/mock'), ['/mock/world', '/mock/laser']);
  assert.deepEqual([...structure.connections.values()].map(({ to }) => to), ['/mock/laser/pose']);
  assert.equal(structure.revision, 2);
});

test('an element that is told again keeps its place and its children', () => {
  const structure = Robot();
  structure.change({ revision: 2, elements: [{ path: '/mock/robot', kind: 'group', thread: 'slow' }] });
  assert.deepEqual(structure.membersOf('/mock'), ['/mock/world', '/mock/laser', '/mock/robot']);
  assert.deepEqual(structure.membersOf('/mock/robot'), ['/mock/robot/planner']);
  assert.equal(ThreadOf(structure, '/mock/robot/planner'), 'slow');
  assert.equal(ThreadOf(structure, '/mock/laser'), 'control');
});

test('an element that is told again is what is told of it: what is left out is not so any more', () => {
  const structure = Robot();
  const told = structure.get('/mock/robot/planner');
  structure.change({ revision: 2, elements: [{ ...told, paused: true, tags: 'safety', children: undefined }] });
  assert.equal(structure.get(told.path).paused, true);
  const { children, name, ...plain } = told;
  structure.change({ revision: 3, elements: [plain] });
  assert.deepEqual(structure.get(told.path), told);
  assert.ok(!('paused' in structure.get(told.path)) && !('tags' in structure.get(told.path)));
});

test('connections come and go', () => {
  const structure = Robot();
  const ends = { from: '/mock/robot/planner/twist', to: '/mock/robot/twist' };
  structure.change({ revision: 2, disconnected: [ends] });
  assert.deepEqual(structure.connectionsOf(ends.to).map(({ to }) => to), ['/mock/world/twist']);
  structure.change({ revision: 3, connected: [{ ...ends, queue: 3 }] });
  assert.equal(structure.connectionsOf(ends.from)[0].queue, 3);
});

test('the origin of a port of a group is the output that feeds it, and its readers are inputs', () => {
  const structure = Robot();
  assert.deepEqual(OriginsOf(structure, '/mock/robot/twist'), ['/mock/robot/planner/twist']);
  assert.deepEqual(OriginsOf(structure, '/mock/robot/planner/scan'), ['/mock/laser/scan']);
});

test('connections in a circle of groups do not hang the search for an origin', () => {
  const structure = new Structure();
  const port = (path, owner, direction) => ({ path, owner, direction, kind: 'port', data_type: 'double' });
  structure.replaceAll({ revision: 1, elements: [{ path: '/a', kind: 'application' }, { path: '/a/g', kind: 'group' },
    port('/a/g/in', '/a/g', 'input'), port('/a/g/out', '/a/g', 'output')],
  connections: [{ from: '/a/g/in', to: '/a/g/out' }, { from: '/a/g/out', to: '/a/g/in' }] });
  assert.deepEqual(OriginsOf(structure, '/a/g/in'), []);
});

test('only ports of one type and of opposite directions can be connected, in whatever order they are named', () => {
  const structure = Robot();
  structure.change({ revision: 2, disconnected: [{ from: '/mock/world/pose', to: '/mock/laser/pose' }] });
  const ends = { from: '/mock/world/pose', to: '/mock/laser/pose' };
  assert.deepEqual(Connectable(structure, ends.from, ends.to), ends);
  assert.deepEqual(Connectable(structure, ends.to, ends.from), ends);
  assert.equal(Connectable(structure, '/mock/world/goal', '/mock/laser/pose'), null, 'other types');
  assert.equal(Connectable(structure, '/mock/world/pose', '/mock/world/pose'), null, 'itself');
  assert.equal(Connectable(structure, '/mock/laser/pose', '/mock/robot/planner/pose'), null, 'two inputs');
});

test('what is connected already is not offered', () => {
  assert.equal(Connectable(Robot(), '/mock/world/pose', '/mock/laser/pose'), null);
});

test('a port of a group takes values outside and gives them inside', () => {
  const structure = Robot();
  structure.change({ revision: 2, disconnected: [{ from: '/mock/robot/pose', to: '/mock/robot/planner/pose' },
    { from: '/mock/world/pose', to: '/mock/robot/pose' }] });
  const inside = { from: '/mock/robot/pose', to: '/mock/robot/planner/pose' };
  assert.deepEqual(Connectable(structure, '/mock/robot/planner/pose', '/mock/robot/pose'), inside);
  assert.deepEqual(Connectable(structure, '/mock/robot/pose', '/mock/world/pose'), { from: '/mock/world/pose', to: '/mock/robot/pose' });
  const partners = Partners(structure, '/mock/world/pose').map(({ port }) => port.path).sort();
  assert.deepEqual(partners, ['/mock/robot/planner/pose', '/mock/robot/pose']);
});

test('a search finds the exact name before names that have it in them, modules before ports', () => {
  const structure = Robot();
  const paths = (text) => FindElements(structure, text, 5).map((element) => element.path);
  assert.equal(paths('planner')[0], '/mock/robot/planner');
  assert.equal(paths('goal')[0], '/mock/world/goal');
  assert.deepEqual(paths('robot planner speed'), ['/mock/robot/planner/speed']);
  assert.deepEqual(paths('nothing like it'), []);
});
