// The one button that stops the robot: on each page the same, outside of all that a page shows, in a root of its own.

import { render } from 'preact';
import { html } from 'htm/preact';
import { FormatTime } from '../model/value_format.js';
import { canDrive } from '../state/store.js';
import { PressStop, ReleaseStop, held, isHeard, isInForce, pressed, releaseProblem, told, unreached } from './stop_state.js';

const kHost = 'robot-stop';
const kPlaceOfBanner = 'stop-place';
const kGamepadStop = 1; // the right button of the four, red on many: B, circle
const kLook = 40;       // ms, between two looks at gamepads
const kNamed = 2;       // of so many that it holds, each is named

const kOld = ' This was told last before the structure began to be changed: whether it is still so is not known.';

function Unreached() {
  const [{ path, why }, ...others] = unreached.value;
  return `STOP is in force and does not reach ${path}${others.length > 0 ? ` and ${others.length} more` : ''}: ${why}. The robot may move: use its own stop.`;
}

function InForce() {
  if (held.value === null) return 'STOP is in force. What it holds, and whether it reaches all of that, is not known while the structure is being changed.';
  const what = held.value.length > kNamed ? `${held.value.length} ports` : held.value.join(' and ');
  const how = told.value.braking ? ', and the robot is braking: whatever moves comes to its safe value' : ': whatever moves has its safe value';
  return `STOP is in force${how}, whatever anybody sends. It holds ${what}.${told.value.isReachOld ? kOld : ''}`;
}

/** How it stands: [name, what is said]; '' says nothing. */
function Standing() {
  const press = pressed.value;
  if (press?.problem) return ['refused', `STOP has been refused: ${press.problem}. The robot may move: use its own stop.`];
  if (press?.isLate) return ['unconfirmed', 'STOP has not been confirmed by the robot: it may move, use its own stop. STOP is sent again until it is confirmed.'];
  if (press) return ['pressed', ''];
  if (isInForce.value && !isHeard.value) return ['unknown', 'STOP was in force when the robot was last heard of. It has not been confirmed since: the robot may move.'];
  if (isInForce.value && held.value?.length === 0) return ['nothing', 'STOP is in force and stops nothing: no port of this application is marked as one by which something moves (<driving port="…"/>). The robot may move: use its own stop.'];
  if (isInForce.value && unreached.value?.length > 0) return ['unreached', Unreached()];
  if (isInForce.value) return ['in_force', InForce()];
  return isHeard.value && told.value ? ['free', ''] : ['unknown', ''];
}

const kLabels = { free: 'STOP', pressed: 'STOP …', in_force: 'STOPPED', unconfirmed: 'STOP ?', unknown: 'STOP ?', refused: 'STOP !', nothing: 'STOP !', unreached: 'STOP !' };
const kSpoken = { free: 'STOP is not in force', pressed: 'STOP has been pressed', unknown: 'Whether STOP is in force is not known' };

/** Pressing is enough: it does not wait until it is let go. A click alone, as some aids send it, does the same. */
export function StopHandlers() {
  return {
    onPointerDown: (event) => {
      if (event.button !== 0) return;
      lastPointer = performance.now();
      PressStop();
    },
    onKeyDown: (event) => {
      if (![' ', 'Enter'].includes(event.key)) return;
      event.preventDefault();
      if (!event.repeat) PressStop();
    },
    onClick: (event) => {
      // The same press, told once more by the browser.
      if (event.detail > 0 && performance.now() - lastPointer < kOneClick) return;
      PressStop();
    },
    onContextMenu: (event) => event.preventDefault(),
  };
}
const kOneClick = 2000; // ms, from pressing to the click
let lastPointer = -Infinity;

export function StopButton({ id }) {
  const [name] = Standing();
  return html`<button id=${id} class="robot-stop-button" data-stop=${name} aria-pressed=${isInForce.value} aria-keyshortcuts="Control+Space Pause"
    aria-label=${`STOP the robot. ${kSpoken[name] ?? Standing()[1]}`} title="Everything that moves gets its safe value (Ctrl+Space, Pause; B or circle of a gamepad)" ...${StopHandlers()}>${kLabels[name]}</button>`;
}

function Banner() {
  const [name, text] = Standing();
  const by = name === 'in_force' && told.value.by ? ` By ${told.value.by}, at ${FormatTime(Math.max(0, told.value.since))}.` : '';
  return text && html`<div class=${`stop-banner ${name}`} id="stop-banner" data-stop=${name}>
      <span><b>${text}</b>${by}${releaseProblem.value && html` <em class="release-problem">It has not been released: ${releaseProblem.value}</em>`}</span>
      ${isInForce.value && html`<button id="stop-release" disabled=${!canDrive.value} title="What drives drives again" onClick=${ReleaseStop}>Release</button>`}</div>`;
}

/** What is said is beside the button: behind a modal dialog nobody would hear it. */
function Stop() {
  const [name, text] = Standing();
  return html`
    <p class="unseen" role="status" aria-live="assertive" id="stop-spoken">${releaseProblem.value || text || kSpoken[name]}</p>
    <${StopButton} id="stop-button" />`;
}

function WatchKeys() {
  window.addEventListener('keydown', (event) => {
    if (event.key !== 'Pause' && !(event.ctrlKey && event.code === 'Space')) return;
    event.preventDefault();
    event.stopPropagation();
    if (!event.repeat) PressStop();
  }, true);
}

function WatchGamepads() {
  const wasDown = new Map(); // by pad; a button must have been seen released
  setInterval(() => {
    const pads = [...navigator.getGamepads?.() ?? []].filter((pad) => pad?.connected && pad.mapping === 'standard');
    for (const index of [...wasDown.keys()]) if (!pads.some((pad) => pad.index === index)) wasDown.delete(index);
    for (const pad of pads) {
      const isDown = Boolean(pad.buttons[kGamepadStop]?.pressed);
      if (isDown && wasDown.get(pad.index) === false) PressStop();
      wasDown.set(pad.index, isDown);
    }
  }, kLook);
}

export function ShowStop() {
  render(html`<${Banner} />`, document.getElementById(kPlaceOfBanner));
  render(html`<${Stop} />`, document.getElementById(kHost));
  WatchKeys();
  WatchGamepads();
}

/** A modal dialog takes whatever is outside of it out of reach: the button goes with it. The function brings it back. */
export function BringStopInto(dialog) {
  const host = document.getElementById(kHost);
  if (!host) return () => {};
  dialog.append(host);
  return () => { if (dialog.contains(host)) document.body.prepend(host); };
}
