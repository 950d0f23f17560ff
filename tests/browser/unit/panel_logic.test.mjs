import assert from 'node:assert/strict';
import { mock, test } from 'node:test';
import { Hold, kPatience, kPeriod } from '../../../plugins/inspector/panel/source/driving/hold.js';
import { DefaultPanel, DrivableInputs } from '../../../plugins/inspector/panel/source/model/default_panel.js';
import { NumberFields } from '../../../plugins/inspector/panel/source/model/fields.js';
import { FreePlace, InOrder, Overlaps, Placed, Within } from '../../../plugins/inspector/panel/source/model/grid.js';
import { PanelText, ParsePanel } from '../../../plugins/inspector/panel/source/model/kinds.js';
import { AxesOf, MotionOf, TwistText, WithinCircle } from '../../../plugins/inspector/panel/source/model/twist.js';
import { ReadGamepad } from '../../../plugins/inspector/panel/source/widgets/gamepad.js';
import { MotionOfWays } from '../../../plugins/inspector/panel/source/widgets/keys.js';
import { Catalogue } from '../../../plugins/inspector/page/source/model/catalogue.js';
import { Structure } from '../../../plugins/inspector/page/source/model/structure.js';

const kTwist = { name: 'Twist2', kind: 'structure', meaning: 'twist',
  fields: [{ name: 'forward', type: 'double', unit: 'm/s' }, { name: 'turn', type: 'double', unit: 'rad/s' }] };
const catalogue = new Catalogue({ modules: [], types: [kTwist, { name: 'Pose2', meaning: 'pose', kind: 'structure', fields: [] },
  { name: 'Body', kind: 'structure', fields: [{ name: 'twist', type: 'Twist2', unit: '' }, { name: 'name', type: 'string' }] }] });

function Application() {
  const structure = new Structure();
  const module = (path) => ({ path, kind: 'module', type: 'x' });
  const port = (path, direction, data_type) => ({ path, kind: 'port', name: path.split('/').pop(), direction, data_type, unit: '', owner: path.split('/').slice(0, 3).join('/') });
  structure.replaceAll({ revision: 1, elements: [{ path: '/app', kind: 'application', name: 'app' },
    module('/app/drive'), port('/app/drive/twist', 'input', 'Twist2'),
    module('/app/gate'), port('/app/gate/wanted', 'input', 'Twist2'), port('/app/gate/allowed', 'output', 'Twist2'),
    module('/app/planner'), port('/app/planner/twist', 'output', 'Twist2'),
    { path: '/app/planner/speed', kind: 'parameter', name: 'speed', owner: '/app/planner', unit: 'm/s', minimum: 0, maximum: 1, settable: true, value: '0.4' },
    module('/app/world'), port('/app/world/pose', 'output', 'Pose2'), port('/app/world/twist', 'output', 'Twist2')],
  connections: [{ from: '/app/planner/twist', to: '/app/gate/wanted' }, { from: '/app/gate/allowed', to: '/app/drive/twist' }] });
  return structure;
}

test('by hand the planner is replaced, and the gate behind it goes on watching', () => {
  assert.deepEqual(DrivableInputs(Application(), catalogue).map(({ path }) => path), ['/app/gate/wanted', '/app/drive/twist']);
});

test('an application without a panel has one that suits it', () => {
  const widgets = DefaultPanel(Application(), catalogue);
  const kinds = Object.fromEntries(widgets.map((each) => [each.id, each]));
  assert.equal(kinds.joystick.target, '/app/gate/wanted');
  assert.equal(kinds.speed.target, '/app/world/twist');
  assert.equal(kinds.slider.target, '/app/planner/speed');
  assert.ok(kinds.map && kinds.plot);
  assert.equal(kinds.stop, undefined, 'the page has one that no panel can lose');
  for (const a of widgets) for (const b of widgets) assert.ok(a === b || !Overlaps(a, b), `${a.id} is beside ${b.id}`);
  assert.deepEqual(ParsePanel(PanelText(widgets)), widgets);
  assert.deepEqual(DefaultPanel(new Structure(), catalogue), []);
});

test('what is in the way makes room, and nothing else moves', () => {
  const widget = (id, x, y, w, h) => ({ id, x, y, w, h });
  const all = [widget('a', 0, 0, 4, 2), widget('b', 0, 2, 4, 2), widget('c', 6, 0, 4, 2)];
  const placed = Placed(all, widget('a', 0, 1, 4, 2));
  assert.deepEqual(placed.map(({ id, y }) => [id, y]), [['a', 1], ['b', 3], ['c', 0]]);
  assert.deepEqual(all.map(({ y }) => y), [0, 2, 0], 'what is dragged on is judged from where it began');
  assert.deepEqual(Within(widget('a', 11, -2, 4, 0), { w: 2, h: 3 }), widget('a', 8, 0, 4, 3));
  assert.deepEqual(FreePlace(all, { w: 4, h: 2 }), { x: 4, y: 2, w: 4, h: 2 });
  assert.deepEqual(InOrder(all).map(({ id }) => id), ['a', 'c', 'b']);
});

