// What is said at a widget that drives: who has the port, what it wants now, and what went wrong.

import { html } from 'htm/preact';
import { FormatNumber } from '../../../page/source/model/value_format.js';
import { canDrive, catalogue, isConnected, role, revision, structure } from '../../../page/source/state/store.js';
import { isConfirmed, isInForce, pressed } from '../../../page/source/stop/stop_state.js';
import { GiveBack, hands, held, problems } from '../driving/driving.js';
import { AxesOf } from '../model/twist.js';

/** {port, axes, problem}: where a widget drives, or why it cannot. */
export function DriveOf({ target }) {
  revision.value;
  const port = target ? structure.get(target) : null;
  if (!target) return { problem: 'no port has been chosen' };
  if (!port) return { problem: `${target} is not there` };
  const axes = AxesOf(catalogue.value, port.data_type);
  return axes ? { port, axes } : { problem: `${port.data_type} is no motion` };
}

const kTexts = { driven: 'you drive', set: 'set by hand', lost: 'link lost: at rest', stopped: 'blocked' };

/** As long as nobody has confirmed it, it may drive. */
function StopChip() {
  if (isConfirmed.value) return ['stopped', 'STOP'];
  return isInForce.value || pressed.value?.isLate ? ['unconfirmed', 'STOP: not confirmed'] : null;
}

export function DrivingState({ widget, problem, motion }) {
  const port = widget.target;
  const mine = held.value[port] === widget.id;
  const state = hands.value[port];
  const told = problem ?? problems.value[widget.id];
  const [kind, text] = StopChip() ?? (!isConnected.value ? ['unknown', 'not known who drives']
    : mine ? ['mine', kTexts.driven] : [state ?? 'free', role.value === 'look' ? 'read-only'
      : state === 'driven' ? 'somebody drives' : kTexts[state] ?? 'the application drives']);
  return html`
    <div class="driving-state">
      <span class=${`driving-chip ${kind}`} data-driving=${kind}>${text}</span>
      ${mine && motion && html`<span class="driving-numbers"><b>${FormatNumber(motion.forward)}</b> m/s
        <b>${FormatNumber(motion.turn)}</b> rad/s</span>`}
      ${!mine && (state === 'set' || state === 'lost') && html`<button class="give-back" disabled=${!canDrive.value}
        title="The application drives again" onClick=${() => GiveBack([port])}>Give back</button>`}
    </div>
    ${told && html`<p class="problem widget-problem" role="alert">${told}</p>`}`;
}
