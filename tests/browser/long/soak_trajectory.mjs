// Whether a robot on simulated time drives as if nobody were there, where viewers only come and go.

import { execFile } from 'node:child_process';
import { join } from 'node:path';
import { promisify } from 'node:util';
import { WebSocket } from 'ws';
import { SoakRobot } from './soak_robot.mjs';

// All poses, one a line; those of the end that one run has not written are left out of both.
const kCompare = `
import sys, runnel
first, second = (runnel.read(name)["/world/pose"] for name in sys.argv[1:3])
size = min(len(first.times), len(second.times))
print(size, all((first[name][:size] == second[name][:size]).all() for name in ("x", "y", "heading")),
      max(first["x"]) - min(first["x"]))
`;

async function Look(robot, random) {
  const socket = new WebSocket(robot.url.replace('http', 'ws'), 'runnel.inspector.v1');
  socket.on('error', () => {});
  await new Promise((done) => { socket.on('open', done); socket.on('close', done); });
  for (const path of ['/world/output/pose', '/laser/output/scan', '/robot/gate/output/allowed']) {
    if (socket.readyState === WebSocket.OPEN) socket.send(JSON.stringify({ op: 'watch', path, rate: 60 }));
  }
  await fetch(`${robot.url}panel`).then((reply) => reply.text()).catch(() => {});
  await new Promise((done) => { setTimeout(done, 50 + random.below(500)); });
  socket.terminate();
}

async function Run(seconds, folder, name, random) {
  const file = join(folder, name);
  const robot = await SoakRobot({ clock: '<clock type="simulated" speed="5"/>',
    options: [`--duration=${seconds}`, `--record=${file}`, '--record-ports=/world/pose'] });
  await robot.start();
  for (; !robot.hasEnded; await new Promise((done) => { setTimeout(done, 20); })) {
    if (random) await Promise.all([Look(robot, random), Look(robot, random)]);
  }
  await robot.end();
  return file;
}

/** '': they are the same. `seconds`: simulated, for each of two runs. */
export async function TrajectoriesDiffer(seconds, random, folder) {
  const files = [await Run(seconds, folder, 'alone.mcap', null), await Run(seconds, folder, 'looked_at.mcap', random)];
  const environment = { ...process.env, PYTHONPATH: process.env.RUNNEL_PYTHON ?? '' };
  const { stdout } = await promisify(execFile)(process.env.RUNNEL_PYTHON_PROGRAM ?? 'python3', ['-c', kCompare, ...files], { env: environment });
  const [size, areSame, way] = stdout.trim().split(' ');
  if (Number(size) < seconds * 10 || Number(way) < 0.1) return `the trajectories say nothing: ${stdout}`;
  return areSame === 'True' ? '' : `the trajectory is another one where viewers look: ${size} poses`;
}
