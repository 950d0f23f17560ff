// Ports that are at rest by hand, said over the whole panel, and the way out of it.

import { html } from 'htm/preact';
import { canDrive } from '../../../page/source/state/store.js';
import { GiveBack, hands } from '../driving/driving.js';

const kStates = [['stopped', 'Blocked by hand', ': at rest, whatever anybody sends, until it is released.', 'Release'],
  ['lost', 'Link lost', ': whoever drove was not heard of in time. At rest until it is driven again or given back.', 'Give back']];

export function HandBanner() {
  const portsOf = (state) => Object.entries(hands.value).filter(([, each]) => each === state).map(([port]) => port);
  const [kind, title, text, action] = kStates.find(([state]) => portsOf(state).length > 0) ?? [];
  if (!kind) return null;
  const ports = portsOf(kind);
  return html`
    <div class=${`hand-banner ${kind}`} role="alert" id="hand-banner">
      <span><b>${title}</b>${text} <small title=${ports.join('\n')}>${ports.length === 1 ? ports[0] : `${ports.length} ports`}</small></span>
      <button id="release" disabled=${!canDrive.value} title="The application drives again" onClick=${() => GiveBack(ports)}>${action}</button>
    </div>`;
}
