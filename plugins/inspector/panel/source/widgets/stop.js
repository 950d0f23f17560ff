// The stop: readers of the ports find a robot at rest until somebody releases it, whatever anybody sends.

import { html } from 'htm/preact';
import { canDrive, role } from '../../../page/source/state/store.js';
import { GiveBack, Stop, hands, problems, stopsWaiting } from '../driving/driving.js';
import { DrivenPorts } from '../panel_state.js';

export function PortsToStop(widget) {
  return widget?.target ? [widget.target] : DrivenPorts();
}

/** Pressing is enough: it does not wait until it is let go. */
export function StopButton({ widget, small = false }) {
  const ports = PortsToStop(widget);
  const stopped = ports.length > 0 && ports.every((port) => hands.value[port] === 'stopped');
  const isWaiting = ports.some((port) => stopsWaiting.value.includes(port));
  const press = (event) => {
    if (event.type === 'pointerdown' && event.button !== 0) return;
    if (event.type === 'keydown' && ![' ', 'Enter'].includes(event.key)) return;
    event.preventDefault();
    Stop(ports);
  };
  const cannot = role.value === 'look' ? 'read-only' : ports.length === 0 ? 'this panel drives nothing' : '';
  return html`
    <div class=${`stop ${small ? 'small' : ''} ${stopped ? 'stopped' : ''}`}>
      <button class="stop-button" disabled=${cannot !== ''} title=${cannot || ports.join('\n')} aria-pressed=${stopped}
        data-stop=${stopped ? 'stopped' : isWaiting ? 'waiting' : 'free'} onPointerDown=${press} onKeyDown=${press}>STOP</button>
      ${!small && html`<p class="stop-note" data-quiet=${cannot || isWaiting ? undefined : ''}>${cannot || (isWaiting ? 'not connected: sent as soon as it is'
        : stopped ? 'stopped until it is released' : 'stops until it is released')}</p>`}
      ${problems.value.stop && !small && html`<p class="problem widget-problem" role="alert">${problems.value.stop}</p>`}
    </div>`;
}

/** What is stopped, or lost, said over the whole panel, and the way out of it. */
export function StopBanner() {
  const entries = Object.entries(hands.value);
  const stopped = entries.filter(([, state]) => state === 'stopped').map(([port]) => port);
  const lost = entries.filter(([, state]) => state === 'lost').map(([port]) => port);
  if (stopsWaiting.value.length > 0) return html`<div class="hand-banner stopped" role="alert" id="stop-waiting">STOP has not reached the application yet: it is sent as soon as there is a connection.</div>`;
  if (stopped.length === 0 && lost.length === 0) return null;
  const ports = stopped.length > 0 ? stopped : lost;
  return html`
    <div class=${`hand-banner ${stopped.length > 0 ? 'stopped' : 'lost'}`} role="alert" id="hand-banner">
      <span><b>${stopped.length > 0 ? 'Stopped by hand' : 'Link lost'}</b>${stopped.length > 0 ? ': at rest, whatever anybody sends, until it is released.'
        : ': whoever drove was not heard of in time. At rest until it is driven again or given back.'}
        <small title=${ports.join('\n')}>${ports.length === 1 ? ports[0] : `${ports.length} ports`}</small></span>
      <button id="release" disabled=${!canDrive.value} title="The application drives again" onClick=${() => GiveBack(ports)}>
        ${stopped.length > 0 ? 'Release' : 'Give back'}</button>
    </div>`;
}
