import assert from 'node:assert/strict';
import { test } from 'node:test';
import { NumberScales } from '../../../plugins/inspector/page/source/model/number_scales.js';
import { FormatBounds, FormatMilliseconds, FormatNumber, FormatRate, FormatTime, FormatValue } from '../../../plugins/inspector/page/source/model/value_format.js';
import { FieldText, IsPlottable, NumberAt, ValueRows } from '../../../plugins/inspector/page/source/model/value_rows.js';
import { Catalogue } from '../../../plugins/inspector/page/source/model/catalogue.js';
import { CheckNumber, CheckValue } from '../../../plugins/inspector/page/source/model/parameter_check.js';
import { Change, FreeName, NameProblem } from '../../../plugins/inspector/page/source/model/changes.js';
import { AddLogEntries, FilterLog, TroublesOf } from '../../../plugins/inspector/page/source/state/log.js';
import { Series } from '../../../plugins/inspector/page/source/plots/series.js';
import { kCatalogue } from '../mock/mock_structures.mjs';

const catalogue = new Catalogue(kCatalogue);

test('numbers are short, and say what is not one', () => {
  assert.equal(FormatNumber(3), '3');
  assert.equal(FormatNumber(-0.123456), '−0.123');
  assert.equal(FormatNumber(1234.567), '1234.6');
  assert.equal(FormatNumber(0.00001234), '1.234e−5');
  assert.equal(FormatNumber(null), 'NaN');
  assert.equal(FormatNumber(JSON.parse('-1e999')), '−∞');
});

test('rates, durations and times have units that suit', () => {
  assert.equal(FormatRate(20.01), '20 Hz');
  assert.equal(FormatRate(19.8), '19.8 Hz');
  assert.equal(FormatRate(0), '0 Hz');
  assert.equal(FormatRate(25000), '25 kHz');
  assert.equal(FormatMilliseconds(0.0451), '45.1 µs');
  assert.equal(FormatMilliseconds(0.18), '0.18 ms');
  assert.equal(FormatMilliseconds(1500), '1.50 s');
  assert.equal(FormatMilliseconds(undefined), '–');
  assert.equal(FormatTime(12.345), '12.35 s');
  assert.equal(FormatTime(61.26), '1:01.3');
  assert.equal(FormatTime(3723.4), '1:02:03.4');
  assert.equal(FormatTime(119.97), '2:00.0');
  assert.equal(FormatTime(59.97), '1:00.0');
  assert.equal(FormatTime(3599.96), '1:00:00.0');
});

test('a value is one line, and long ones are cut', () => {
  assert.equal(FormatValue({ x: 1, y: { a: true } }), 'x 1, y a true');
  assert.equal(FormatValue([1, 2, 3, 4, 5]), '[1, 2, 3, 4, … 5]');
  assert.equal(FormatValue({ sec: 2, nsec: 500000000 }), '2.500 s');
  assert.equal(FormatValue('x'.repeat(100), 10).length, 10);
});

test('bounds are told as far as there are any', () => {
  assert.equal(FormatBounds({ minimum: 0, maximum: 2, unit: 'm' }), '0 … 2 m');
  assert.equal(FormatBounds({ minimum: 0, maximum: null, unit: '' }), '≥ 0');
  assert.equal(FormatBounds({ minimum: null, maximum: null }), '');
  assert.equal(FormatBounds({ minimum: -Infinity, maximum: 2 * Math.PI, unit: 'rad' }), '≤ 6.2832 rad');
});

test('a value has a row for each field, with its unit', () => {
  const rows = ValueRows(catalogue, 'Pose2', { x: 1, y: 2, heading: 0.5 });
  assert.deepEqual(rows.map(({ name, unit, value }) => [name, unit, value]), [['x', 'm', 1], ['y', 'm', 2], ['heading', 'rad', 0.5]]);
});

test('long lists are rows of their own, and have their elements only if they are open', () => {
  const scan = { ranges: [1, 2, 3] };
  const shut = ValueRows(catalogue, 'RangeScan', scan, () => false);
  assert.deepEqual(shut.map((row) => [FieldText(row.field), row.length]), [['ranges', 3]]);
  const open = ValueRows(catalogue, 'RangeScan', scan, () => true);
  assert.deepEqual(open.map((row) => [FieldText(row.field), row.unit]), [['ranges', 'm'], ['ranges[0]', 'm'], ['ranges[1]', 'm'], ['ranges[2]', 'm']]);
});

