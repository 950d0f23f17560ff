// A robot that runs for long, with page, panel, recording, network and a module in Python, and a client that does at random
// what people do: node soak.mjs --seconds 1800 --seed 1. In rounds: after each of them all that was changed has been undone and
// nobody looks on, and then the robot is as at the start and uses no more than after the warm-up. STOP holds throughout, no
// lock is held for more than 50 ms. Before that, robots on simulated time: where viewers only look, it drives as without them.

import { mkdir, rm, truncate } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { WebSocket } from 'ws';
import { Random } from './random.mjs';
import { Growth, Holds, Use } from './soak_figures.mjs';
import { Reader, SoakRobot } from './soak_robot.mjs';
import { TrajectoriesDiffer } from './soak_trajectory.mjs';
import { Watcher } from './watcher.mjs';

const { values: asked } = parseArgs({ options: { seconds: { type: 'string', default: '1800' }, seed: { type: 'string', default: '1' } } });
const kSeconds = Number(asked.seconds);
const kStepsOfRound = 25;
const kPlanners = ['bug1', 'bug2', 'tangent_bug', 'dist_bug'];
const kPlugins = ['motion', 'planning', 'simulation', 'adaptors', 'python'];
const kTexts = ['ps', 'list', 'log', 'events', 'threads', 'network'];

const random = new Random(Number(asked.seed));
const begin = performance.now();
const found = [];
const counts = { rounds: 0, steps: 0, presses: 0, confirmed: 0, driven: 0, changes: 0, refused: 0, undone: 0, reloads: 0, viewers: 0, terminals: 0, readers: 0 };
let last = '';
let open = []; // viewers
let depth = 0; // changes that can be undone
let names = 0;

const Elapsed = () => (performance.now() - begin) / 1000;
const Sleep = (time) => new Promise((done) => { setTimeout(done, time); });

function Found(what) {
  found.push(`${Elapsed().toFixed(0)} s, round ${counts.rounds}, after '${last}': ${what}`);
  console.log(found.at(-1));
}

const folder = join(tmpdir(), `runnel_soak_${process.pid}`);
await mkdir(folder);
const difference = await TrajectoriesDiffer(Math.max(10, Math.min(120, kSeconds / 10)), random, folder);
if (difference) Found(difference);
console.log(difference ? 'viewers change what it does' : 'the trajectory is as without viewers');

const locks = join(folder, 'locks.txt');
const robot = await SoakRobot({ clock: '<clock type="real"/>',
  options: [`--record=${join(folder, 'run.mcap')}`, '--record-ports=/world/pose', '--record-ports=/robot/**'],
  environment: { LD_PRELOAD: process.env.RUNNEL_LOCK_WATCH_LIBRARY ?? '', RUNNEL_LOCK_WATCH: locks } });
const watcher = new Watcher(robot, Found);
const reader = new Reader(robot);

async function Change(change) {
  last = JSON.stringify(change);
  const reply = await watcher.ask({ op: 'change', changes: [change], label: change.change });
  counts.changes += 1;
  if (reply.ok) depth += 1;
  else counts.refused += 1;
}

async function Undo() {
  if (depth === 0) return;
  last = 'undo';
  const reply = await watcher.ask({ op: 'undo' });
  depth -= 1;
  counts.undone += 1;
  if (!reply.ok) Found(`an undo is refused: ${JSON.stringify(reply)}`);
}

async function Press() {
  counts.presses += 1;
  const how = random.below(3);
  last = `press, ${how}`;
  const isConfirmed = how === 0 ? await robot.command('stop') === 0
    : (await (how === 1 ? watcher.stop : watcher).ask({ op: 'stop' })).ok === true;
  if (!isConfirmed) return;
  counts.confirmed += 1;
  watcher.mustBeStopped(['a terminal', 'the connection of STOP', 'the main connection'][how]);
}

async function Release() {
  last = 'release';
  watcher.mayBeReleased();
  return watcher.release();
}

async function Drive() {
  const port = random.of(watcher.driving());
  if (!port || !/Twist2|WheelSpeeds/.test(port.data_type)) return;
  last = `drive ${port.path}`;
  counts.driven += 1;
  const value = port.data_type === 'Twist2' ? '{forward: 0.2, turn: 0.1}' : '{left: 4, right: 5}';
  await watcher.ask({ op: 'publish', path: port.path, value, deadline: 0.25, lease: `lease ${++names}` });
}

/** A viewer comes: the page's protocol, some ports, the STOP's connection. */
async function Look() {
  last = 'a viewer comes';
  counts.viewers += 1;
  const socket = new WebSocket(robot.url.replace('http', 'ws'), random.below(4) === 0 ? 'runnel.stop.v1' : 'runnel.inspector.v1');
  socket.on('error', () => {});
  open.push(socket);
  await new Promise((done) => { socket.on('open', done); socket.on('close', done); });
  for (let i = 0; i < 5; ++i) {
    const port = random.of(watcher.ports());
    if (port && socket.protocol === 'runnel.inspector.v1') socket.send(JSON.stringify({ op: 'watch', path: port.path, rate: 60 }));
  }
  for (const page of ['', 'panel']) await fetch(robot.url + page).then((reply) => reply.text()).catch(() => {});
}

