// The STOP of the robot, as this page presses it and the robot confirms it.

import { computed, signal } from '@preact/signals';
import { Link } from '../connection/link.js';
import { CurrentToken } from '../connection/token.js';

const kConfirmed = 1000; // ms within which the robot confirms; then it is asked once more, and the page says so

/**
 * {in_force, by, since, unreached, drives, braking; isReachOld: the three are of an earlier message, undefined: never told} as the
 * robot told it last; null: never yet.
 */
export const told = signal(null);
/** What this page has pressed and the robot has not confirmed: {since, isLate, problem: why it was refused}; null: nothing. */
export const pressed = signal(null);
export const releaseProblem = signal('');
const ownState = signal('connecting');
const otherState = signal('connecting'); // of the page's other connection
// A sign of life has come over it since it was opened: what was told over the connection before says nothing of who is there now.
const hasOwnLife = signal(false);
const hasOtherLife = signal(false);
const isOwnHeard = computed(() => ownState.value === 'open' && hasOwnLife.value);
/** The robot has been heard of within 2 s. */
export const isHeard = computed(() => isOwnHeard.value || (otherState.value === 'open' && hasOtherLife.value));
/** As the robot has confirmed it, whether or not it can be heard now. */
export const isInForce = computed(() => told.value?.in_force === true);
/** What it holds, as the robot told it last: paths of ports, and names of what leaves over a network; null: not known. */
export const held = computed(() => told.value?.drives?.split(', ').filter(Boolean) ?? null);
/** [{path, why}]: the driving ports that no STOP reaches, in force or not, as the robot told it last; null: not known. */
export const unreached = computed(() => told.value?.unreached ?? null);
/** In force, as far as anybody can know now. */
export const isConfirmed = computed(() => isInForce.value && isHeard.value && !pressed.value?.isLate);

let own = null;
let other = null;
let timer = 0;
const asked = new Map(); // link -> `since` of the press of which its answer is awaited

/** Opens the connection that bears nothing else. */
export function StartStop(url) {
  own = new Link(url, CurrentToken(), { protocol: 'runnel.stop.v1', onMessage: TakeFromOwn,
    onState: (state) => { if (state === 'connecting') hasOwnLife.value = false; ownState.value = state; Resend(); } });
  own.open();
}

/** The page's other connection, by which it is pressed, too, while the own one is away. */
export function UseOther(link) {
  other = link;
}

export function OtherIs(state) {
  if (state === 'connecting') hasOtherLife.value = false;
  otherState.value = state;
  Resend();
}

function TakeFromOwn(message) {
  if (message.op !== 'alive') return;
  Take(message);
  hasOwnLife.value = true;
}

/** As the other connection tells it: it may carry so much that this comes late. */
export function TakeFromOther(message) {
  if (!isOwnHeard.value) Take(message);
  hasOtherLife.value = true;
}

export function ShowToken(token) {
  own?.show(token);
}

/** What was said before it was pressed does not confirm it. What it holds and reaches is not told while the structure is being changed. */
function Take({ stop, given }) {
  const { unreached: before, drives, braking } = told.value ?? {};
  told.value = stop.unreached ? stop : { ...stop, unreached: before, ...stop.in_force && { drives, braking }, isReachOld: true };
  if (stop.in_force && !(given < pressed.value?.since)) Confirmed();
  else releaseProblem.value = '';
}

function Confirmed() {
  clearInterval(timer);
  pressed.value = null;
}

/** One message for each connection that is meant; what is not confirmed is sent again, also when there is a connection again. */
export function PressStop() {
  pressed.value = { since: performance.now(), isLate: false, problem: '' };
  releaseProblem.value = '';
  clearInterval(timer);
  timer = setInterval(() => {
    if (pressed.value) pressed.value = { ...pressed.value, isLate: true };
    Resend([own, other]);
  }, kConfirmed);
  Links().forEach(Send);
}

/** By which it is sent; while the own one is silent, nobody can say which of both gets through. */
function Links() {
  return ownState.value === 'open' ? [own] : [own, other];
}

function Resend(links = Links()) {
  if (pressed.value && !pressed.value.problem) links.forEach(Send);
}

async function Send(link) {
  const press = pressed.value.since;
  if (!link || asked.get(link) === press) return;
  asked.set(link, press);
  const reply = await link.request({ op: 'stop' });
  if (asked.get(link) === press) asked.delete(link);
  if (press !== pressed.value?.since) return; // an answer to an earlier press says nothing of this one
  if (reply.ok) Confirmed(); // how it stands since came just before: it may have been released already
  if (reply.ok || reply.lost) return; // lost: sent again
  clearInterval(timer);
  pressed.value = { ...pressed.value, isLate: true, problem: reply.errors?.[0]?.message ?? 'no reason was given' };
}

/** The second, separate act. It says which sign of life it answers: one that comes late ends no STOP that was pressed meanwhile. */
export async function ReleaseStop() {
  const link = isOwnHeard.value ? own : other;
  const reply = await link.request({ op: 'release', path: 'stop', at: link.at });
  const error = reply.errors?.[0];
  releaseProblem.value = reply.ok || !isInForce.value ? '' : [error?.message, error?.hint].filter(Boolean).join('; ') || 'it was refused';
}
