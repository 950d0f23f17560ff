// A value with all its fields; each number can be plotted.

import { useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { NumberScales } from '../model/number_scales.js';
import { FormatValue, kNoText } from '../model/value_format.js';
import { FieldText, IsPlottable, ValueRows } from '../model/value_rows.js';
import { catalogue } from '../state/store.js';
import { IsPlotted, PlotField } from '../plots/plot_list.js';
import { Icon } from './icon.js';

const kShort = 6; // lists up to this long are shown at once
const kRows = 600;

export function ValueTable({ port, type, value }) {
  const [toggled, setToggled] = useState({});
  const isOpen = (field) => toggled[FieldText(field)] ?? LengthAt(value, field) <= kShort;
  const rows = ValueRows(catalogue.value, type, value, isOpen).slice(0, kRows);
  const scales = useRef(new NumberScales());
  const toggle = (field) => setToggled({ ...toggled, [FieldText(field)]: !isOpen(field) });
  return html`<table class="value-table"><tbody>
    ${rows.map((row) => html`<${Row} key=${FieldText(row.field)} row=${row} port=${port} toggle=${toggle}
      scales=${scales.current} />`)}
  </tbody></table>`;
}

function Row({ row, port, toggle, scales }) {
  const label = row.name || 'value';
  const name = row.length !== undefined
    ? html`<button class="link" aria-expanded=${row.open} onClick=${() => toggle(row.field)}>${row.open ? '▾' : '▸'} ${label}</button>` : label;
  const isOpaque = catalogue.value.isOpaque(row.type);
  const text = isOpaque ? kNoText : typeof row.value === 'number' ? scales.format(row.value, FieldText(row.field)) : row.leaf ? FormatValue(row.value, 300) : row.length !== undefined ? `${row.length} elements` : '';
  return html`<tr data-field=${FieldText(row.field)}>
    <th scope="row" style=${{ paddingLeft: `${Math.max(0, row.depth - 1) * 14}px` }}
        title=${row.description}>${name}</th>
    <td class=${typeof row.value === 'number' ? 'number' : isOpaque ? 'none' : ''}
        title=${typeof row.value === 'number' ? String(row.value) : undefined}>${text}</td>
    <td class="unit">${row.leaf ? row.unit : ''}</td>
    <td class="tools">${IsPlottable(row) && !isOpaque && html`<button class="plot-this" aria-pressed=${IsPlotted(port, row.field)}
      title="Plot" aria-label=${`Plot ${FieldText(row.field) || 'value'}`}
      onClick=${() => PlotField(port, row.field, row.unit)}><${Icon} name="plot" size=${14} /></button>`}</td>
  </tr>`;
}

function LengthAt(value, field) {
  const list = field.reduce((at, step) => at?.[step], value);
  return Array.isArray(list) ? list.length : 0;
}
