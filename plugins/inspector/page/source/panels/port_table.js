// All ports of the application in one table: sorted, filtered, frozen, set by hand. However many there are, only rows
// that can be seen are drawn, and their values asked for.

import { computed, signal, untracked } from '@preact/signals';
import { useEffect, useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { FilterPorts, PortRows, SortPorts, VisibleRows } from '../model/port_table.js';
import { FormatTime } from '../model/value_format.js';
import { selected } from '../state/choices.js';
import { MeasuresOf, Sample } from '../state/port_measures.js';
import { run, shapeRevision, structure } from '../state/store.js';
import { Icon } from './icon.js';
import { PortTableRow, ShowPort } from './port_table_row.js';

const kRowHeight = 28;
const kTick = 500;   // ms, between two looks at how old values are
const kResort = 4;   // ticks, between two looks at the order

const kColumns = [
  { column: 'direction', title: 'way', label: 'direction' }, { column: 'name', title: 'port' }, { column: 'type', title: 'type' },
  { column: 'value', title: 'value', changes: true }, { column: 'rate', title: 'rate', changes: true, largestFirst: true },
  { column: 'bandwidth', title: 'bandwidth', changes: true, largestFirst: true }, { column: 'age', title: 'age', changes: true },
];
const kKinds = [
  { name: 'all', wanted: {} }, { name: 'inputs', wanted: { direction: 'input' } },
  { name: 'outputs', wanted: { direction: 'output' } }, { name: 'set by hand', wanted: { byHand: true } },
];

// Kept while other panels are looked at.
const text = signal('');
const kind = signal(kKinds[0]);
const sort = signal({ column: 'name', isDown: false });
const frozen = signal(null); // {time, measures: port path -> MeasuresOf()}, while the table stands still
const resorted = signal(0);

const all = computed(() => {
  shapeRevision.value;
  return PortRows(structure);
});
const found = computed(() => FilterPorts(all.value, { text: text.value, ...kind.value.wanted }));
const changes = computed(() => kColumns.find(({ column }) => column === sort.value.column).changes ?? false);
const rows = computed(() => {
  resorted.value;
  const [some, order, stood] = [found.value, sort.value, frozen.value];
  return untracked(() => SortPorts(some, order, stood ? ({ path }) => stood.measures.get(path) ?? {} : MeasuresOf));
});

function SortBy({ column, largestFirst = false }) {
  const { value } = sort;
  sort.value = { column, isDown: value.column === column ? !value.isDown : largestFirst };
}

function Freeze() {
  frozen.value = frozen.value ? null
    : { time: run.value.time, measures: new Map(all.value.map((row) => [row.path, untracked(() => MeasuresOf(row))])) };
}

export function PortTable() {
  const body = useRef(null);
  const isPointedAt = useRef(false);
  const [place, setPlace] = useState({ top: 0, height: 400 });
  const [tick, setTick] = useState(0);
  const [edited, setEdited] = useState(null); // the path of the port whose value is being typed
  const [problem, setProblem] = useState('');
  const stood = frozen.value;

  useEffect(() => {
    const look = () => setPlace({ top: body.current.scrollTop, height: body.current.clientHeight });
    const observer = new ResizeObserver(look);
    observer.observe(body.current);
    body.current.addEventListener('scroll', look, { passive: true });
    return () => observer.disconnect();
  }, []);
  useEffect(() => {
    if (stood) return undefined;
    let count = 0;
    const timer = setInterval(() => {
      setTick((at) => at + 1);
      // Rows do not run away from the pointer, or from what is being typed.
      if (++count % kResort === 0 && changes.peek() && !isPointedAt.current && !body.current?.querySelector('input')) resorted.value += 1;
    }, kTick);
    return () => clearInterval(timer);
  }, [stood]);
  // An order by values needs those of rows that are not seen, too.
  const sampled = changes.value && !stood ? found.value : null;
  useEffect(() => sampled && Sample(sampled.map(({ path }) => path)), [sampled]);

  const { first, last } = VisibleRows(place, kRowHeight, rows.value.length);
  const onKey = (event) => {
    const at = rows.value.findIndex(({ path }) => path === selected.value);
    const next = { ArrowDown: at + 1, ArrowUp: at - 1, Home: 0, End: rows.value.length - 1 }[event.key];
    if (event.target.closest('input, button') || next === undefined && event.key !== 'F2') return;
    event.preventDefault();
    event.stopPropagation();
    if (event.key === 'F2') return setEdited(rows.value[at]?.path ?? null);
    const row = rows.value[Math.max(0, Math.min(rows.value.length - 1, next))];
    if (!row) return;
    ShowPort(row.path);
    ScrollTo(body.current, Math.max(0, Math.min(rows.value.length - 1, next)));
  };
  return html`
    <div class="port-table" id="port-table">
      <${Tools} stood=${stood} />
      <div class="grid" role="grid" aria-label="Ports" aria-rowcount=${rows.value.length + 1} aria-colcount=${kColumns.length + 1}>
        <div class="head" role="row" aria-rowindex="1">${kColumns.map((each) => html`<${Head} key=${each.column} ...${each} />`)}
          <span role="columnheader"><span class="unseen">set</span></span></div>
        <div class="body" ref=${body} tabindex="0" role="rowgroup" aria-label="Ports, arrow keys go from one to the next, F2 sets one by hand" onKeyDown=${onKey}
            onPointerEnter=${() => { isPointedAt.current = true; }} onPointerLeave=${() => { isPointedAt.current = false; }}>
          <div class="all" style=${{ height: `${rows.value.length * kRowHeight}px` }}>
            ${rows.value.slice(first, last).map((row, index) => html`<${PortTableRow} key=${row.path} row=${row} tick=${tick}
              number=${first + index} top=${(first + index) * kRowHeight} stood=${stood?.measures.get(row.path)}
              isFrozen=${stood !== null} isSelected=${selected.value === row.path} isEdited=${edited === row.path}
              onEdit=${setEdited} onProblem=${setProblem} />`)}
          </div>
          ${rows.value.length === 0 && html`<p class="none">${all.value.length === 0 ? 'The application has no ports.' : 'No port suits the filter.'}</p>`}
        </div>
      </div>
      ${problem && html`<p class="problem" role="alert">${problem}</p>`}
    </div>`;
}

function Tools({ stood }) {
  const [count, whole] = [rows.value.length, all.value.length];
  return html`<div class="log-tools" role="group" aria-label="Filter">
    <input type="search" id="port-filter" placeholder="Filter …" aria-label="Filter the ports by name or type" value=${text.value}
      onInput=${(event) => { text.value = event.target.value; }} />
    ${kKinds.map((each) => html`<button key=${each.name} class="chip" aria-pressed=${kind.value === each}
        onClick=${() => { kind.value = each; }}>${each.name}</button>`)}
    <button id="port-freeze" class="freeze" aria-pressed=${stood !== null} onClick=${Freeze}
        title="Have the table stand still; the application goes on"><${Icon} name=${stood ? 'play' : 'pause'} size=${14} />
      ${stood ? `Frozen at ${FormatTime(stood.time)}` : 'Freeze'}</button>
    <span class="count">${count < whole ? `${count} of ${whole}` : `${whole} port${whole === 1 ? '' : 's'}`}</span>
  </div>`;
}

function Head(each) {
  const { column, title, label } = each;
  const isSorted = sort.value.column === column;
  const order = !isSorted ? 'none' : sort.value.isDown ? 'descending' : 'ascending';
  return html`<span role="columnheader" class=${column} aria-sort=${order}><button class="link" data-column=${column}
      aria-label=${`Sort by ${label ?? title}`} onClick=${() => SortBy(each)}>${title}<i>${
      !isSorted ? '' : sort.value.isDown ? '↓' : '↑'}</i></button></span>`;
}

function ScrollTo(body, number) {
  const top = number * kRowHeight;
  if (top < body.scrollTop) body.scrollTop = top;
  if (top + kRowHeight > body.scrollTop + body.clientHeight) body.scrollTop = top + kRowHeight - body.clientHeight;
}
