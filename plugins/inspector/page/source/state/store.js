// All that the page knows, as signals: what the server has told, and what the user has chosen.

import { batch, computed, signal } from '@preact/signals';
import { Link } from '../connection/link.js';
import { Keep, OwnStorage, TakeToken } from '../connection/token.js';
import { Watches } from '../connection/watches.js';
import { Catalogue } from '../model/catalogue.js';
import { OriginsOf } from '../model/origin.js';
import { Structure } from '../model/structure.js';
import { ForgetArrangement, TakeArrangement } from './arrangement.js';
import { AddLogEntries } from './log.js';
import { ShowNetwork, network } from './network.js';
import { Silence } from './silence.js';
import { OtherIs, ShowToken, StartStop, TakeFromOther, UseOther } from '../stop/stop_state.js';

export const connection = signal({ state: 'connecting', reason: '', since: 0 });
export const hello = signal(null);
export const catalogue = signal(new Catalogue());
export const structure = new Structure();
export const revision = signal(0);      // counts the changes of `structure`
export const structureOf = signal(null); // the run that `structure` is of, as this connection has told it
export const shapeRevision = signal(0); // the same, but for changes of parameters' values alone
export const run = signal({ time: 0, paused: false, speed: null, undo: null, redo: null, undo_client: null, redo_client: null, faults: 0, ended: false, verdict: null, log_levels: {} });
export const log = signal([]);
export const threadStatistics = signal({});

export const isConnected = computed(() => connection.value.state === 'open' && hello.value !== null);
/** There is a connection, and no sign of life has come over it for 2 s: what is shown is old. */
export const isSilent = computed(() => connection.value.state === 'silent');
/** What this page may: look, drive (publish by hand, pause), change. */
export const role = computed(() => hello.value?.role ?? (hello.value?.read_only ? 'look' : 'change'));
/** Whether changes may be asked for now. */
export const canChange = computed(() => isConnected.value && role.value === 'change');
/** Whether values may be set by hand now, and all of it be stopped. */
export const canDrive = computed(() => isConnected.value && role.value !== 'look');

const silence = new Silence();
export const silent = signal(silence.silent); // Map port path -> since when it has published nothing
const rates = new Map();   // port path -> signal of publications per second

function RateOf(path) {
  if (!rates.has(path)) rates.set(path, signal(null));
  return rates.get(path);
}

/** Publications per second of what flows through a port, or null if nothing is known of them. */
export function FlowRate(path) {
  const known = OriginsOf(structure, path).map((origin) => RateOf(origin).value).filter((rate) => rate !== null);
  return known.length === 0 ? null : known.reduce((sum, rate) => sum + rate, 0);
}

let link = null;
/** How long modules take: the server's message, and of each task its share of the time since the message before. */
export const profile = signal({ on: false, seconds: 0, tasks: [], latencies: [] });
export const watches = new Watches((message) => link?.send(message) ?? false);

/** Counts what the application has refused: what a browser has shown before the answer (a switch, a choice) is drawn again then. */
export const refusals = signal(0);

export async function Request(message) {
  const reply = await link.request(message);
  if (!reply.ok) refusals.value += 1;
  return reply;
}

/** Begins to talk with the application that has sent this page. */
export function Start(url) {
  link = new Link(url, TakeToken(location, history, OwnStorage()), { onMessage: Receive, onState: OnState });
  UseOther(link);
  StartStop(url); // first of all
  link.open();
  return link;
}

/** Shows the server another token. */
export function UseToken(token) {
  Keep(token, OwnStorage());
  link.show(token);
  ShowToken(token);
}

function OnState(state, reason) {
  batch(() => {
    connection.value = { state, reason };
    if (state === 'connecting') structureOf.value = null;
  });
  OtherIs(state);
}

const kReceivers = {
  hello: OnHello,
  alive: TakeFromOther,
  catalogue: (message) => { catalogue.value = new Catalogue(message); },
  structure: OnStructure,
  structure_change: OnStructureChange,
  state: ({ op, ...told }) => { run.value = { ...run.value, ...told }; },
  rates: OnRates,
  profile: (message) => { profile.value = WithShares(message, profile.value); },
  values: (message) => watches.receive(message),
  network: (message) => { network.value = message; if (ShowNetwork(structure)) CountChange(true); },
  layout: (message) => TakeArrangement(message.entries),
  log: (message) => { log.value = AddLogEntries(log.value, message.entries); },
};

function Receive(message) {
  const receiver = kReceivers[message.op];
  if (receiver) batch(() => receiver(message));
}

function OnHello(message) {
  if (hello.value && hello.value.run !== message.run) {
    run.value = { ...run.value, ended: false, verdict: null };
    log.value = [];
    threadStatistics.value = {};
    watches.forget();
    silence.forget();
    silent.value = silence.silent;
  }
  // A new connection is told all rates anew.
  for (const rate of rates.values()) rate.value = null;
  ForgetArrangement();
  network.value = null;
  structureOf.value = null;
  hello.value = message;
}

function OnStructure(message) {
  structure.replaceAll(message);
  structureOf.value = hello.value.run;
  ShowNetwork(structure);
  CountChange(true);
  link.send({ op: 'watch_rates', rate: 2 }); // before watches, which may be more than the server takes at once
  watches.askAgain();
}

function OnStructureChange(message) {
  structure.change(message);
  CountChange(ShowNetwork(structure) || ChangesShape(message));
  watches.askAgainFor((message.elements ?? []).map((element) => element.path));
}

function CountChange(isShape) {
  revision.value += 1;
  if (isShape) shapeRevision.value += 1;
}

function ChangesShape({ gone, connected, disconnected, elements }) {
  const isThere = (list) => (list?.length ?? 0) > 0;
  return isThere(gone) || isThere(connected) || isThere(disconnected) ||
    (elements ?? []).some((element) => element.kind !== 'parameter');
}

function OnRates(message) {
  for (const [path, rate] of Object.entries(message.ports ?? {})) RateOf(path).value = rate;
  silence.note(message.ports ?? {}, message.time);
  silent.value = silence.silent;
  if (message.threads) threadStatistics.value = { ...threadStatistics.value, ...message.threads };
}

function WithShares(message, before) {
  const passed = message.seconds - before.seconds;
  const totals = new Map(passed > 0 ? before.tasks.map((task) => [task.name, task.total_us]) : []);
  const seconds = passed > 0 ? passed : message.seconds;
  const tasks = message.tasks.map((task) => ({ ...task,
    share: seconds > 0 ? (task.total_us - (totals.get(task.name) ?? 0)) / (seconds * 1e4) : 0 }));
  return { ...message, tasks };
}
