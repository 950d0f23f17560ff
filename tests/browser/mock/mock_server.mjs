// Serves the page and speaks its protocol for a MockApplication.

import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { join } from 'node:path';
import { WebSocketServer } from 'ws';

const kTypes = { '/': ['index.html', 'text/html'], '/page.js': ['page.js', 'text/javascript'],
  '/page.css': ['page.css', 'text/css'], '/panel': ['panel.html', 'text/html'], '/panel.js': ['panel.js', 'text/javascript'], '/panel.css': ['panel.css', 'text/css'], '/world_3d.js': ['world_3d.js', 'text/javascript'], '/icon.svg': ['icon.svg', 'image/svg+xml'] };
let runs = 0;
let viewers = 0;

/**
 * {url, port, close(), restart(), away(), application, watched(), asked(path)}; watched(): the ports that pages look at; asked(): how one was asked for
 * last; `page`: the folder of the bundle.
 */
export async function ServeMock(application, { page, port = 0, readOnly = false }) {
  const http = createServer(async (request, response) => {
    if (request.url === '/access') return response.writeHead(200).end('change');
    const entry = kTypes[request.url.split('?')[0]];
    if (!entry) return response.writeHead(404).end();
    response.writeHead(200, { 'content-type': entry[1] }).end(await readFile(join(page, entry[0])));
  });
  let isAway = false;
  const sockets = new WebSocketServer({ server: http, verifyClient: () => !isAway });
  let run = `run ${++runs}`;
  const clients = new Set();
  sockets.on('connection', (socket) => {
    const Kind = socket.protocol === 'runnel.stop.v1' ? StopClient : Client;
    const client = new Kind(socket, application, { run, readOnly, tellAll: (message) => clients.forEach((each) => each.tell?.(message)) });
    clients.add(client);
    socket.on('close', () => clients.delete(client));
  });
  const timer = setInterval(() => {
    if (!application.paused) application.time += 0.05 * (application.speed || 20);
    clients.forEach((client) => client.turn());
  }, 50);
  await new Promise((done) => { http.listen(port, '127.0.0.1', done); });
  return {
    application, port: http.address().port, url: `http://127.0.0.1:${http.address().port}/`,
    watched: () => [...clients].flatMap((client) => client.watched ?? []),
    asked: (path) => [...clients].map((client) => client.asked?.get(path)).find(Boolean),
    /** As if the application began anew. */
    restart: () => {
      run = `run ${++runs}`;
      for (const socket of sockets.clients) socket.terminate();
    },
    /** Nobody can reach it while `meanwhile` is under way. */
    away: async (meanwhile) => {
      isAway = true;
      for (const socket of sockets.clients) socket.terminate();
      await meanwhile();
      isAway = false;
    },
    close: async () => {
      clearInterval(timer);
      for (const socket of sockets.clients) socket.terminate();
      await new Promise((done) => { http.close(done); });
    },
  };
}

function IsDeaf({ isFrozen, saidAt }) {
  return isFrozen || saidAt !== null;
}

/** Tells each second, and when it has changed, how it stands with the STOP. */
class LifeSign {
  #turns = 0;
  #told = '';

  constructor(client) {
    this.client = client;
  }

