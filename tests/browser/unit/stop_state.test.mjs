// The STOP of a page whose robot answers late, or refuses: without a browser, at sockets that the test holds.

import assert from 'node:assert/strict';
import { after, test } from 'node:test';

const kOwn = 'runnel.stop.v1';
const sockets = [];
let isStuck = false; // what the robot says is held up; what the page says arrives
let robot = { in_force: false, by: '', since: 0 };
let answer = null;   // in the place of the robot's own
let isReleasedAtOnce = false; // by somebody else, before the answer
let isUnheard = false; // it gives no sign of life
const heard = [];
const said = [], answered = []; // times of signs of life

class Socket {
  static OPEN = 1;
  readyState = 0;
  #out = [];

  constructor(url, [protocol]) {
    this.protocol = protocol;
    sockets.push(this);
    setTimeout(() => { this.readyState = 1; this.onopen(); this.alive(); });
    this.timer = setInterval(() => this.alive(), 200);
  }

  alive() {
    if (this.readyState !== 1 || isUnheard) return;
    said.push(performance.now() / 1000);
    this.tell({ op: 'alive', at: said.at(-1), stop: robot });
  }
  tell(message) { this.#out.push(JSON.stringify(message)); this.flush(); }
  flush() { if (!isStuck) for (const data of this.#out.splice(0)) this.onmessage({ data }); }
  send(text) {
    const { request, ...message } = JSON.parse(text);
    if (message.op === 'alive') return void answered.push(message.at);
    heard.push({ ...message, isOwn: this.protocol === kOwn });
    const reply = answer ?? { ok: true };
    if (reply.ok && message.op === 'stop') SetRobot(true, 'this page');
    if (isReleasedAtOnce) SetRobot(false, 'a colleague');
    if (reply.ok && message.op === 'release') SetRobot(false, 'this page');
    this.tell({ op: 'reply', request, ...reply });
  }
  close() { this.readyState = 3; clearInterval(this.timer); }
}

function SetRobot(inForce, by) {
  robot = { in_force: inForce, by, since: performance.now() / 1000 };
  sockets.forEach((each) => each.alive());
}

const Sleep = (time) => new Promise((done) => { setTimeout(done, time); });
const Loosen = () => { isStuck = false; sockets.forEach((each) => each.flush()); };
const Presses = () => heard.filter(({ op }) => op === 'stop').length;

globalThis.localStorage = { getItem: () => null, setItem() {} };
globalThis.WebSocket = Socket;
const stop = await import('../../../plugins/inspector/page/source/stop/stop_state.js');
const { Link } = await import('../../../plugins/inspector/page/source/connection/link.js');
const other = new Link('ws://robot', '', { onMessage: (message) => { if (message.op === 'alive') stop.TakeFromOther(message); }, onState: stop.OtherIs });
stop.UseOther(other);
stop.StartStop('ws://robot');
other.open();
await Sleep(100);
after(() => setTimeout(() => process.exit(), 100)); // links look at the time for ever

test('a sign of life that comes late is answered by the time at which it was said', async () => {
  isStuck = true;
  await Sleep(500);
  Loosen();
  assert.deepEqual(answered.sort(), said.sort());
});

test('a press is sent although an earlier one has not been answered, whose answer does not confirm it', async () => {
  isStuck = true;
  stop.PressStop();
  await Sleep(1200); // it has been sent over both by now
  assert.equal(Presses(), 2);
  SetRobot(false, 'a colleague');
  answer = { ok: false, errors: [{ message: 'not today' }] };
  stop.PressStop();
  assert.equal(Presses(), 3, 'the second press');
  Loosen();
  await Sleep(0);
  assert.equal(stop.pressed.value?.problem, 'not today', 'what was said of the first press confirms nothing');
  answer = null;
  stop.PressStop();
  await Sleep(50);
  assert.equal(stop.pressed.value, null);
  assert.equal(stop.isConfirmed.value, true);
});

test('what somebody has released before the answer came is not shown as in force', async () => {
  isReleasedAtOnce = true;
  SetRobot(false, 'a colleague');
  stop.PressStop();
  await Sleep(50);
  isReleasedAtOnce = false;
  assert.equal(stop.pressed.value, null);
  assert.equal(stop.isInForce.value, false);
  SetRobot(true, 'a colleague');
  await Sleep(50);
});

test('a press and a release that are refused are not sent again, and say why', async () => {
  answer = { ok: false, errors: [{ message: 'too many requests a second' }] };
  const before = heard.length;
  await stop.ReleaseStop();
  assert.equal(stop.releaseProblem.value, 'too many requests a second');
  SetRobot(false, 'a colleague');
  await Sleep(50);
  stop.PressStop();
  await Sleep(2500);
  assert.deepEqual(heard.slice(before).map(({ op }) => op), ['release', 'stop']);
  assert.equal(stop.pressed.value.problem, 'too many requests a second');
  answer = null;
  stop.PressStop();
  await Sleep(50);
  assert.equal(stop.isConfirmed.value, true);
});

test('a release has the time of the newest sign of life', async () => {
  isStuck = true;
  const begin = performance.now() / 1000;
  await Sleep(500);
  stop.ReleaseStop();
  await Sleep(20);
  const { at } = heard.at(-1);
  assert.ok(at <= begin && at > begin - 1, `${at}, and ${begin}`);
  Loosen();
});

test('what it holds is what the robot told of this STOP; where it tells nothing, that is not known', async () => {
  SetRobot(false, 'a colleague');
  await Sleep(50);
  assert.equal(stop.held.value, null);
  const tell = async (drives) => {
    robot = { in_force: true, by: 'a colleague', since: 1, drives, unreached: drives === undefined ? undefined : [] };
    sockets.forEach((each) => each.alive());
    await Sleep(50);
    return stop.held.value;
  };
  assert.equal(await tell(undefined), null);
  assert.deepEqual(await tell(''), [], 'nothing');
  assert.deepEqual(await tell('/base/wheels, /cmd_vel (in the network)'), ['/base/wheels', '/cmd_vel (in the network)']);
  assert.equal((await tell(undefined)).length, 2, 'as it was told before the structure was changed');
  SetRobot(false, 'a colleague');
  await Sleep(50);
  assert.equal(await tell(undefined), null, 'of this STOP nothing has been told');
  SetRobot(false, 'a colleague');
  await Sleep(50);
});

test('what it does not reach is what the robot told last, and it is known that this is old', async () => {
  const tell = async (unreached) => {
    robot = { ...robot, unreached };
    sockets.forEach((each) => each.alive());
    await Sleep(50);
    return [stop.unreached.value, stop.told.value.isReachOld ?? false];
  };
  const stuck = [{ path: '/wheels', why: 'its cycle hangs' }];
  assert.deepEqual(await tell([]), [[], false]);
  assert.deepEqual(await tell(stuck), [stuck, false]);
  assert.deepEqual(await tell(undefined), [stuck, true]);
  assert.deepEqual(await tell(undefined), [stuck, true]);
  assert.deepEqual(await tell([]), [[], false]);
});

test('a request says when the person asked, by the clock of the server', async () => {
  await Sleep(300);
  const before = performance.now() / 1000;
  await other.request({ op: 'publish', path: '/wheels', value: '1' });
  const { at } = heard.at(-1);
  assert.ok(at >= before - 0.1 && at <= performance.now() / 1000, `${at}, asked at ${before}`);
});

test('a connection alone, before a sign of life has come over it, confirms nothing that was told over the one before', async () => {
  SetRobot(true, 'a colleague');
  await Sleep(50);
  assert.equal(stop.isConfirmed.value, true);
  isUnheard = true;
  for (const each of sockets.splice(0)) {
    each.close();
    each.onclose({ reason: '' });
  }
  await Sleep(500);
  assert.deepEqual(sockets.map(({ readyState }) => readyState), [1, 1], 'there are connections again');
  assert.equal(stop.isInForce.value, true, 'as it was told last');
  assert.equal(stop.isConfirmed.value, false, 'it may be another process, which has heard of no STOP');
  isUnheard = false;
  SetRobot(true, 'a colleague');
  await Sleep(50);
  assert.equal(stop.isConfirmed.value, true);
});
