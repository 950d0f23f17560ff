// Measuring how old what the module selected last publishes is, counted from the one that was selected before.

import { html } from 'htm/preact';
import { ChainBetween } from '../model/chain.js';
import { NameOf } from '../model/structure.js';
import { SetLatency } from '../state/actions.js';
import { recent } from '../state/recent.js';
import { canChange, profile, shapeRevision, structure } from '../state/store.js';
import { ActionButton } from './parts.js';

export function ChainRow() {
  shapeRevision.value;
  const [first, last] = recent.value.length === 2 ? recent.value : [];
  if (!first) return html`<p class="hint chain">To measure a chain, select its first module, then its last one.</p>`;
  const chain = ChainBetween(structure, first, last) ?? ChainBetween(structure, last, first);
  const name = (path) => NameOf(structure.get(path)?.kind === 'port' ? structure.get(path).owner : path);
  if (!chain) return html`<p class="hint chain">No data goes from ${name(first)} to ${name(last)}; select the two ends of a chain, one after the other.</p>`;
  const isMeasured = profile.value.latencies.some(({ from, to }) => from === chain.from && to === chain.to);
  return html`<p class="chain"><${ActionButton} id="measure-chain" icon="plot" disabled=${!canChange.value || isMeasured}
      text=${isMeasured ? 'Measured' : 'Measure latency'} onClick=${() => SetLatency(chain.from, chain.to, true)} />
    <span class="way">${chain.modules.map((module, index) => html`${index > 0 && html`<i>→</i>`}<b>${NameOf(module)}</b>`)}</span></p>`;
}
