import assert from 'node:assert/strict';
import { test } from 'node:test';
import { AlarmsOf, CountByElement } from '../../../plugins/inspector/page/source/model/alarms.js';
import { WhyNot } from '../../../plugins/inspector/page/source/model/compatibility.js';
import { ConsequencesOf } from '../../../plugins/inspector/page/source/model/consequences.js';
import { Structure } from '../../../plugins/inspector/page/source/model/structure.js';
import { Silence } from '../../../plugins/inspector/page/source/state/silence.js';
import { RobotStructure } from '../mock/mock_structures.mjs';

function Robot(change = () => {}) {
  const told = RobotStructure();
  change(told);
  const structure = new Structure();
  structure.replaceAll({ revision: 1, ...told });
  return structure;
}

const Paths = (elements) => elements.map((element) => element.path).sort();

test('what feeds a required input is missed by it, through the ports of groups', () => {
  const lost = ConsequencesOf(Robot(), { gone: ['/mock/robot/planner'] });
  assert.deepEqual(Paths(lost.inputs), ['/mock/world/twist']);
  assert.deepEqual(lost.dependents, ['/mock/laser'], 'the world gives the laser its pose; what is gone is not told');
  assert.equal(lost.isGrave, true);
  assert.deepEqual(Paths(ConsequencesOf(Robot(), { gone: ['/mock/robot'] }).inputs), ['/mock/world/twist'], 'what is in it goes, too');
});

test('a connection that goes leaves only its own input without a source', () => {
  const { inputs } = ConsequencesOf(Robot(), { cut: [{ from: '/mock/robot/scan', to: '/mock/robot/planner/scan' }] });
  assert.deepEqual(Paths(inputs), ['/mock/robot/planner/scan']);
});

test('nothing follows where another source stays, where nobody listens, and where nothing was', () => {
  const twice = Robot((told) => told.connections.push({ from: '/mock/world/pose', to: '/mock/robot/planner/pose', queue: 0 }));
  assert.equal(ConsequencesOf(twice, { cut: [{ from: '/mock/world/pose', to: '/mock/robot/pose' }] }).isGrave, false);
  const open = Robot((told) => { told.connections = told.connections.filter(({ to }) => to !== '/mock/world/twist'); });
  assert.equal(ConsequencesOf(open, { gone: ['/mock/robot/planner'] }).isGrave, false);
});

test('an input that is not required matters if its module has no other source, and others need that', () => {
  const told = (others) => Robot((robot) => {
    robot.elements.find(({ path }) => path === '/mock/robot/planner/scan').required = false;
    if (!others) robot.connections = robot.connections.filter(({ to }) => !/planner\/(pose|goal)$/.test(to));
  });
  const cut = [{ from: '/mock/robot/scan', to: '/mock/robot/planner/scan' }];
  assert.equal(ConsequencesOf(told(true), { cut }).isGrave, false);
  const { isGrave, dependents } = ConsequencesOf(told(false), { cut });
  assert.equal(isGrave, true);
  assert.ok(dependents.includes('/mock/world'));
});

test('alarms: failed modules, required inputs without a source, outputs that have fallen silent', () => {
  const structure = Robot((told) => {
    told.elements.find(({ path }) => path === '/mock/laser').failure = 'sensor gone';
    told.connections = told.connections.filter(({ to }) => to !== '/mock/robot/goal');
  });
  const alarms = AlarmsOf(structure, new Map([['/mock/world/pose', 12], ['/mock/world/map', 3]]));
  assert.deepEqual(alarms.map(({ kind, path }) => `${kind} ${path}`), ['failed /mock/laser', 'unconnected /mock/robot/planner/goal',
    'silent /mock/world/pose'], 'nobody misses the map');
  const counts = CountByElement(alarms);
  assert.equal(counts.get('/mock'), 3);
  assert.equal(counts.get('/mock/robot'), 1);
  assert.equal(counts.get('/mock/robot/planner/goal'), 1);
});

test('alarms: a module that does not return is told by name, and not as one that has failed', () => {
  const structure = Robot((told) => {
    Object.assign(told.elements.find(({ path }) => path === '/mock/laser'), { failure: 'has not returned from its cycle for 1s', stuck: true });
  });
  const [{ kind, owner, text }] = AlarmsOf(structure, new Map());
  assert.deepEqual([kind, owner, text], ['stuck', '/mock/laser', 'is stuck: it has not returned from its cycle for 1s']);
});

test('silent is what has published steadily and does so no more; an empty window is none', () => {
  const silence = new Silence();
  silence.note({ '/steady': 20, '/once': 1, '/slow': 2 }, 0);
  silence.note({ '/once': 0 }, 0.5);
  silence.note({ '/steady': 0, '/slow': 0 }, 5);
  silence.note({ '/slow': 2 }, 5.5);
  assert.equal(silence.silent.size, 0);
  const before = silence.silent;
  silence.note({}, 7);
  assert.deepEqual([...silence.silent], [['/steady', 5]]);
  assert.notEqual(silence.silent, before, 'another object, so that views see it');
  silence.note({ '/steady': 20 }, 8);
  assert.equal(silence.silent.size, 0);
});

test('why two ports cannot be connected is said in their words', () => {
  const structure = Robot();
  assert.equal(WhyNot(structure, '/mock/laser/scan', '/mock/robot/pose'), 'laser/scan gives RangeScan, robot/pose takes Pose2');
  assert.equal(WhyNot(structure, '/mock/robot/pose', '/mock/laser/scan'), 'laser/scan gives RangeScan, robot/pose takes Pose2');
  assert.match(WhyNot(structure, '/mock/laser/pose', '/mock/robot/pose'), /^both .* take values$/);
  assert.match(WhyNot(structure, '/mock/laser/scan', '/mock/world/pose'), /^both .* give values$/);
  assert.match(WhyNot(structure, '/mock/laser/scan', '/mock/robot/scan'), /connected already$/);
  assert.equal(WhyNot(structure, '/mock/world/pose', '/mock/robot/planner/pose'), '');
});