test('a plain number is a row without a name', () => {
  assert.deepEqual(ValueRows(catalogue, 'double', 4).map(({ name, value }) => [name, value]), [['', 4]]);
});

test('numbers are found by their field, whatever the value has become', () => {
  assert.equal(NumberAt({ a: [1, { b: 7 }] }, ['a', 1, 'b']), 7);
  assert.equal(NumberAt({ a: true }, ['a']), 1);
  assert.equal(NumberAt({ a: { sec: 1, nsec: 250000000 } }, ['a']), 1.25);
  assert.equal(NumberAt({ a: 1 }, ['b', 'c']), null);
  assert.equal(NumberAt({ a: 'text' }, ['a']), null);
  assert.equal(NumberAt(5, []), 5);
});

test('numbers, truths and times can be plotted, texts and lists not', () => {
  const plottable = (value) => ValueRows(catalogue, '', { field: value }, () => false).map(IsPlottable);
  assert.deepEqual(plottable(1), [true]);
  assert.deepEqual(plottable(false), [true]);
  assert.deepEqual(plottable({ sec: 1, nsec: 0 }), [true]);
  assert.deepEqual(plottable('left'), [false]);
  assert.deepEqual(plottable([1]), [false]);
});

test('parameters are checked by type and bounds before the application is asked', () => {
  const speed = { data_type: 'double', minimum: 0.01, maximum: 10, unit: 'm/s' };
  assert.equal(CheckValue(speed, '0.5', catalogue), '');
  assert.equal(CheckValue(speed, '11', catalogue), 'at most 10 m/s is allowed');
  assert.equal(CheckValue(speed, '0', catalogue), 'at least 0.01 m/s is needed');
  assert.equal(CheckValue(speed, 'fast', catalogue), "'fast' is not a number");
  assert.equal(CheckValue({ data_type: 'uint32' }, '1.5', catalogue), 'a whole number is needed');
  assert.equal(CheckValue({ data_type: 'double' }, 'nan', catalogue), '');
  assert.equal(CheckValue({ data_type: 'Direction' }, 'up', catalogue), 'one of left, right is needed');
  assert.equal(CheckValue({ data_type: 'Unknown' }, 'anything', catalogue), '', 'the application knows');
});

test('changes are told as the server reads them, with names and values as they are', () => {
  assert.deepEqual(Change.create('/a/b', 'p/c'), { change: 'create', path: '/a/b', type: 'p/c' });
  assert.deepEqual(Change.move('/a', ''), { change: 'move', path: '/a', thread: '' });
  assert.deepEqual(Change.set('/a/b', 'say "x"; \\ now'), { change: 'set', path: '/a/b', value: 'say "x"; \\ now' });
  assert.deepEqual(Change.createPort('/g/p', 'input', 'int32'),
    { change: 'create_port', path: '/g/p', direction: 'input', type: 'int32' });
});

test('new names are free, and wrong ones are told', () => {
  const structure = { get: (path) => (['/a/filter', '/a/filter_2'].includes(path) ? {} : undefined) };
  assert.equal(FreeName(structure, '/a', 'sensors/filter'), 'filter_3');
  assert.equal(NameProblem(structure, '/a', 'new'), '');
  assert.match(NameProblem(structure, '/a', 'filter'), /already/);
  assert.match(NameProblem(structure, '/a', 'a b'), /blanks/);
  assert.match(NameProblem(structure, '/a', ''), /needed/);
  // The same names as in tests/core/element/element_path_test.cpp.
  for (const name of ['laser', 'größe_2', '日本', '?loc', 'a?', '"a"', 'a&b<c>', 'a;b#c', '*', '-', '...',
    'a\\b', '{a=b}', '🤖']) {
    assert.equal(NameProblem(structure, '/a', name), '', name);
  }
  for (const name of ['.', '..', 'a/b', ' a', 'a ', 'front laser', 'a\tb', 'a\nb', 'a,b', '\x01', 'a\x1b[2J',
    '\x7f', '\x85', '\ufffe', '\ud800']) {
    assert.notEqual(NameProblem(structure, '/a', name), '', JSON.stringify(name));
  }
});

test('module types are found by all words, those named so first', () => {
  assert.deepEqual(catalogue.search('planner').map(({ type }) => type), ['mock/other_planner', 'mock/planner']);
  assert.deepEqual(catalogue.search('way otherwise').map(({ type }) => type), ['mock/other_planner']);
  assert.equal(catalogue.search('').length, catalogue.modules.length);
});

