// How pages are read, and whether the pages that are there lead to each other.

import assert from 'node:assert/strict';
import { existsSync, readdirSync, readFileSync } from 'node:fs';
import { dirname, join } from 'node:path';
import { test } from 'node:test';
import { BlocksOf, FirstMissing, FirstUnknown } from './page_blocks.mjs';

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
  assert.equal(other.kind, 'part');
});

test('what nobody runs is known as that', () => {
  assert.deepEqual(kindsOf(Fenced('text', 'printed by nobody')), ['part']);
  assert.deepEqual(kindsOf(`<!-- file: x -->\nSome words between.\n${Fenced('xml', '<x/>')}`), ['part']);
  assert.deepEqual(kindsOf(`<!-- not run: it installs -->\n${Fenced('sh', 'x')}`), ['not run']);
  assert.throws(() => BlocksOf('```sh\nls'), /1: the block does not end/);
});

test('lines are printed in their order, with anything where … stands', () => {
  assert.equal(FirstMissing('a…c\n…\nd', 'x\nabc\ny\nd e\n'), undefined);
  assert.equal(FirstMissing('d\na', 'a\nd\n'), 'a');
  assert.equal(FirstMissing('a.c', 'abc\n'), 'a.c');
});

test('READMEs may show parts and drawings, but no command and nothing whole that nobody runs', () => {
  const isUnknown = (page) => FirstUnknown(page, true) !== undefined;
  assert.ok(!isUnknown(Fenced('', 'a ── b')));
  assert.ok(!isUnknown(Fenced('cpp', 'twist.Publish(value);')));
  assert.ok(isUnknown(Fenced('cpp', '#include <runnel/module.h>')));
  assert.ok(isUnknown(Fenced('xml', '<application name="a">')));
  assert.ok(!isUnknown('    laser ──▶ scan\n'));
  assert.ok(isUnknown('    laser\n    runnel run a.xml\n'));
  assert.ok(isUnknown('    $ RUNNEL_PLUGIN_PATH=build runnel run a.xml\n'));
  assert.ok(!isUnknown('<!-- not run: a synopsis -->\n    runnel run APP\n\n    runnel check APP\n'));
  assert.deepEqual(kindsOf(`<!-- not run: a synopsis -->\n    runnel run APP\n\n${Fenced('sh', 'ls')}`), ['not run', 'run']);
  assert.ok(isUnknown('<!-- not run: a synopsis -->\n    runnel run APP\n\nText.\n\n    runnel check APP\n'));
  assert.ok(FirstUnknown(Fenced('cpp', 'x;'), false), 'pages for readers do not');
});

const root = process.env.RUNNEL_ROOT;
const documentation = join(root, 'apps/documentation');
const readmes = ['.', ...['apps', 'bench', 'core', 'modules', 'plugins', 'tests', 'xml'].flatMap((top) =>
  readdirSync(join(root, top), { recursive: true }).map((name) => join(top, String(name))))]
  .filter((folder) => !folder.includes('node_modules') && existsSync(join(root, folder, 'README.md')));

test('each command of a README is run, or says why not', () => {
  assert.ok(readmes.length > 40);
  const run = process.env.RUNNEL_READMES.split(',');
  for (const folder of readmes) {
    const page = readFileSync(join(root, folder, 'README.md'), 'utf8');
    const unknown = FirstUnknown(page, true);
    assert.ok(!unknown, `${folder}/README.md:${unknown?.line}: nobody runs this; see page_blocks.mjs`);
    const has_commands = BlocksOf(page).some(({ kind }) => kind === 'run' || kind === 'file');
    assert.equal(run.includes(folder), has_commands, `${folder} in the list of tests/documentation/CMakeLists.txt`);
  }
});

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
