// How pages are read, and whether the pages that are there lead to each other.

import assert from 'node:assert/strict';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { BlocksOf, FirstMissing } from './page_blocks.mjs';

const Fenced = (language, ...lines) => ['```' + language, ...lines, '```'].join('\n');
const kindsOf = (page) => BlocksOf(page).map(({ kind }) => kind);

test('commands and what they print', () => {
  const page = `Do this:\n\n${Fenced('sh', 'ls', 'pwd')}\n\n${Fenced('text', '/home')}\n`;
  assert.deepEqual(BlocksOf(page), [{ kind: 'run', line: 3, text: 'ls\npwd\n' }, { kind: 'output', line: 8, text: '/home\n' }]);
});

test('a mark belongs to the block behind it alone', () => {
  const page = `<!-- file: a/b.cpp -->\n${Fenced('cpp', 'int x;')}\n\n${Fenced('cpp', 'int y;')}`;
  const [file, other] = BlocksOf(page);
  assert.deepEqual([file.kind, file.name, file.text], ['file', 'a/b.cpp', 'int x;\n']);
  assert.equal(other.kind, 'unknown');
});

test('what nobody runs is known as that', () => {
  assert.deepEqual(kindsOf(Fenced('text', 'printed by nobody')), ['unknown']);
  assert.deepEqual(kindsOf(`<!-- file: x -->\nSome words between.\n${Fenced('xml', '<x/>')}`), ['unknown']);
  assert.deepEqual(kindsOf(`<!-- not run: it installs -->\n${Fenced('sh', 'x')}`), ['not run']);
  assert.throws(() => BlocksOf('```sh\nls'), /1: the block does not end/);
});

test('lines are printed in their order, with anything where … stands', () => {
  assert.equal(FirstMissing('a…c\n…\nd', 'x\nabc\ny\nd e\n'), undefined);
  assert.equal(FirstMissing('d\na', 'a\nd\n'), 'a');
  assert.equal(FirstMissing('a.c', 'abc\n'), 'a.c');
});

const documentation = process.env.RUNNEL_DOCUMENTATION;
const pages = readdirSync(join(documentation, 'pages'), { recursive: true }).map(String).filter((file) => file.endsWith('.md'));

test('each page is in the list of the site, and its links lead somewhere', () => {
  const list = readFileSync(join(documentation, 'mkdocs.yml.in'), 'utf8');
  assert.ok(pages.length > 10);
  for (const page of pages) {
    assert.ok(list.includes(`- ${page}\n`), `${page} is not in mkdocs.yml.in`);
    const text = readFileSync(join(documentation, 'pages', page), 'utf8').replaceAll(/^```[^]*?^```$/gm, '');
    for (const [, target] of text.matchAll(/\]\(([^)#]+)/g)) {
      if (target.startsWith('reference/')) continue; // Doxygen's
      assert.ok(existsSync(join(documentation, 'pages', dirname(page), target)), `${page}: ${target} is not there`);
    }
  }
});
