// A random search for a way around STOP in processes that are killed, frozen, run anew and cut off, and for pages that say
// otherwise: node stop_search.mjs --seed 7 --steps 1000 --browser 500. With the browser two pages look on (the inspector's and the
// operator's panel), press and release. The seed chooses what is done; when it happens is up to the machine.

import { parseArgs } from 'node:util';
import { FindBrowser } from '../support/find_browser.mjs';
import { Random } from './random.mjs';
import { RobotProcess } from './robot_process.mjs';
import { Watcher } from './watcher.mjs';

const { values: asked } = parseArgs({ options: { seed: { type: 'string', default: '1' }, steps: { type: 'string', default: '300' },
  browser: { type: 'string', default: '0' } } });
const kMostFound = 10;
const kLongestLie = 3000; // ms that a page may say what is not so
const kPlanners = ['bug1', 'bug2', 'tangent_bug', 'dist_bug'];

const random = new Random(Number(asked.seed));
const found = [];
const counts = { steps: 0, presses: 0, confirmed: 0, refused: 0, killed: 0, frozen: 0, restarted: 0, reloaded: 0, cut: 0, held: 0, 'by pages': 0 };
let last = '';

function Found(what) {
  found.push(`step ${counts.steps}, after '${last}': ${what}`);
  console.log(found.at(-1));
}

const Sleep = (time) => new Promise((done) => { setTimeout(done, time); });
const robot = await RobotProcess.Begin();
const watcher = new Watcher(robot, Found);
let pages = null;
let names = 0;

/** What is asked for goes to the robot, or is lost with it: both are fine. */
async function Ask(message) {
  last = JSON.stringify(message);
  const reply = await watcher.ask(message);
  if (reply.ok === false) counts.refused += 1;
  return reply;
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
  return random.below(2) === 0 ? robot.command('release') : watcher.release();
}

const Part = () => random.of(watcher.parts());
const Drives = () => random.of(watcher.driving());
const kMotions = { Twist2: '{forward: 0.3, turn: 0.1}', WheelSpeeds: '{left: 4, right: 5}' };

async function Publish() {
  const port = Drives();
  if (!port) return;
  const often = [{}, { rate: 20 }, { deadline: 0.25, lease: `lease ${++names}` }][random.below(3)];
  await Ask({ op: 'publish', path: port.path, value: kMotions[port.data_type], ...often });
}

const Change = (change) => Ask({ op: 'change', changes: [change], label: change.change });

async function CutOrMend() {
  const to = Drives();
  if (!to) return;
  const [from] = watcher.connections().filter((each) => each.to === to.path);
  if (from) return Change({ change: 'disconnect', from: from.from, to: to.path });
  const other = random.of(watcher.ports().filter((each) => each.direction === 'output' && each.data_type === to.data_type));
  return other && Change({ change: 'connect', from: other.path, to: to.path });
}

async function Swap() {
  const part = random.of(watcher.modules());
  if (!part) return;
  const type = part.type.startsWith('planning/') ? `planning/${random.of(kPlanners)}` : part.type;
  await Change({ change: 'replace', path: part.path, type, probation: 0 });
}

async function Kill() {
  last = 'kill -9, and run again';
  counts.killed += 1;
  await robot.kill();
  await robot.start();
  await watcher.connect();
}

async function Restart() {
  await Ask({ op: 'restart', path: '' });
  counts.restarted += 1;
  await watcher.connect();
}

async function Freeze() {
  const time = random.below(20) === 0 || (pages && random.below(3) === 0) ? 3500 : 20 + random.below(400);
  last = `frozen for ${time} ms`;
  counts.frozen += 1;
  await robot.freeze(time, async () => { if (pages && random.below(3) === 0) await pages.press(random); });
}

async function Cut() {
  last = 'the connection is lost';
  counts.cut += 1;
  if (pages && random.below(2) === 0) return pages.cut(random.below(2) === 0 ? 3500 : 200);
  return watcher.connect();
}

