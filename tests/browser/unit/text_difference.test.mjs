import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CountChanges, TextDifference } from '../../../plugins/inspector/page/source/model/text_difference.js';

const Brief = (lines) => lines.map(({ kind, text, count }) => (kind === 'skipped' ? `(${count})` : `${{ same: ' ', gone: '-', new: '+' }[kind]}${text}`));

test('a changed line is told with three lines around it', () => {
  const before = 'a\nb\nc\nd\ne\nf\ng\nh\ni\nj\n';
  const lines = TextDifference(before, before.replace('f\n', 'F\n'));
  assert.deepEqual(Brief(lines), ['(2)', ' c', ' d', ' e', '-f', '+F', ' g', ' h', ' i', '(1)']);
  assert.deepEqual(CountChanges(lines), { added: 1, removed: 1 });
  const [gone, added] = [lines.find(({ kind }) => kind === 'gone'), lines.find(({ kind }) => kind === 'new')];
  assert.deepEqual([gone.before, gone.after, added.before, added.after], [6, null, null, 6]);
});

test('texts that are the same have no changes, and a new file has nothing but new lines', () => {
  assert.deepEqual(CountChanges(TextDifference('a\nb\n', 'a\nb\n')), { added: 0, removed: 0 });
  assert.deepEqual(Brief(TextDifference('', 'a\nb\n')), ['+a', '+b']);
});

test('two long texts without a line in common do not take the memory of a page', () => {
  const before = Array.from({ length: 3000 }, (_, line) => `<module name="m${line}"/>\r\n`).join('');
  const start = process.memoryUsage().rss;
  assert.deepEqual(CountChanges(TextDifference(before, before.replaceAll('\r', ''))), { added: 3000, removed: 3000 });
  const taken = Math.round((process.memoryUsage().rss - start) / 1e6);
  assert.ok(taken < 150, `${taken} MB`);
});

test('whatever has changed, both texts are in the difference, by the fewest lines', () => {
  let seed = 7;
  const below = (end) => { seed = (seed * 1103515245 + 12345) % 2147483648; return Math.floor((seed / 2147483648) * end); };
  const text = () => Array.from({ length: below(7) }, () => `${'abc'[below(3)]}\n`).join('');
  for (let round = 0; round < 2000; ++round) {
    const [before, after] = [text(), text()];
    const lines = TextDifference(before, after);
    if (lines.some(({ kind }) => kind === 'skipped')) continue;
    const of = (kind) => lines.filter((line) => line.kind !== kind).map((line) => `${line.text}\n`).join('');
    assert.deepEqual([of('new'), of('gone')], [before, after]);
  }
});
