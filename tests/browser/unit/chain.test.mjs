import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ChainBetween } from '../../../plugins/inspector/page/source/model/chain.js';
import { Structure } from '../../../plugins/inspector/page/source/model/structure.js';
import { RobotStructure } from '../mock/mock_structures.mjs';

function Robot() {
  const structure = new Structure();
  structure.replaceAll({ revision: 1, ...RobotStructure() });
  return structure;
}

test('a chain goes from output to output, through groups, by the shortest way', () => {
  assert.deepEqual(ChainBetween(Robot(), '/mock/laser', '/mock/robot/planner'), {
    from: '/mock/laser/scan', to: '/mock/robot/planner/twist', modules: ['/mock/laser', '/mock/robot/planner'] });
  assert.deepEqual(ChainBetween(Robot(), '/mock/laser/scan', '/mock/robot/planner/twist').modules, ['/mock/laser', '/mock/robot/planner']);
});

test('where no data goes there is no chain', () => {
  assert.equal(ChainBetween(Robot(), '/mock/laser', '/mock/laser'), null);
  assert.equal(ChainBetween(Robot(), '/mock/laser', '/mock/robot'), null);
  assert.equal(ChainBetween(Robot(), '/mock/gone', '/mock/laser'), null);
});