async function Swap() {
  const part = random.of(watcher.modules());
  if (!part) return;
  const type = part.type.startsWith('planning/') ? `planning/${random.of(kPlanners)}` : part.type;
  await Change({ change: 'replace', path: part.path, type, probation: 0 });
}

async function CutOrMend() {
  const [from] = [random.of(watcher.connections())];
  if (from && !/network|recorder/.test(from.to)) await Change({ change: 'disconnect', from: from.from, to: from.to });
}

const OnPart = (change) => async () => {
  const part = random.of(watcher.parts());
  if (part) await Change({ ...change(), path: part.path });
};

const kActions = [
  [3, Press], [5, Release], [5, Drive], [4, Look],
  [2, async () => { last = 'a viewer goes'; open.shift()?.terminate(); }],
  [1, async () => { last = 'terminal'; counts.terminals += 1; await robot.command(random.of(kTexts)); }],
  [3, OnPart(() => ({ change: 'rename', name: `part${++names}` }))],
  [2, OnPart(() => ({ change: 'delete' }))],
  [1, OnPart(() => ({ change: 'copy' }))],
  [4, Swap], [2, CutOrMend], [5, Undo],
  [4, async () => { await Sleep(20 + random.below(150)); }],
];

async function Do() {
  let place = random.below(kActions.reduce((sum, [weight]) => sum + weight, 0));
  for (const [weight, act] of kActions) {
    if ((place -= weight) < 0) return act();
  }
  return undefined;
}

const Structure = () => [...watcher.parts().map(({ path, type }) => `${path} ${type ?? ''}`), ...watcher.connections().map(({ from, to }) => `${from} > ${to}`)]
  .filter((line) => !/\/network/.test(line)).sort();

/** All is undone, nobody looks on, nothing is stopped. */
async function Settle() {
  while (depth > 0 && !robot.hasEnded) await Undo();
  for (const socket of open.splice(0)) socket.terminate();
  counts.reloads += 1;
  const plugin = kPlugins[counts.reloads % kPlugins.length];
  last = `reload ${plugin}`;
  await watcher.ask({ op: 'reload', plugin });
  for (const { path } of watcher.driving()) await watcher.ask({ op: 'release', path });
  await Release();
  await Sleep(600); // what goes, goes in threads of its own
}

await robot.start();
await watcher.connect();
await reader.start();
await truncate(locks, 0).catch(() => {}); // what a start takes is nobody's pause
const first = Structure();
const samples = [];
let warm = 0; // samples of the warm-up
for (const start = Elapsed(); Elapsed() < Math.max(kSeconds, start + 10) && !robot.hasEnded && found.length < 10; ++counts.rounds) {
  if (counts.rounds % 10 === 9) { await reader.end(); await reader.start(); counts.readers += 1; }
  for (let i = 0; i < kStepsOfRound && !robot.hasEnded; ++i, ++counts.steps) {
    await Do();
    await watcher.settle();
  }
  await Settle();
  if (robot.hasEnded) break;
  const now = Structure();
  const others = [...now.filter((each) => !first.includes(each)).map((each) => `+ ${each}`), ...first.filter((each) => !now.includes(each)).map((each) => `- ${each}`)];
  if (others.length > 0) { Found(`all is undone, and it is not as at the start: ${others.join(', ')}`); break; }
  samples.push(await Use(robot.process.pid));
  if (Elapsed() - start < (kSeconds - start) / 4) warm = samples.length;
  const { memory, libraries, descriptors, threads } = samples.at(-1);
  console.log(`${Elapsed().toFixed(0).padStart(5)} s  ${memory} kB and ${libraries} kB of libraries, ${descriptors} descriptors, ${threads} threads`);
}
if (robot.hasEnded) Found(`the robot has ended (${robot.process.exitCode ?? robot.process.signalCode}):\n${robot.process.text}`);
for (const what of Growth(samples.slice(warm))) Found(what);
const holds = await Holds(locks);
for (const what of holds.tooLong.slice(0, 5)) Found(what);
if (counts.confirmed === 0 || watcher.stopped === 0 || watcher.moving === 0) Found('nothing was stopped, or nothing moved: this run has looked at nothing');

console.log(`seed ${asked.seed}: ${Object.entries(counts).map(([name, count]) => `${count} ${name}`).join(', ')}`);
console.log(`${watcher.values} values of driving ports came, ${watcher.stopped} under STOP, ${watcher.moving} that moved`);
console.log(`longest hold of a lock: ${holds.longest} ms  ${holds.at}`);
console.log(`${found.length} found, ${Math.round(Elapsed())} s`);
watcher.main.close();
watcher.stop.close();
await reader.end();
await robot.end();
await rm(folder, { recursive: true, force: true });
process.exit(found.length > 0 ? 1 : 0);
