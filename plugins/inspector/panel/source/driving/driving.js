// Who of this page drives what, and how it stands with the ports.

import { computed, effect, signal } from '@preact/signals';
import { ErrorText, Release } from '../../../page/source/state/actions.js';
import { Request, canDrive, isConnected, run } from '../../../page/source/state/store.js';
import { isInForce, pressed } from '../../../page/source/stop/stop_state.js';
import { isEditing } from '../panel_state.js';
import { Hold } from './hold.js';

const holds = new Map(); // port -> {widget, hold}
export const held = signal({});     // port -> id of the widget that holds it
export const problems = signal({}); // id of a widget -> why its hold has ended by itself

/** How it stands with ports that are set by hand: path -> 'set', 'driven', 'lost', 'stopped'. */
export const hands = computed(() => Object.fromEntries((run.value.hands ?? []).map(({ path, state }) => [path, state])));

/** A hold begins only by an act in a page that somebody looks at, and not while it is arranged. */
function MayBegin() {
  return canDrive.value && !isInForce.value && !pressed.value && !isEditing.value && !document.hidden && document.hasFocus();
}

/** Takes hold, or says what is wanted now. False: another widget has the port, or it cannot be had. */
export function Drive(port, widget, text, rest) {
  const known = holds.get(port);
  if (known) {
    if (known.widget !== widget) return false;
    known.hold.set(text);
    return true;
  }
  if (!port || !MayBegin()) return false;
  Note(problems, widget, undefined);
  const onEnd = (errors) => Ended(port, widget, errors.map(ErrorText).join('\n') || 'it was refused');
  holds.set(port, { widget, hold: new Hold(port, text, { rest, request: Request, onEnd }) });
  Note(held, port, widget);
  return true;
}

export function LetGo(port, widget) {
  const known = holds.get(port);
  if (known?.widget !== widget) return;
  known.hold.end();
  Forget(port);
}

export function LetGoOfAll() {
  for (const [port, { widget }] of [...holds]) LetGo(port, widget);
}

/** By itself. */
function Ended(port, widget, why) {
  Forget(port);
  Note(problems, widget, why);
}

function Forget(port) {
  holds.delete(port);
  Note(held, port, undefined);
}

function Note(of, name, value) {
  const { [name]: _, ...others } = of.value;
  of.value = value === undefined ? others : { ...others, [name]: value };
}

/** Gives ports back to what is connected to them. */
export async function GiveBack(ports) {
  for (const port of ports) await Release(port);
}

/** A page that nobody looks at drives nothing. */
export function WatchThePage() {
  window.addEventListener('blur', LetGoOfAll);
  window.addEventListener('pagehide', LetGoOfAll);
  document.addEventListener('visibilitychange', () => { if (document.hidden) LetGoOfAll(); });
  effect(() => { if (isEditing.value) LetGoOfAll(); });
  effect(() => { if (isInForce.value || pressed.value) LetGoOfAll(); });
  effect(() => {
    if (isConnected.value) return;
    for (const [port, { widget, hold }] of [...holds]) {
      hold.end();
      Ended(port, widget, 'the application is not heard of any more: this hold has ended');
    }
  });
}
