// The mouse on the graph, without a browser: what Escape takes back, and what is no press on the graph.

import assert from 'node:assert/strict';
import { after, beforeEach, test } from 'node:test';
import { RobotStructure } from '../mock/mock_structures.mjs';

globalThis.localStorage = { getItem: () => null, setItem() {} };
let under = {}; // what is under the pointer: {node} or {port}
const Element = (dataset) => ({ dataset, closest: (what) => (Object.keys(dataset).some((name) => what.includes(`[data-${name}]`)) ? Element(dataset) : null) });
globalThis.document = { elementFromPoint: () => Element(under), elementsFromPoint: () => [Element(under)] };
const { TakeArrangement, draft, places } = await import('../../../plugins/inspector/page/source/state/arrangement.js');
const { chosen, openDialog, openGroups, selected } = await import('../../../plugins/inspector/page/source/state/choices.js');
const { connection, hello, shapeRevision, structure } = await import('../../../plugins/inspector/page/source/state/store.js');
const { band, connecting, layout } = await import('../../../plugins/inspector/page/source/graph/graph_state.js');
const { OnGraphKey } = await import('../../../plugins/inspector/page/source/graph/graph_keys.js');
const { AttachPointer } = await import('../../../plugins/inspector/page/source/graph/pointer.js');
after(() => setTimeout(() => process.exit(), 100)); // links look at the time for ever

const handlers = {};
const captured = new Set();
const host = { addEventListener: (name, handler) => { handlers[name] = handler; }, getBoundingClientRect: () => ({ left: 0, top: 0 }),
  setPointerCapture: (id) => captured.add(id), closest: () => null };

/** `target`: what the browser says it was at: the graph itself if nothing else. */
function Mouse(name, x, y, more = {}) {
  handlers[name]({ pointerId: 1, pointerType: 'mouse', button: 0, clientX: x, clientY: y, target: host, preventDefault() {}, ...more });
}
const Press = (key, repeat = false) => OnGraphKey({ key, repeat, target: host, preventDefault() {}, stopPropagation() {} });

const detach = AttachPointer(host);
connection.value = { state: 'open', reason: '' };
hello.value = { application: 'mock', role: 'change' };
structure.replaceAll({ revision: 1, ...RobotStructure() });
openGroups.value = { '/mock/robot': false };
places.value = new Map(['/mock/world', '/mock/laser', '/mock/robot'].map((path, at) => [path, { x: 400 * at, y: 0 }]));
shapeRevision.value += 1;
beforeEach(() => { openDialog.value = null; under = {}; });

test('Escape takes a drag of a box back, also if the mouse is moved on and let go', () => {
  const before = places.value;
  under = { node: '/mock/laser' };
  Mouse('pointerdown', 410, 10);
  Mouse('pointermove', 450, 60);
  assert.equal(draft.value.get('/mock/laser').y, 52);
  Press('Escape');
  Mouse('pointermove', 470, 90);
  assert.equal(draft.value, null);
  Mouse('pointerup', 470, 90);
  assert.equal(places.value, before, 'nothing is arranged');
});

test('a box that another viewer moves during a drag stays where that one has put it', () => {
  hello.value = { application: 'mock', role: 'drive' }; // what is arranged stays with this page
  under = { node: '/mock/laser' };
  Mouse('pointerdown', 410, 10);
  Mouse('pointermove', 450, 60);
  TakeArrangement({ 'place /mock/world': '0 400' });
  Mouse('pointermove', 450, 70);
  Mouse('pointerup', 450, 70);
  assert.deepEqual(['world', 'laser', 'robot'].map((name) => places.value.get(`/mock/${name}`)), [{ x: 0, y: 400 }, { x: 440, y: 60 }, { x: 800, y: 0 }]);
  hello.value = { application: 'mock', role: 'change' };
});

test('Escape takes a wire back, and a frame around boxes', () => {
  under = { port: '/mock/laser/scan' };
  Mouse('pointerdown', 410, 60);
  Mouse('pointermove', 450, 60);
  assert.equal(connecting.value.port, '/mock/laser/scan');
  Press('Escape');
  Mouse('pointermove', 470, 60);
  assert.equal(connecting.value, null);
  Mouse('pointerup', 470, 60);
  under = {};
  selected.value = '/mock/world';
  for (const after of [['pointermove', 1300, 400], ['pointerup', 1200, 300]]) {
    Mouse('pointerdown', -50, -50, { shiftKey: true });
    Mouse('pointermove', 1200, 300);
    assert.notEqual(band.value, null);
    Press('Escape');
    Mouse(...after);
    Mouse('pointerup', 1300, 400);
    assert.deepEqual([band.value, chosen.value], [null, ['/mock/world']]);
  }
});

test('two quick presses on a button over the graph, or on a wire, are no double click on the graph', () => {
  Mouse('dblclick', 20, 700, { target: { closest: (what) => (what.includes('button') ? {} : null) } });
  under = { edge: '/mock/laser/scan → /mock/robot/scan' };
  Mouse('dblclick', 20, 700);
  assert.equal(openDialog.value, null);
  under = {};
  Mouse('dblclick', 20, 700);
  assert.equal(openDialog.value?.kind, 'create');
});

test('keys that are pressed before a dialog is drawn do nothing to the graph', () => {
  selected.value = '/mock/laser';
  Press('F2');
  const { value } = openDialog;
  assert.equal(value.kind, 'rename');
  for (const key of ['n', 'Delete', 'Escape']) Press(key);
  assert.equal(openDialog.value, value);
  assert.equal(selected.value, '/mock/laser');
});

test('a key that is held walks, and deletes nothing', () => {
  selected.value = '/mock/world';
  Press('Delete', true);
  Press('Escape', true);
  assert.deepEqual([openDialog.value, selected.value], [null, '/mock/world']);
  for (let at = 0; at < 5; ++at) Press('ArrowRight', true);
  assert.equal(selected.value, '/mock/robot');
  selected.value = '/mock/world';
  Press('Delete');
  assert.equal(openDialog.value.kind, 'confirm');
});

test('the end of each finger is heard, whatever becomes of what was under it', () => {
  const finger = (id, name, x) => Mouse(name, x, 300, { pointerId: id, pointerType: 'touch' });
  finger(7, 'pointerdown', 100);
  finger(8, 'pointerdown', 200);
  assert.deepEqual([...captured].filter((id) => id > 1), [7, 8]);
  finger(7, 'pointerup', 100);
  finger(8, 'pointerup', 200);
  assert.ok(layout.value.boxes.size > 0);
});

test('a drag ends with the view that it is in', () => {
  under = { node: '/mock/laser' };
  Mouse('pointerdown', 410, 10);
  Mouse('pointermove', 450, 60);
  assert.notEqual(draft.value, null);
  detach();
  assert.equal(draft.value, null);
});
