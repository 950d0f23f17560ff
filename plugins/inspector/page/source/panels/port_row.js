// One port in a list: name, type, what it carries now.

import { html } from 'htm/preact';
import { FormatRate } from '../model/value_format.js';
import { FormatPortValue } from '../model/port_table.js';
import { FlowRate, catalogue, revision, structure } from '../state/store.js';
import { Link } from './parts.js';
import { useWatched } from './use_watched.js';

export function PortRow({ port }) {
  revision.value;
  const item = useWatched(port.path, { rate: 4 });
  const rate = FlowRate(port.path);
  const isOpenEnded = port.required && structure.connectionsOf(port.path).length === 0;
  return html`<li class="port-row" data-port-row=${port.path}>
    <div><${Link} path=${port.path} text=${port.name} /> <small class="type">${port.data_type}</small>
      ${isOpenEnded && html`<small class="missing">required, not connected</small>`}
      ${port.by_hand && html`<small class="missing">set by hand</small>`}
      <small class="rate">${rate === null ? '' : FormatRate(rate)}</small></div>
    <div class="value">${item ? FormatPortValue(catalogue.value.meaning(port.data_type), item.value) : html`<span class="none">nothing yet</span>`}</div>
  </li>`;
}
