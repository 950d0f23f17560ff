// What the page takes over when it begins, and keeps: whatever an address or a browser has in store.

import assert from 'node:assert/strict';
import { after, test } from 'node:test';

const kept = new Map();
let refuses = false; // the browser has had too many addresses within some seconds
globalThis.localStorage = { getItem: (key) => kept.get(key) ?? null, setItem: (key, text) => kept.set(key, text) };
globalThis.matchMedia = () => ({ matches: false, addEventListener() {} });
globalThis.document = { documentElement: { dataset: {} } };
globalThis.location = { hash: '', pathname: '/', search: '' };
let onAddress = null;
globalThis.addEventListener = (_, listener) => { onAddress = listener; };
globalThis.history = { replaceState: (_, __, address) => {
  if (refuses) throw new Error('too many calls of replaceState()');
  location.hash = address;
} };
const { ReadAddress, StartAddress } = await import('../../../plugins/inspector/page/source/address.js');
const { SetOpen, StartKeeping, openGroups, selected } = await import('../../../plugins/inspector/page/source/state/choices.js');
const { plots } = await import('../../../plugins/inspector/page/source/plots/plot_list.js');
const { hello, revision } = await import('../../../plugins/inspector/page/source/state/store.js');
after(() => setTimeout(() => process.exit(), 100)); // links look at the time for ever

test('plots of an address that are no lists are left out', () => {
  for (const text of ['1', '{}', 'null', 'true', '"/a/b"', '[1]', '["/a"', '[null,[]]']) {
    assert.deepEqual(ReadAddress(`#${new URLSearchParams({ plot: text })}`).plots, [], text);
  }
});

test('groups that are opened and folded are kept by the browser from the first one on', () => {
  kept.set('runnel.open.robot', '{"/robot/arm":true}');
  StartKeeping();
  hello.value = { application: 'robot' };
  assert.deepEqual(openGroups.value, { '/robot/arm': true });
  SetOpen('/robot/base', false);
  assert.deepEqual(JSON.parse(kept.get('runnel.open.robot')), { '/robot/arm': true, '/robot/base': false });
});

test('a browser that takes no more addresses for a while lets one select nevertheless', () => {
  StartAddress();
  revision.value += 1;
  selected.value = '/robot/arm';
  assert.match(location.hash, /at=\/robot\/arm/);
  refuses = true;
  selected.value = '/robot/base';
  refuses = false;
  selected.value = '/robot/head';
  assert.match(location.hash, /at=\/robot\/head/);
});

test('the plots of an address that somebody enters come at once', () => {
  location.hash = `#${new URLSearchParams({ at: '/robot/arm', plot: '["/robot/arm/pose",["x"],"m"]' })}`;
  onAddress();
  assert.deepEqual(plots.value.map(({ unit, curves }) => [unit, ...curves.map(({ port }) => port)]), [['m', '/robot/arm/pose']]);
  assert.match(location.hash, /plot=/);
});
