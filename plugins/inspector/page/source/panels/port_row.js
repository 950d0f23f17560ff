// One port in a list: name, type, what it carries now.

import { useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { LacksSource } from '../model/alarms.js';
import { NumberScales } from '../model/number_scales.js';
import { FormatPortValue } from '../model/port_table.js';
import { FormatRate, kNoText } from '../model/value_format.js';
import { AlarmCount } from '../state/alarms.js';
import { FlowRate, catalogue, revision, silent, structure } from '../state/store.js';
import { Link } from './parts.js';
import { useWatched } from './use_watched.js';

export function PortRow({ port }) {
  revision.value;
  const item = useWatched(port.path, { rate: 4 });
  const rate = FlowRate(port.path);
  const scales = useRef(new NumberScales());
  return html`<li class="port-row" data-port-row=${port.path}>
    <div><${Link} path=${port.path} text=${port.name} /> <small class="type">${port.data_type}</small>
      ${LacksSource(structure, port) && html`<span class="badge bad">required, without a source</span>`}
      ${AlarmCount(port.path) > 0 && silent.value.has(port.path) && html`<span class="badge bad">silent</span>`}
      ${port.blocked ? html`<span class="badge bad">blocked</span>` : port.by_hand && html`<small class="missing">set by hand</small>`}
      <small class="rate">${rate === null ? '' : FormatRate(rate)}</small></div>
    <div class="value">${!item ? html`<span class="none">nothing yet</span>`
      : catalogue.value.isOpaque(port.data_type) ? html`<span class="none">${kNoText}</span>`
      : FormatPortValue(catalogue.value.meaning(port.data_type), item.value, { limit: 80, scales: scales.current })}</div>
  </li>`;
}