test('the log keeps each entry once, the newest of them, and is filtered by kind and text', () => {
  const entry = (number, kind = 'change', text = `entry ${number}`) => ({ number, kind, text, time: 0 });
  let log = AddLogEntries([], [entry(1), entry(2, 'fault', 'Laser broke')]);
  log = AddLogEntries(log, [entry(2, 'fault', 'Laser broke'), entry(3)]);
  assert.deepEqual(log.map(({ number }) => number), [1, 2, 3]);
  assert.deepEqual(FilterLog(log, { text: 'laser', kinds: new Set() }).map(({ number }) => number), [2]);
  assert.deepEqual(FilterLog(log, { text: '', kinds: new Set(['change']) }).map(({ number }) => number), [1, 3]);
  const many = AddLogEntries(log, Array.from({ length: 1500 }, (_, index) => entry(index + 4)));
  assert.equal(many.length, 1000);
  assert.equal(many.at(-1).number, 1503);
});

test('what went wrong with an element is found by its path, not by one that begins like it', () => {
  const entries = [['fault', '/a/laser: it broke'], ['fault', '/a/laser_2: it broke'], ['change', 'set /a/laser/x 1'],
    ['warning', 'late: /a/laser/scan'], ['fault', 'all of /a/laser']].map(([kind, text], number) => ({ number, kind, text, time: 0 }));
  assert.deepEqual(TroublesOf(entries, '/a/laser').map(({ number }) => number), [0, 3, 4]);
});

test('a curve gives its part of the time, with one point beyond', () => {
  const series = new Series();
  for (let i = 0; i <= 10; ++i) series.add(i, i * i);
  assert.deepEqual(series.window(3.5, 6), [[3, 4, 5, 6], [9, 16, 25, 36]]);
  assert.equal(series.lastTime, 10);
});

test('a curve that is thinned keeps its peaks', () => {
  const series = new Series();
  for (let i = 0; i < 10000; ++i) series.add(i, i === 7777 ? 100 : 0);
  const [times, values] = series.window(0, 10000, 200);
  assert.ok(times.length <= 201, `${times.length} points`);
  assert.equal(Math.max(...values), 100);
  assert.equal(times[values.indexOf(100)], 7777);
});

test('a clock that goes back begins a new curve, one that stands adds nothing', () => {
  const series = new Series();
  for (const time of [1, 2, 2, 3]) series.add(time, time);
  assert.equal(series.times.length, 3);
  series.add(0.5, 9);
  assert.deepEqual(series.times, [0.5]);
});

test('a curve is bounded', () => {
  const series = new Series(100);
  for (let i = 0; i < 1000; ++i) series.add(i, i);
  assert.ok(series.times.length <= 125);
  assert.equal(series.lastTime, 999);
});

test('live numbers stay where they are: as many decimals as the largest needs, room for a sign that was there', () => {
  const scales = new NumberScales();
  assert.equal(scales.format(0), '0');
  assert.equal(scales.format(1.5), '1.500');
  assert.equal(scales.format(1.073e-7), '0.000', 'no other notation');
  assert.equal(scales.format(-1e-9), '\u20070.000', 'no sign of nothing, but the room for it');
  assert.equal(scales.format(-2), '−2.000');
  assert.equal(scales.format(2), '\u20072.000');
  assert.equal(scales.format(300), '\u2007300.00');
  assert.equal(scales.format(2), '\u20072.00');
  assert.equal(new NumberScales().format(-1.073e-7), '−0.000000107');
  assert.equal(new NumberScales().format(7), '7');
  assert.equal(FormatValue({ x: -1, y: [2, 0.5] }, 60, new NumberScales()), 'x −1, y [2, 0.500]');
});

test('what is no number is not taken as one', () => {
  const bounds = { minimum: 0, maximum: 99, isWhole: true };
  for (const text of ['', ' ', '10 Hz', 'x', '-1', '100', '1.5', 'nan', 'inf', '1e999']) assert.notEqual(CheckNumber(text, bounds), '', text);
  for (const text of ['0', ' 40 ', '99']) assert.equal(CheckNumber(text, bounds), '', text);
  assert.equal(CheckNumber('0.5', { minimum: 0.001, unit: 'Hz' }), '');
  assert.equal(CheckNumber('0', { minimum: 0.001, unit: 'Hz' }), 'at least 0.001 Hz is needed');
});