  turn() {
    const { elements, drivesBeside, unreached, isBraking, isUnheard, stop: state } = this.client.application;
    if (isUnheard) return;
    const driving = [...elements.values()].filter((element) => element.driving).map(({ path }) => path);
    const reach = unreached && { unreached, ...state.in_force && { drives: [...driving, ...drivesBeside].join(', '), braking: isBraking } };
    const stop = { ...state, ...reach };
    if (++this.#turns % 20 !== 1 && this.#told === JSON.stringify(stop)) return;
    this.#told = JSON.stringify(stop);
    this.client.send({ op: 'alive', at: Now(this.client.application), stop });
  }
}

/** When what is sent now was said, in seconds of the machine's time. */
function Now({ saidAt }) {
  return saidAt ?? performance.now() / 1000;
}

function AnswerStop(application, op, { path, at }, by, reply) {
  if (op !== 'stop' && (op !== 'release' || path !== 'stop')) return false;
  if (op === 'release' && !(at >= (application.pressedAt ?? 0))) {
    reply({ ok: false, errors: [{ message: 'STOP was pressed or released after this was asked for', path: null, hint: null }] });
    return true;
  }
  if (op === 'stop') application.pressedAt = performance.now() / 1000;
  application.stop = { in_force: op === 'stop', by, since: application.time };
  reply({ ok: true, text: '' });
  return true;
}

/** A connection that bears the STOP alone. */
class StopClient {
  constructor(socket, application) {
    Object.assign(this, { socket, application, name: `viewer ${++viewers}` });
    this.alive = new LifeSign(this);
    this.backlog = [];
    socket.on('message', (text) => { this.backlog.push(text); this.#read(); });
  }

  #read() {
    while (!IsDeaf(this.application) && !this.application.isOwnDeaf && this.backlog.length > 0) this.#answer(JSON.parse(this.backlog.shift()));
  }

  #answer({ op, request, ...asked }) {
    const { application, socket } = this;
    const reply = (told) => this.send({ op: 'reply', request, ...told });
    application.asked.push({ op, ...asked, by: this.name, isOwn: true });
    if (application.answers[op]) application.answers[op](reply, asked, socket);
    else AnswerStop(application, op, asked, this.name, reply);
  }

  send(message) {
    this.socket.send(JSON.stringify(message));
  }

  turn() {
    this.#read();
    if (!this.application.isFrozen && !this.application.isOwnSilent) this.alive.turn();
  }
}

class Client {
  #watched = new Map(); // path -> how many values have been sent
  #told = new Map();    // path -> what has been sent last, and when that was
  #lastState = '';
  #rated = 0;

