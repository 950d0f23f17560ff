// Looks at all driving ports of a robot, by the page's protocol: under STOP none may have another value than its safe one, and
// after it none that was published before the release.

import { WebSocket } from 'ws';

const kPatience = 20000; // ms

/** A connection, with requests that are answered; {lost: true} if it breaks. */
class Connection {
  #requests = new Map();
  #next = 1;

  constructor(url, protocol, onMessage) {
    this.socket = new WebSocket(url.replace('http', 'ws'), protocol);
    this.opened = new Promise((done) => { this.socket.on('open', () => done(true)); this.socket.on('close', () => done(false)); });
    this.socket.on('error', () => {});
    this.socket.on('message', (data) => {
      const message = JSON.parse(data);
      if (message.op === 'reply') this.#answer(message.request, message);
      onMessage(message, this);
    });
    this.socket.on('close', () => { for (const number of [...this.#requests.keys()]) this.#answer(number, { lost: true }); });
  }

  #answer(number, reply) {
    this.#requests.get(number)?.(reply);
    this.#requests.delete(number);
  }

  send(message) {
    if (this.socket.readyState === WebSocket.OPEN) this.socket.send(JSON.stringify(message));
  }

  ask(message) {
    const number = this.#next++;
    if (this.socket.readyState !== WebSocket.OPEN) return Promise.resolve({ lost: true });
    return new Promise((resolve) => {
      this.#requests.set(number, resolve);
      setTimeout(() => this.#answer(number, { lost: true, isLate: true }), kPatience).unref();
      this.send({ ...message, request: number });
    });
  }

  close() {
    this.socket.terminate();
  }
}

function IsSafe(value) {
  return typeof value === 'number' ? value === 0 : Object.values(value).every(IsSafe);
}

export class Watcher {
  values = 0;
  stopped = 0;
  moving = 0;
  #elements = new Map();
  #connections = [];
  #watched = new Set();
  #mayBeReleased = true; // somebody may have asked for the release of the STOP of `#pressedAt`, or of one before it
  #pressedAt = null;
  #told = null;          // {in_force, since} by this connection
  #at = 0;               // of the newest sign of life, s of the machine's time
  #mustBeStopped = '';   // how it was pressed, and confirmed; since then nobody has asked for a release
  /** As the robot has told last, by any connection: {in_force, since: when that was heard here first}. */
  truth = { in_force: false, since: 0 };

  constructor(robot, found) {
    this.robot = robot;
    this.found = found;
  }

  /** Anew; what was confirmed before still holds. */
  async connect() {
    this.main?.close();
    this.stop?.close();
    for (const begin = performance.now(); ; await new Promise((done) => { setTimeout(done, 20); })) {
      this.#told = null;
      this.#watched.clear();
      this.#elements.clear();
      this.main = new Connection(this.robot.url, 'runnel.inspector.v1', (message, from) => this.#receive(message, from));
      this.stop = new Connection(this.robot.url, 'runnel.stop.v1', () => {});
      const isThere = await this.main.opened && await this.stop.opened;
      if (isThere && await this.#until(() => this.#elements.size > 0 && this.#told !== null, 5000)) return;
      this.main.close();
      this.stop.close();
      if (performance.now() - begin > kPatience) throw new Error(`the robot cannot be reached:\n${this.robot.process.text}`);
    }
  }

  async #until(holds, time) {
    for (const end = performance.now() + time; performance.now() < end;) {
      if (holds()) return true;
      if (this.main.socket.readyState > WebSocket.OPEN) return false;
      await new Promise((done) => { setTimeout(done, 5); });
    }
    return false;
  }

  ask(message) {
    return this.main.ask(message);
  }

  /** From now on it may be released at any time; a STOP that is pressed later may not. */
  mayBeReleased() {
    this.#mustBeStopped = '';
    this.#mayBeReleased = true;
    this.#pressedAt = this.#told?.since;
  }

  /** The robot has confirmed a press: `how`. */
  mustBeStopped(how) {
    this.#mustBeStopped = how;
  }

  release() {
    return this.ask({ op: 'release', path: 'stop', at: this.#at });
  }

  #receive(message, from) {
    if (from !== this.main) return;
    if (message.op === 'alive') this.#at = message.at;
    if (message.op === 'alive') this.#hear(message.stop);
    else if (message.op === 'structure') this.#takeAll(message);
    else if (message.op === 'structure_change') this.#takeChange(message);
    else if (message.op === 'values') for (const item of message.items) this.#look(item);
  }

  #hear(stop) {
    if (!stop.in_force && this.truth.in_force && !this.#mayBeReleased) this.found('STOP is not in force any more, and nobody has released it');
    if (stop.in_force && stop.since !== this.#pressedAt) this.#mayBeReleased = false;
    if (stop.in_force !== this.truth.in_force) this.truth = { in_force: stop.in_force, since: performance.now() };
    this.#told = stop;
  }

  #look({ path, value, stamp }) {
    if (!this.#elements.get(path)?.driving) return; // it was watched before it was deleted
    this.values += 1;
    if (this.#told.in_force) this.stopped += 1;
    if (IsSafe(value)) return;
    this.moving += 1;
    if (this.#told.in_force) this.found(`${path} is ${JSON.stringify(value)}`);
    else if (stamp < this.#told.since - 1e-6) this.found(`${path} is ${JSON.stringify(value)} of ${stamp} s, and was released at ${this.#told.since} s`);
  }

  #takeAll({ elements, connections }) {
    this.#elements = new Map(elements.map((each) => [each.path, each]));
    this.#connections = connections;
    this.#watched.clear();
    this.#watch();
  }

  #takeChange({ gone = [], elements = [], connected = [], disconnected = [] }) {
    for (const path of gone) this.#elements.delete(path);
    for (const each of elements) this.#elements.set(each.path, each);
    const isOf = (one) => (other) => one.from === other.from && one.to === other.to;
    this.#connections = [...this.#connections.filter((each) => !disconnected.some(isOf(each))), ...connected];
    for (const path of [...gone, ...elements.map(({ path: each }) => each)]) this.#watched.delete(path);
    this.#watch();
  }

  #watch() {
    for (const { path } of this.driving()) {
      if (this.#watched.has(path)) continue;
      this.#watched.add(path);
      this.main.send({ op: 'watch', path, rate: 60 });
    }
  }

  #all(kind) {
    return [...this.#elements.values()].filter((each) => each.kind === kind);
  }

  ports() { return this.#all('port'); }
  driving() { return this.ports().filter(({ driving, direction }) => driving && direction === 'input'); }
  modules() { return this.#all('module'); }
  parts() { return [...this.modules(), ...this.#all('group').filter(({ is_plain: isPlain }) => !isPlain)]; }
  connections() { return this.#connections; }

  /** Until the robot has said how it stands after all that it was asked for, also by others. */
  async settle() {
    if (this.robot.hasEnded) return;
    if (this.main.socket.readyState !== WebSocket.OPEN || this.stop.socket.readyState !== WebSocket.OPEN) await this.connect();
    await this.ask({ op: 'conversions', from: '/', to: '/' });
    if (this.#mustBeStopped && this.main.socket.readyState === WebSocket.OPEN) {
      if (!this.#told.in_force) this.found(`STOP is not in force, and was confirmed to ${this.#mustBeStopped}`);
      this.#mustBeStopped = '';
    }
  }

  /** Whether there is a robot that is worth looking at. */
  async isGood() {
    return !this.robot.hasEnded && this.driving().length >= 2;
  }
}
