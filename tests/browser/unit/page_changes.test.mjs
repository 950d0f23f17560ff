// What the page asks an application for, which is none: what goes with a name, what is deleted, copied and added.

import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { RobotStructure } from '../mock/mock_structures.mjs';

const asked = [];
let undone = ''; // what an undo or redo is told to be
let keepsNothing = false; // the browser, for pages

class Socket {
  static OPEN = 1;
  readyState = 0;

  constructor() {
    setTimeout(() => {
      this.readyState = 1;
      this.onopen();
      this.tell({ op: 'hello', application: 'mock', role: 'change', run: '1', clock: 'simulated' });
      this.tell({ op: 'structure', revision: 1, ...RobotStructure() });
    });
  }

  tell(message) { this.onmessage({ data: JSON.stringify(message) }); }
  send(text) {
    const { request, ...message } = JSON.parse(text);
    if (request === undefined) return;
    asked.push(message);
    setTimeout(() => this.tell({ op: 'reply', request, ok: true, text: undone }));
  }
  close() {}
}

globalThis.WebSocket = Socket;
globalThis.location = { hash: '', search: '', pathname: '/' };
globalThis.history = {};
let onKey = null;
globalThis.document = { addEventListener: (_, listener) => { onKey = listener; } };
const kept = new Map();
const Allowed = () => { if (keepsNothing) throw new Error('nothing may be kept'); };
globalThis.localStorage = { getItem: (key) => { Allowed(); return kept.get(key) ?? null; }, setItem: (key, text) => { Allowed(); kept.set(key, text); } };
const { Redo, Rename, SetConversion, Undo } = await import('../../../plugins/inspector/page/source/state/actions.js');
const { TakeArrangement, notes, places } = await import('../../../plugins/inspector/page/source/state/arrangement.js');
const { DeleteCarefully } = await import('../../../plugins/inspector/page/source/state/careful.js');
const { Choose, GroupForNew, IsOpen, SetOpen, chosen, openDialog, selected } = await import('../../../plugins/inspector/page/source/state/choices.js');
const { CopyChosen, PasteCopied } = await import('../../../plugins/inspector/page/source/state/clipboard.js');
const { AttachKeys } = await import('../../../plugins/inspector/page/source/panels/page_keys.js');
const { Start, run, structure } = await import('../../../plugins/inspector/page/source/state/store.js');
Start('ws://mock');
after(() => setTimeout(() => process.exit(), 100)); // links look at the time for ever
const Sleep = (time) => new Promise((done) => { setTimeout(done, time); });
const Changes = () => asked.filter(({ op }) => op === 'change').at(-1).changes;
await Sleep(20);

test('notes, places, the selection and open groups go with a name, and back when the name is undone', async () => {
  const wire = '/mock/laser/scan → /mock/robot/scan';
  TakeArrangement({ 'note /mock/robot': 'the best', 'place /mock/robot/planner': '8 16', [`note ${wire}`]: '10 Hz' });
  SetOpen('/mock/robot', false);
  selected.value = '/mock/robot/planner';
  const under = (name) => [notes.value.get(`/mock/${name}`), places.value.get(`/mock/${name}/planner`), notes.value.get(`/mock/laser/scan → /mock/${name}/scan`),
    IsOpen(`/mock/${name}`), selected.value === `/mock/${name}/planner`];
  const all = ['the best', { x: 8, y: 16 }, '10 Hz', false, true];
  const none = [undefined, undefined, undefined, true, false];
  await Rename('/mock/robot', 'car');
  assert.deepEqual([under('car'), under('robot')], [all, none]);
  undone = 'undone: rename /mock/robot car';
  await Undo();
  assert.deepEqual([under('car'), under('robot')], [none, all]);
  undone = 'redone: rename /mock/robot car';
  await Redo();
  assert.deepEqual([under('car'), under('robot')], [all, none]);
  undone = 'undone: delete /mock/car';
  await Undo();
  assert.deepEqual(under('car'), all, 'what else is undone changes no names');
  for (const name of ['"a=b"', 'so_long_a_nam…']) { // as the application writes such names
    undone = `redone: rename /mock/car ${name}`;
    await Redo();
    assert.deepEqual(under('car'), all, name);
  }
  await Sleep(20);
  assert.equal(asked.filter(({ op }) => op === 'arrange').length, 3, 'all viewers are told');
});

test('a key that is held undoes once, pauses once, and steps on', () => {
  AttachKeys();
  run.value = { ...run.value, undo: 'set speed', redo: 'set speed' };
  const target = { closest: () => null };
  for (const [key, ctrlKey, op, times] of [['z', true, 'undo', 1], ['y', true, 'redo', 1], ['p', false, 'pause', 1], ['.', false, 'step', 3]]) {
    const before = asked.length;
    for (const repeat of [false, true, true]) onKey({ key, ctrlKey, repeat, target, preventDefault() {} });
    assert.deepEqual(asked.slice(before).map((each) => each.op), Array(times).fill(op), key);
  }
});

test('what lies within something that is deleted goes with it', async () => {
  DeleteCarefully(['/mock/robot', '/mock/robot/planner', '/mock/laser']);
  assert.match(openDialog.value.title, /2 elements/);
  openDialog.value.action();
  assert.deepEqual(Changes().map(({ path }) => path), ['/mock/robot', '/mock/laser']);
  openDialog.value = null;
  await Sleep(20);
  for (const [all, left] of [[['/mock/robot', '/mock/robot/planner'], '/mock'], [['/mock/laser', '/mock/robot'], null]]) {
    Choose(all);
    DeleteCarefully(all);
    openDialog.value.action();
    openDialog.value = null;
    await Sleep(20);
    assert.equal(selected.value, left, 'nothing is selected that is gone');
  }
});

test('a conversion is changed of the connection as it is, not as it was when somebody began to choose', async () => {
  const [from, to] = ['/mock/laser/scan', '/mock/robot/scan'];
  const before = { ...structure.connections.get(`${from} → ${to}`), part: 'ranges' };
  structure.change({ revision: 2, connected: [{ ...before, queue: 5, on_full: 'refuse' }] }); // by another viewer
  SetConversion(before, { part: 'ranges[0]', convert: 'round' });
  const { from: part, convert, queue, on_full: onFull } = Changes().at(-1);
  assert.deepEqual([part, convert, queue, onFull], [`${from}.ranges[0]`, 'round', 5, 'refuse']);
  await Sleep(20);
});

test('what is new is not put into another application of the network', () => {
  structure.change({ revision: 2, elements: [{ path: '/mock/@other', kind: 'application', far: true }] });
  selected.value = '/mock/@other';
  assert.equal(GroupForNew(), '/mock');
});

test('copying works in a browser that keeps nothing', async () => {
  Choose(['/mock/laser']);
  CopyChosen();
  keepsNothing = true;
  Choose(['/mock/world']);
  assert.equal(CopyChosen(), true);
  await PasteCopied();
  assert.deepEqual(Changes().map(({ path }) => path), ['/mock/world_2']);
  assert.deepEqual(chosen.value, ['/mock/world_2']);
});
