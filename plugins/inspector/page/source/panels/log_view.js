// Faults, warnings, changes: what has happened, newest at the bottom, with a filter.

import { useSignal } from '@preact/signals';
import { useEffect, useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { FormatTime } from '../model/value_format.js';
import { FilterLog } from '../state/log.js';
import { log } from '../state/store.js';

const kShown = 300;

export function LogView() {
  const text = useSignal('');
  const kinds = useSignal(new Set());
  const list = useRef(null);
  const atEnd = useRef(true);
  const all = [...new Set(log.value.map((entry) => entry.kind))];
  const found = FilterLog(log.value, { text: text.value, kinds: kinds.value });
  const shown = found.slice(-kShown);
  useEffect(() => {
    if (atEnd.current && list.current) list.current.scrollTop = list.current.scrollHeight;
  });
  const toggle = (kind) => {
    const chosen = new Set(kinds.value);
    if (!chosen.delete(kind)) chosen.add(kind);
    kinds.value = chosen;
  };
  const onScroll = ({ target }) => { atEnd.current = target.scrollHeight - target.scrollTop - target.clientHeight < 24; };
  return html`
    <div class="log">
      <div class="log-tools" role="group" aria-label="Filter">
        <input type="search" id="log-filter" placeholder="Filter …" aria-label="Filter the log" value=${text.value}
          onInput=${(event) => { text.value = event.target.value; }} />
        ${all.map((kind) => html`<button key=${kind} class=${`chip ${kind}`}
            aria-pressed=${kinds.value.has(kind)} onClick=${() => toggle(kind)}>
          ${kind} <small>${log.value.filter((entry) => entry.kind === kind).length}</small></button>`)}
        <span class="count">${CountText(found.length, log.value.length)}</span>
      </div>
      <ol ref=${list} class="entries" id="log" role="log" aria-label="Log" tabindex="0" onScroll=${onScroll}>
        ${shown.map((entry) => html`<li key=${entry.number} class=${entry.kind}>
          <time>${FormatTime(entry.time)}</time> <span class="kind">${entry.kind}</span> <span
              class="text">${entry.text}</span></li>`)}
        ${shown.length === 0 && html`<li class="none">${log.value.length === 0 ? 'Nothing has happened yet.' : 'No entry suits the filter.'}</li>`}
      </ol>
    </div>`;
}

function CountText(found, all) {
  if (found < all) return `${found} of ${all}`;
  return all === 1 ? '1 entry' : `${all} entries`;
}
