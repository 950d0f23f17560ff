// Looks at ports of a robot, by the page's protocol, and says when they had a value that moves or a safe one: by the machine's
// wall clock in ms, from the stamp that the robot gave the value.

import { performance } from 'node:perf_hooks';
import { WebSocket } from 'ws';

const kPatience = 10000; // ms

function Moves(value) {
  return typeof value === 'number' ? value !== 0 : Object.values(value).some(Moves);
}

export class HoldWatcher {
  #last = new Map();     // path -> {moves, at}
  #waiting = null;       // {path, moves, done}
  #offset = Infinity;    // of the robot's clock: what came quickest is nearest to it

  static async Connect(url, paths) {
    const watcher = new HoldWatcher();
    watcher.socket = new WebSocket(url.replace('http', 'ws'), 'runnel.inspector.v1');
    watcher.socket.on('message', (data) => {
      const message = JSON.parse(data);
      if (message.op === 'values') watcher.#take(message);
    });
    await new Promise((done) => { watcher.socket.on('open', done); });
    for (const path of paths) watcher.socket.send(JSON.stringify({ op: 'watch', path, rate: 60 }));
    return watcher;
  }

  #take({ time, items }) {
    this.#offset = Math.min(this.#offset, performance.timeOrigin + performance.now() - time * 1000);
    for (const { path, stamp, value } of items) {
      const moves = Moves(value);
      if (this.#last.get(path)?.moves !== moves) this.#last.set(path, { moves, at: stamp * 1000 + this.#offset });
    }
    this.#look();
  }

  #look() {
    const last = this.#last.get(this.#waiting?.path);
    if (last?.moves !== this.#waiting?.moves || !last) return;
    const { done } = this.#waiting;
    this.#waiting = null;
    done(last.at);
  }

  /** Since when the port's value moves, or is safe; waits until it is so. */
  until(path, moves, patience = kPatience) {
    return new Promise((done, fail) => {
      const timer = setTimeout(() => { this.#waiting = null; fail(new Error(`${path} ${moves ? 'does not move' : 'moves on'}`)); }, patience);
      this.#waiting = { path, moves, done: (at) => { clearTimeout(timer); done(at); } };
      this.#look();
    });
  }

  close() {
    this.socket.terminate();
  }
}
