// Gauge, value, text: what is read.

import { html } from 'htm/preact';
import { useWatched } from '../../../page/source/panels/use_watched.js';
import { FormatNumber, FormatValue } from '../../../page/source/model/value_format.js';
import { NumberAt } from '../../../page/source/model/value_rows.js';
import { catalogue, isConnected, revision, run, structure } from '../../../page/source/state/store.js';
import { StepsOf, UnitOf } from '../model/fields.js';

const kSweep = 240; // degrees
const kOld = 2;     // s without a value, after which it is drawn as one of the past

function usePort(widget, rate) {
  revision.value;
  const port = widget.target ? structure.get(widget.target) : null;
  const item = useWatched(widget.target ?? '', { rate, elements: 20 });
  const isOld = !isConnected.value || (item !== null && run.value.time - item.stamp > kOld);
  return { port, item, isOld, problem: !widget.target ? 'no port has been chosen' : port ? '' : `${widget.target} is not there` };
}

export function Gauge({ widget }) {
  const { port, item, isOld, problem } = usePort(widget, 15);
  const number = item ? NumberAt(item.value, StepsOf(widget.field)) : null;
  const [from, to] = [widget.minimum ?? 0, widget.maximum ?? 1];
  const part = (at) => Math.min(1, Math.max(0, (at - from) / ((to - from) || 1)));
  const zero = part(0); // the bar begins where nothing moves
  return html`
    <div class=${`gauge ${isOld ? 'old' : ''}`} data-gauge=${number ?? ''}>
      <svg viewBox="-60 -60 120 104" role="img" aria-label=${`${widget.title ?? port?.name ?? ''} ${FormatNumber(number)}`}>
        <path class="gauge-track" d=${Arc(0, 1)} />
        ${number !== null && html`<path class="gauge-bar" d=${Arc(Math.min(zero, part(number)), Math.max(zero, part(number)))} />
          <line class="gauge-mark" x1="0" y1="-38" x2="0" y2="-56" transform=${`rotate(${-kSweep / 2 + kSweep * part(number)})`} />`}
        <text class="gauge-number" y="8">${number === null ? '–' : Short(number)}</text>
        <text class="gauge-unit" y="24">${UnitOf(catalogue.value, port, widget.field)}</text>
        <text class="gauge-end" x="-40" y="42">${End(from)}</text><text class="gauge-end" x="40" y="42">${End(to)}</text>
      </svg>
      ${problem && html`<p class="problem widget-problem">${problem}</p>`}
    </div>`;
}

/** Always as many letters, so that it stands still while it changes. */
function Short(number) {
  return (Math.abs(number) < 0.005 ? 0 : number).toFixed(Math.abs(number) >= 100 ? 0 : Math.abs(number) >= 10 ? 1 : 2).replace('-', '−');
}

function End(number) {
  return String(Number(number.toPrecision(3))).replace('-', '−');
}

function Arc(from, to) {
  const at = (part) => {
    const angle = ((-90 - kSweep / 2 + kSweep * part) * Math.PI) / 180;
    return `${(47 * Math.cos(angle)).toFixed(2)} ${(47 * Math.sin(angle)).toFixed(2)}`;
  };
  const isLong = (to - from) * kSweep > 180 ? 1 : 0;
  return `M${at(from)} A47 47 0 ${isLong} 1 ${at(Math.max(to, from + 0.001))}`;
}

export function Value({ widget }) {
  const { item, isOld, problem } = usePort(widget, 5);
  let value = item?.value;
  for (const step of StepsOf(widget.field)) value = value?.[step];
  const rows = value !== null && typeof value === 'object' && !Array.isArray(value) ? Object.entries(value) : null;
  return html`
    <div class=${`value ${isOld ? 'old' : ''}`}>
      ${item === null ? html`<p class="none">${problem || 'nothing has come yet'}</p>`
        : rows ? html`<dl>${rows.map(([name, each]) => html`<div key=${name}><dt>${name.replaceAll('_', ' ')}</dt><dd>${FormatValue(each, 40)}</dd></div>`)}</dl>`
          : html`<p class="value-one">${FormatValue(value, 80)}</p>`}
    </div>`;
}

export function Text({ widget }) {
  return html`<p class="note-text">${widget.text || 'Some text'}</p>`;
}