const kActions = [
  [4, Press], [5, Release], [4, Publish],
  [3, async () => { const port = Drives(); if (port) await Ask({ op: 'release', path: port.path }); }],
  [2, async () => { const port = Drives(); if (port) await Ask({ op: 'block', path: port.path }); }],
  [2, CutOrMend],
  [3, async () => { const part = Part(); if (part) await Change({ change: 'rename', path: part.path, name: `part${++names}` }); }],
  [1, async () => { const part = Part(); if (part) await Change({ change: 'delete', path: part.path }); }],
  [1, async () => { const part = Part(); if (part) await Change({ change: 'copy', path: part.path }); }],
  [3, Swap], [5, () => Ask({ op: 'undo' })], [2, () => Ask({ op: 'redo' })],
  [2, async () => { const part = random.of(watcher.modules()); if (part) await Ask({ op: 'restart', path: part.path }); }],
  [1, async () => { counts.reloaded += 1; await Ask({ op: 'reload', plugin: random.of(['motion', 'planning', 'simulation', 'adaptors']) }); }],
  [1, Restart], [1, Kill], [2, Freeze], [2, Cut],
  [14, async () => { last += ', and a while'; await Sleep(10 + random.below(90)); }],
];
const kOfPages = [
  [4, async () => { last = 'press at a page'; counts['by pages'] += 1; await pages.press(random); }],
  [4, async () => { last = 'release at a page'; watcher.mayBeReleased(); await pages.release(random); }],
  [3, async () => { last = 'driven at the panel'; counts.held += 1; await pages.drive(100 + random.below(500)); }],
  [6, async () => { last += ', and a while'; await Sleep(500); }],
];

async function Do(actions) {
  let place = random.below(actions.reduce((sum, [weight]) => sum + weight, 0));
  for (const [weight, act] of actions) {
    if ((place -= weight) < 0) return act();
  }
  return undefined;
}

/** Each action once, then what the seed chooses. */
async function Search(steps, actions) {
  const once = actions.map(([, act]) => act);
  for (const end = counts.steps + steps; counts.steps < end && found.length < kMostFound; ++counts.steps) {
    if (!await watcher.isGood()) await Kill(); // too much has been deleted, or its run has ended
    await (once.length > 0 ? once.shift()() : Do(actions));
    await watcher.settle();
    await pages?.check(Found);
  }
}

await robot.start();
await watcher.connect();
const begin = performance.now();
await Search(Number(asked.steps), kActions);
if (Number(asked.browser) > 0) {
  process.env.RUNNEL_BROWSER = FindBrowser() ?? '';
  if (!process.env.RUNNEL_BROWSER) throw new Error('chromium is not here');
  const { Pages } = await import('./pages.mjs');
  pages = await Pages.Open(robot, watcher, kLongestLie);
  await Search(Number(asked.browser), [...kActions, ...kOfPages]);
  await pages.settled();
  await pages.check(Found);
}
console.log(`seed ${asked.seed}: ${Object.entries(counts).map(([name, count]) => `${count} ${name}`).join(', ')}`);
console.log(`${watcher.values} values of driving ports came, ${watcher.stopped} under STOP, ${watcher.moving} that moved`);
if (pages) console.log(`${pages.looks} looks at pages; the longest that one said otherwise: ${Math.round(pages.longest)} ms`);
const kNothing = { 'presses were confirmed': counts.confirmed, 'values came under STOP': watcher.stopped, 'values moved': watcher.moving,
  ...Object.fromEntries(Object.entries(pages?.right ?? {}).map(([what, count]) => [`claims of ${what} were right`, count])) };
const missing = counts.steps === 0 ? [] : Object.entries(kNothing).filter(([, count]) => count === 0).map(([what]) => what);
for (const what of missing) console.log(`no ${what}: this search has looked at nothing`);
console.log(`${found.length} ways around STOP, ${Math.round((performance.now() - begin) / 1000)} s`);
await pages?.close();
await robot.end();
process.exit(found.length + missing.length > 0 ? 1 : 0);
