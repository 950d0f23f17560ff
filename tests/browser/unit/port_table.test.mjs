import assert from 'node:assert/strict';
import { test } from 'node:test';
import { EditableText, FilterPorts, FormatAge, FormatBandwidth, FormatPortValue, IsExact, PortRows, SortPorts, VisibleRows } from '../../../plugins/inspector/page/source/model/port_table.js';
import { Catalogue } from '../../../plugins/inspector/page/source/model/catalogue.js';
import { Structure } from '../../../plugins/inspector/page/source/model/structure.js';
import { RobotStructure } from '../mock/mock_structures.mjs';

function Rows() {
  const structure = new Structure();
  structure.replaceAll({ revision: 1, ...RobotStructure() });
  return PortRows(structure);
}
const Paths = (rows) => rows.map(({ path }) => path);

test('each port is a row, called by its owner within the application', () => {
  const row = Rows().find(({ path }) => path === '/mock/robot/planner/twist');
  assert.deepEqual([row.owner, row.name, row.direction, row.type], ['robot/planner', 'twist', 'output', 'Twist2']);
  assert.equal(Rows().length, 15);
});

test('ports are filtered by words of path and type, by direction, and by what a person has set', () => {
  const rows = Rows();
  assert.deepEqual(Paths(FilterPorts(rows, { text: 'planner POSE' })), ['/mock/robot/planner/pose']);
  assert.deepEqual(Paths(FilterPorts(rows, { text: 'pose2', direction: 'output' })), ['/mock/world/pose']);
  assert.deepEqual(FilterPorts(rows, { text: '', byHand: true }), []);
  rows[0].byHand = true;
  assert.equal(FilterPorts(rows, { text: '', byHand: true }).length, 1);
  assert.deepEqual(FilterPorts(rows, { text: 'nothing like it' }), []);
});

test('rows are in the order of a column, and those of which nothing is known come last', () => {
  const rows = [10, 9, 2].map((number) => ({ path: `/a/m${number}/out`, owner: `m${number}`, name: 'out', type: 'double', direction: 'output' }));
  assert.deepEqual(SortPorts(rows, { column: 'name' }, () => ({})).map(({ owner }) => owner), ['m2', 'm9', 'm10']);
  assert.deepEqual(SortPorts(rows, { column: 'name', isDown: true }, () => ({})).map(({ owner }) => owner), ['m10', 'm9', 'm2']);
  const rate = { m9: 5, m10: 20 };
  const measured = ({ owner }) => ({ rate: rate[owner] ?? null });
  assert.deepEqual(SortPorts(rows, { column: 'rate', isDown: true }, measured).map(({ owner }) => owner), ['m10', 'm9', 'm2']);
  assert.deepEqual(SortPorts(rows, { column: 'rate', isDown: false }, measured).map(({ owner }) => owner), ['m9', 'm10', 'm2']);
});

test('only rows that can be seen, and a few around them, are drawn', () => {
  assert.deepEqual(VisibleRows({ top: 2800, height: 280 }, 28, 5000), { first: 94, last: 116 });
  assert.deepEqual(VisibleRows({ top: 0, height: 280 }, 28, 4), { first: 0, last: 4 });
  assert.deepEqual(VisibleRows({ top: 9000, height: 280 }, 28, 4), { first: 4, last: 4 });
});

test('a value becomes a text that can be changed and sent', () => {
  assert.equal(EditableText({ x: 1.5, y: -2, name: 'a b', mode: 'left' }), '{x: 1.5, y: -2, name: "a b", mode: left}');
  assert.equal(EditableText([true, { x: Infinity }]), '[true, {x: inf}]');
  assert.equal(EditableText({ sec: 1, nsec: 5 }), '1000000005ns');
  assert.equal(EditableText('two words'), 'two words');
  assert.equal(EditableText(undefined), '');
});

test('bandwidths, ages and pictures are short', () => {
  assert.equal(FormatBandwidth(640), '640 B/s');
  assert.equal(FormatBandwidth(12345), '12.3 kB/s');
  assert.equal(FormatBandwidth(2.5e8), '250 MB/s');
  assert.equal(FormatBandwidth(null), '');
  assert.equal(FormatAge(0.234), '0.2 s');
  assert.equal(FormatAge(180), '3 min');
  assert.equal(FormatAge(7200), '2.0 h');
  assert.equal(FormatPortValue('image', { width: 64, height: 48, encoding: 'rgb8', data: [] }), '64 × 48 rgb8');
});

test('a value whose whole numbers a browser has rounded is known as one', () => {
  const catalogue = new Catalogue({ modules: [], types: [{ name: 'Ticket', kind: 'structure', fields: [{ name: 'id', type: 'uint64' }, { name: 'far', type: 'double' }] },
    { name: 'Tickets', kind: 'sequence', element: 'Ticket' }] });
  assert.equal(IsExact(catalogue, 'Ticket', { id: 7, far: 1e300 }), true);
  assert.equal(IsExact(catalogue, 'Ticket', { id: JSON.parse('9007199254740993'), far: 1 }), false);
  assert.equal(IsExact(catalogue, 'Tickets', [{ id: 7, far: 1 }, { id: 2 ** 60, far: 1 }]), false);
  assert.equal(IsExact(catalogue, 'double', 2 ** 60), true);
});
