// Other applications in the network, as the structure shows them.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { NetworkElements } from '../../../plugins/inspector/page/source/model/network.js';
import { LacksSource } from '../../../plugins/inspector/page/source/model/alarms.js';
import { Structure } from '../../../plugins/inspector/page/source/model/structure.js';

const kPort = { kind: 'port', data_type: 'Twist2', interface: false, awaits: [] };

function Robot() {
  const structure = new Structure();
  structure.replaceAll({ revision: 1, connections: [], elements: [
    { path: '/robot', kind: 'application', name: 'robot' },
    { path: '/robot/gate', kind: 'module', name: 'gate' },
    { ...kPort, path: '/robot/gate/input/wanted', owner: '/robot/gate', direction: 'input', name: 'wanted' },
    { ...kPort, path: '/robot/gate/output/allowed', owner: '/robot/gate', direction: 'output', name: 'allowed' },
    { path: '/robot/network', kind: 'group', name: 'network' },
    { path: '/robot/network/planner', kind: 'group', name: 'planner' },
    { ...kPort, path: '/robot/network/planner/twist', owner: '/robot/network/planner', direction: 'output', name: 'twist' },
  ] });
  return structure;
}

const kNetwork = {
  name: 'robot', element: '/robot/network',
  offers: [{ port: '/robot/gate/output/allowed', topic: '/robot/gate/allowed', readers: ['planner'], misfit: null }],
  takes: [{ port: '/robot/network/planner/twist', topic: '/planner/twist', writers: ['planner'], misfit: null, is_wanted: true, owner: null }],
  applications: [{ name: 'planner', delay: 0.0002, is_simulated: false, structure: null, offers: [{ topic: '/planner/twist', type: 'Twist2' }, { topic: '/planner/status', type: 'Status' }] }],
};
const Show = (structure, network) => structure.cover((bare) => NetworkElements(bare, network), network?.element);

test('an application is a box with what is offered and what is connected', () => {
  const structure = Robot();
  assert.equal(Show(structure, kNetwork), true);
  assert.deepEqual(structure.membersOf('/robot'), ['/robot/gate', '/robot/@planner']);
  assert.deepEqual(structure.portsOf('/robot/@planner').map(({ path, name, state }) => [path, name, state]),
    [['/robot/network/planner/twist', 'twist', 'connected'], ['//planner/status', 'status', 'offered']]);
  assert.deepEqual(structure.get('/robot/gate/output/allowed').offers.map(({ topic }) => topic), ['/robot/gate/allowed']);
  assert.equal(Show(structure, kNetwork), false, 'the same picture');
});

test('an input that another application feeds does not lack a source', () => {
  const structure = Robot();
  const gate = { ...kPort, path: '/robot/gate/input/wanted', owner: '/robot/gate', direction: 'input', name: 'wanted', required: true };
  structure.change({ revision: 2, elements: [gate] });
  Show(structure, kNetwork);
  assert.equal(LacksSource(structure, structure.get(gate.path)), true);
  structure.change({ revision: 3, connected: [{ from: '/robot/network/planner/twist', to: gate.path }] });
  Show(structure, kNetwork);
  assert.equal(LacksSource(structure, structure.get(gate.path)), false);
});

test('who is waited for is shown, and all is as before when the network has gone', () => {
  const structure = Robot();
  Show(structure, { ...kNetwork, applications: [], takes: [{ ...kNetwork.takes[0], writers: [] }] });
  assert.equal(structure.get('/robot/@planner').is_there, false);
  assert.equal(structure.get('/robot/network/planner/twist').state, 'waiting');
  structure.change({ revision: 2, elements: [{ ...kPort, path: '/robot/network/planner/twist', owner: '/robot/network/planner', direction: 'output', name: 'twist', by_hand: true }] });
  Show(structure, null);
  assert.deepEqual(structure.membersOf('/robot'), ['/robot/gate', '/robot/network']);
  assert.deepEqual(structure.portsOf('/robot/network/planner').map(({ path, by_hand }) => [path, by_hand]), [['/robot/network/planner/twist', true]]);
  assert.equal(structure.get('/robot/gate/output/allowed').offers, undefined);
});

test('who is waited for by a part of what they may offer is shown, too', () => {
  const structure = Robot();
  const awaited = { from: '//scout/pose.x', to: '/robot/gate/input/wanted', why: 'scout is not in the network yet' };
  const more = { from: '//planner/status.items[3].x', to: '/robot/gate/input/wanted', why: 'its type is not known' };
  structure.change({ revision: 2, elements: [{ ...kPort, path: '/robot/gate/input/wanted', owner: '/robot/gate', direction: 'input', name: 'wanted', awaits: [awaited, more] }] });
  Show(structure, kNetwork);
  assert.equal(structure.get('/robot/@scout').is_there, false);
  assert.deepEqual(structure.portsOf('/robot/@scout').map(({ path, name, state, awaits }) => [path, name, state, awaits]), [['//scout/pose', 'pose', 'waiting', [awaited]]]);
  assert.deepEqual(structure.get('//planner/status').awaits, [more]);
  assert.equal(LacksSource(structure, { ...structure.get('/robot/gate/input/wanted'), required: true }), false);
});

test('topics of nodes have a box of their own', () => {
  const structure = Robot();
  Show(structure, { ...kNetwork, takes: [], applications: [{ name: null, delay: null, structure: null, offers: [{ topic: '/base/scan', type: 'sensor_msgs/msg/LaserScan' }] }] });
  assert.deepEqual(structure.portsOf('/robot/@topics').map(({ path, name }) => [path, name]), [['//base/scan', 'base/scan']]);
});

test('an other type is told', () => {
  const structure = Robot();
  Show(structure, { ...kNetwork, takes: [{ ...kNetwork.takes[0], writers: [], misfit: 'planner: another type' }] });
  assert.equal(structure.get('/robot/network/planner/twist').state, 'does not fit');
});
