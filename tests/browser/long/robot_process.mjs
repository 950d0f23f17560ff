// A robot that is a process: `runnel run`, which can be killed, frozen, and run again at the same place.

import { spawn } from 'node:child_process';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { createServer } from 'node:net';
import { tmpdir } from 'node:os';
import { join } from 'node:path';

async function FreePort() {
  const server = createServer();
  await new Promise((done) => { server.listen(0, '127.0.0.1', done); });
  const { port } = server.address();
  await new Promise((done) => { server.close(done); });
  return port;
}

export class RobotProcess {
  /** In a folder of its own; nothing runs yet. `change` may rewrite the demonstration's text; `options`, `environment`: of its run. */
  static async Begin({ change = (text) => text, options = [], environment = {} } = {}) {
    const robot = new RobotProcess();
    robot.options = options;
    robot.folder = await mkdtemp(join(tmpdir(), 'runnel_search_'));
    const text = await readFile(join(process.env.RUNNEL_XML, 'apps/bug_demo.xml'), 'utf8');
    robot.file = join(robot.folder, 'bug_demo.xml');
    await writeFile(robot.file, change(text.replaceAll('../worlds/', `${process.env.RUNNEL_XML}/worlds/`).replace('speed="10"', 'speed="1"')));
    robot.port = await FreePort();
    robot.url = `http://127.0.0.1:${robot.port}/`;
    robot.environment = { ...process.env, XDG_RUNTIME_DIR: robot.folder };
    robot.ofRun = environment;
    robot.away = { since: 0, is: true }; // nobody hears of it
    return robot;
  }

  #spawn(words, environment = {}) {
    const child = spawn(process.env.RUNNEL_PROGRAM, words, { stdio: ['ignore', 'pipe', 'pipe'], env: { ...this.environment, ...environment } });
    child.text = '';
    for (const stream of [child.stdout, child.stderr]) stream.on('data', (data) => { child.text = (child.text + data).slice(-4000); });
    child.ended = new Promise((done) => { child.on('exit', (code, signal) => done(code ?? signal)); });
    return child;
  }

  async start() {
    for (let left = 20; ; --left) {
      this.process = this.#spawn(['run', this.file, `--inspect=${this.port}`, '--quiet', ...this.options], this.ofRun);
      const isThere = await Promise.race([this.#isServed(), this.process.ended.then(() => false)]);
      if (isThere) break;
      if (left === 0) throw new Error(`the robot does not begin:\n${this.process.text}`);
    }
    this.#setAway(false);
  }

  async #isServed() {
    for (;;) {
      const reply = await fetch(this.url).catch(() => null);
      if (reply) return true;
      await new Promise((done) => { setTimeout(done, 20); });
    }
  }

  #setAway(is) {
    this.away = { is, since: performance.now() };
  }

  async kill() {
    this.#setAway(true);
    this.process.kill('SIGKILL');
    await this.process.ended;
  }

  async freeze(time, meanwhile) {
    this.#setAway(true);
    this.process.kill('SIGSTOP');
    const until = performance.now() + time;
    await meanwhile();
    await new Promise((done) => { setTimeout(done, Math.max(0, until - performance.now())); });
    this.process.kill('SIGCONT');
    this.#setAway(false);
  }

  /** A terminal's. */
  async command(...words) {
    return this.#spawn(words).ended;
  }

  get hasEnded() {
    return this.process.exitCode !== null || this.process.signalCode !== null;
  }

  async end() {
    await this.kill();
    await rm(this.folder, { recursive: true, force: true });
  }
}
