// A connection in the graph. It is bright while its source publishes.

import { useComputed } from '@preact/signals';
import { html } from 'htm/preact';
import { memo } from '../panels/memo.js';
import { notes } from '../state/arrangement.js';
import { useWatched } from '../panels/use_watched.js';
import { SignalOf } from '../state/behaviours.js';
import { selected } from '../state/choices.js';
import { FlowRate, shapeRevision, structure } from '../state/store.js';

const kNoteLetters = 36;
const kSignalOptions = { rate: 5 };
const kFaint = 0.3; // of an edge whose signal is 0

export const EdgeView = memo(({ edge }) => {
  const state = useComputed(() => {
    if (selected.value === edge.key) return 'selected';
    return Touches(selected.value, edge) ? 'near' : '';
  });
  const isLive = useComputed(() => {
    shapeRevision.value;
    return FlowRate(edge.from) > 0;
  });
  const isPulled = useComputed(() => {
    shapeRevision.value;
    return structure.connections.get(edge.key)?.pull === true;
  });
  const far = useComputed(() => {
    shapeRevision.value;
    const port = structure.get(edge.from);
    return port?.far && port.state !== 'connected' ? port : null;
  });
  const conversion = useComputed(() => {
    shapeRevision.value;
    return structure.connections.get(edge.key)?.conversion ?? '';
  });
  const signal = useComputed(() => {
    shapeRevision.value;
    return SignalOf(edge);
  });
  const strength = useWatched(signal.value && edge.from, kSignalOptions)?.value?.value ?? 0;
  const style = signal.value ? { strokeOpacity: kFaint + (1 - kFaint) * strength } : undefined;
  return html`<path class=${`edge ${signal.value} ${state.value} ${isLive.value ? 'live' : ''} ${isPulled.value ? 'pulled' : ''} ${conversion.value ? 'converted' : ''} ${far.value ? (far.value.misfit ? 'misfit' : 'waiting') : ''}`} data-edge=${edge.key} style=${style}
    d=${edge.path} transform=${edge.dx || edge.dy ? `translate(${edge.dx},${edge.dy})` : undefined}>
    ${(conversion.value || far.value) && html`<title>${conversion.value || far.value.misfit || 'waits for the other application'}</title>`}</path>`;
});

/** Whether a connection begins or ends at what is selected: a port, or a box. */
function Touches(path, edge) {
  if (!path) return false;
  return edge.from === path || edge.to === path ||
    edge.from.startsWith(`${path}/`) || edge.to.startsWith(`${path}/`);
}

/** The note on a connection, in its middle. */
export const EdgeNote = memo(({ edge }) => {
  const text = useComputed(() => notes.value.get(edge.key) ?? '').value;
  if (!text) return null;
  const short = text.length > kNoteLetters ? `${text.slice(0, kNoteLetters - 1)}…` : text;
  const width = short.length * 5.9 + 14;
  return html`<g class="edge-note" transform=${`translate(${edge.middle.x},${edge.middle.y})`} data-edge=${edge.key}>
    <rect x=${-width / 2} y="-9" width=${width} height="18" rx="5" />
    <text text-anchor="middle" y="4">${short}</text><title>${text}</title></g>`;
});