  constructor(socket, application, { run, readOnly, tellAll }) {
    Object.assign(this, { socket, application, readOnly, tellAll });
    this.rates = false;
    this.asked = new Map(); // port path -> the message that asked for its values
    this.name = `viewer ${++viewers}`;
    this.backlog = [];
    socket.on('message', (text) => { this.backlog.push(text); this.#read(); });
    this.send({ op: 'hello', protocol: 1, application: application.name, file: `/mock/${application.name}.xml`, run,
      clock: 'simulated', viewer: this.name, read_only: readOnly, runnel: '0.0.0' });
    this.send({ op: 'catalogue', ...application.catalogue });
    this.isTold = false;
    this.alive = new LifeSign(this);
    setTimeout(() => this.#tell(), application.delay);
  }

  #tell() {
    const { application } = this;
    this.isTold = true;
    this.send({ op: 'structure', revision: application.revision, ...application.structure });
    this.send({ op: 'layout', entries: application.layout });
    this.send({ op: 'log', entries: application.log });
    this.turn();
  }

  get watched() {
    return [...this.#watched.keys()];
  }

  tell(message) {
    this.send(message);
  }

  get isStuck() {
    return IsDeaf(this.application) || this.application.isHanging;
  }

  #read() {
    while (!this.isStuck && this.backlog.length > 0) this.#receive(JSON.parse(this.backlog.shift()));
  }

  send(message) {
    this.socket.send(JSON.stringify(message));
  }

  turn() {
    const { application } = this;
    this.#read();
    if (!this.isTold || application.isFrozen || application.isHanging) return;
    this.alive.turn();
    const state = JSON.stringify(application.state);
    if (state !== this.#lastState) this.send({ op: 'state', ...application.state });
    this.#lastState = state;
    const items = [];
    for (const [path, count] of this.#watched) {
      const value = application.values[path]?.(application.time);
      if (value === undefined) continue;
      // Nothing is published while the application stands still, unless somebody has set another value.
      const told = `${application.time} ${JSON.stringify(value)}`;
      if (this.#told.get(path) === told) continue;
      this.#told.set(path, told);
      this.#watched.set(path, count + 1);
      items.push({ path, stamp: application.time, count: count + 1, value, cut: application.cut.has(path) });
    }
    if (items.length > 0) this.send({ op: 'values', time: application.time, items });
    if (this.rates && ++this.#rated % 10 === 1) this.#sendRates();
  }

  #sendRates() {
    const ports = {};
    const threads = {};
    for (const { path, kind, direction } of this.application.elements.values()) {
      if (kind === 'port' && direction === 'output') ports[path] = this.application.silent?.has(path) ? 0 : 20 + (this.#rated % 3) * 0.1;
      if (kind === 'thread') {
        threads[path] = { cycles: this.#rated, period_ms: 50, duration_ms: { mean: 0.18, max: 1.2 }, jitter_ms: 0.01,
          overruns: this.application.overruns[path] ?? 0 };
      }
    }
    this.send({ op: 'rates', time: this.application.time, ports, threads });
  }

  #receive(message) {
    if (message.op === 'watch') {
      this.#watched.set(message.path, 0);
      this.#told.delete(message.path);
      this.asked.set(message.path, message);
    } else if (message.op === 'unwatch') this.#watched.delete(message.path);
    else if (message.op === 'watch_rates') this.rates = message.rate > 0;
    else this.#answer(message);
  }

  #answer({ op, request, ...asked }) {
    const { application } = this;
    const reply = (told) => this.send({ op: 'reply', request, ...told });
    application.asked.push({ op, ...asked, by: this.name });
    if (application.answers[op]) return application.answers[op](reply, asked, this.socket);
    const refuse = (text) => reply({ ok: false, errors: [{ message: text, path: '', hint: '', change: null }] });
    if (this.readOnly && !['compatible', 'panel', 'stop'].includes(op)) return refuse('the application can be watched only');
    const before = application.structure;
    const count = application.log.length;
    const finish = (ok, told = {}) => {
      const difference = application.difference(before);
      this.tellAll(difference);
      const entries = application.log.slice(count);
      if (entries.length > 0) this.tellAll({ op: 'log', entries });
      if (ok) reply({ ok: true, text: '', ...told });
    };
    if (op === 'change') {
      const errors = application.change(asked.changes, asked.label, this.name);
      return errors.length > 0 ? reply({ ok: false, errors }) : finish(true);
    }
    if (op === 'undo' || op === 'redo') {
      const [from, to] = op === 'undo' ? [application.past, application.future] : [application.future, application.past];
      const step = application.travel(from, to);
      return step ? finish(true, { text: `${op === 'undo' ? 'undone' : 'redone'}: ${step.label}`, client: step.client }) : refuse(`nothing to ${op}`);
    }
    if (op === 'compatible') {
      const types = application.catalogue.modules.map(({ type, summary }) => ({ type, summary, lost: application.lost ?? [] }));
      return reply({ ok: true, text: '', types });
    }
    if (AnswerStop(application, op, asked, this.name, reply)) return undefined;
    if (op === 'panel') return reply({ ok: true, text: application.panel, file: '/mock/robot.panel.json' });
    if (op === 'save_panel') {
      application.panel = asked.value;
      return reply({ ok: true, text: 'saved the panel' });
    }
    if (op === 'publish' || op === 'release') return reply({ ok: true, text: '' });
    if (op === 'arrange') {
      Object.assign(application.layout, asked.entries);
      this.tellAll({ op: 'layout', entries: asked.entries });
      return reply({ ok: true, text: '' });
    }
    if (op === 'pause') application.paused = true;
    else if (op === 'resume') application.paused = false;
    else if (op === 'speed') application.speed = asked.speed;
    else if (op === 'step') { application.paused = true; application.time += 0.05 * asked.cycles; }
    else if (op === 'save' && asked.file === 'other.xml' && !asked.overwrite) {
      return reply({ ok: false, needs: 'overwrite', errors: [{ message: 'other.xml is another application', path: null, hint: null, change: null }] });
    } else if (op !== 'save') return refuse(`the mock knows no '${op}'`);
    return reply({ ok: true, text: op === 'save' ? 'Saved nowhere' : '' });
  }
}