test('a stick is a motion: up is ahead, left turns left, the middle rests', () => {
  const limits = { forward: 0.4, turn: 2 };
  assert.deepEqual(MotionOf({ x: 0, y: 1 }, limits), { forward: 0.4, turn: 0 });
  assert.deepEqual(MotionOf({ x: -1, y: 0 }, limits), { forward: 0, turn: 2 });
  assert.deepEqual(MotionOf({ x: 0.05, y: -0.05 }, limits), { forward: 0, turn: 0 });
  const half = MotionOf({ x: 0, y: -0.5 }, limits).forward;
  assert.ok(half < 0 && half > -0.2, 'slowly at first');
  assert.deepEqual(WithinCircle({ x: 3, y: 4 }), { x: 0.6, y: 0.8 });
  const axes = AxesOf(catalogue, 'Twist2');
  assert.equal(TwistText(axes, { forward: 0.30004, turn: -0 }), '{forward: 0.3, turn: 0}');
  assert.equal(AxesOf(catalogue, 'Pose2'), null);
});

test('keys and gamepads drive only while they are held', () => {
  const limits = { forward: 0.4, turn: 2 };
  assert.deepEqual(MotionOfWays(new Set(), limits), { forward: 0, turn: 0 });
  assert.deepEqual(MotionOfWays(new Set(['up', 'right']), limits), { forward: 0.4, turn: -2 });
  assert.deepEqual(MotionOfWays(new Set(['up', 'down']), limits), { forward: 0, turn: 0 });
  const pad = (pressed, mapping = 'standard') => ({ connected: true, index: 0, mapping, id: 'Pad (Vendor: 1)', axes: [0, -1], buttons: [0, 1, 2, 3, 4].map((at) => ({ pressed: at === pressed })) });
  assert.equal(ReadGamepad([null, undefined]), null);
  assert.equal(ReadGamepad([null, pad(0)]).isHeld, false, 'not a shoulder');
  assert.deepEqual(ReadGamepad([pad(4)]), { id: '0 Pad (Vendor: 1)', name: 'Pad', isStandard: true, isHeld: true, stick: { x: 0, y: 1 } });
  assert.equal(ReadGamepad([pad(4, '')]).isHeld, false, 'nobody knows which button that is');
  assert.equal(ReadGamepad([pad(4, ''), pad(4)]).isHeld, true);
});

test('numbers in values are found by the types', () => {
  assert.deepEqual(NumberFields(catalogue, 'Body').map(({ field, unit }) => `${field} ${unit}`), ['twist.forward m/s', 'twist.turn rad/s']);
  assert.deepEqual(NumberFields(catalogue, 'double', 'm'), [{ field: '', unit: 'm' }]);
});

/** A hold, and a server whose replies come when the test says so. */
function Held(t) {
  mock.timers.enable({ apis: ['setInterval'] });
  t.mock.method(performance, 'now', () => now);
  t.after(() => mock.timers.reset());
  const sent = [];
  const ended = [];
  const request = (message) => new Promise((reply) => sent.push({ message, reply }));
  return { hold: new Hold('/p', 'go', { rest: 'rest', request, onEnd: (errors) => ended.push(errors) }), sent, ended };
}
const Turn = () => new Promise(setImmediate);
let now = 0;
function Tick(time) {
  for (let left = time; left > 0; left -= kPeriod) {
    now += kPeriod;
    mock.timers.tick(kPeriod);
  }
}

test('while it is held it is sent at least ten times a second, with a deadline and one lease', async (t) => {
  const { hold, sent } = Held(t);
  for (let i = 0; i < 20; ++i) {
    sent.at(-1).reply({ ok: true });
    await Turn();
    if (i === 10) hold.set('faster');
    Tick(kPeriod);
  }
  assert.equal(sent.length, 21);
  assert.ok(kPeriod <= 100);
  assert.ok(sent.every(({ message }) => message.deadline <= 0.3 && message.lease === sent[0].message.lease));
  assert.equal(sent.at(-1).message.value, 'faster');
  hold.end();
  Tick(10 * kPeriod);
  assert.deepEqual(sent.slice(21).map(({ message }) => [message.value, message.deadline, message.lease]), [['rest', undefined, sent[0].message.lease]]);
});

test('a hold that the server refuses has ended, and sends nothing more', async (t) => {
  const { hold, sent, ended } = Held(t);
  sent[0].reply({ ok: false, errors: [{ message: 'this hold has ended' }] });
  await Turn();
  Tick(10 * kPeriod);
  hold.end();
  assert.equal(sent.length, 1);
  assert.deepEqual(ended, [[{ message: 'this hold has ended' }]]);
});

test('on a network that is stuck no crowd of old commands waits, and the hold ends by itself, with a rest', async (t) => {
  const { hold, sent, ended } = Held(t);
  Tick(kPatience * kPeriod);
  assert.ok(sent.length <= 4, `${sent.length} wait`);
  assert.deepEqual(ended, []);
  Tick(100 * kPeriod);
  assert.equal(ended.length, 1);
  assert.match(ended[0][0].message, /has not answered/);
  assert.ok(sent.length <= 5, `${sent.length} wait`);
  assert.deepEqual([sent.at(-1).message.value, sent.at(-1).message.deadline], ['rest', undefined]);
  hold.end();
  assert.ok(sent.length <= 5);
});
