// A row of the table of ports. Its value is asked for while it is there.

import { useEffect, useRef, useState } from 'preact/hooks';
import { untracked } from '@preact/signals';
import { html } from 'htm/preact';
import { EditableText, FormatAge, FormatBandwidth, FormatPortValue, IsExact } from '../model/port_table.js';
import { FormatRate } from '../model/value_format.js';
import { ErrorText, PublishByHand, Release } from '../state/actions.js';
import { Reveal } from '../state/choices.js';
import { MeasuresOf, Remember, kElements } from '../state/port_measures.js';
import { canDrive, catalogue, structure, watches } from '../state/store.js';
import { Select } from '../graph/graph_keys.js';
import { Icon } from './icon.js';
import { memo } from './memo.js';

const kRate = 4;
const kWhole = 20000;   // elements of lists, in a value that is edited
const kPatience = 3000; // ms, for it to come
const kRounded = 'it has a whole number that a browser rounds';

/** Selects a port, here and in the graph. */
export function ShowPort(path) {
  Reveal(path);
  Select(path);
}

export const PortTableRow = memo(({ row, number, top, stood, isFrozen, isSelected, isEdited, onEdit, onProblem }) => {
  const { path, owner, name, direction, type } = row;
  const [, setItem] = useState(null);
  useEffect(() => {
    if (isFrozen) return undefined;
    return watches.watch(path, { rate: kRate, elements: kElements, onValue: (item) => { Remember(path, item); setItem(item); } }).end;
  }, [path, isFrozen]);
  const { item = null, rate = null, bandwidth = null, age = null } = isFrozen ? stood ?? {} : untracked(() => MeasuresOf(row));
  const known = catalogue.value.type(type);
  const canSet = canDrive.value && known?.kind !== 'opaque';
  const port = structure.get(path);
  const byHand = Boolean(port?.by_hand || port?.blocked);
  const edit = () => { if (canSet) { onProblem(''); onEdit(path); } };
  const unit = port?.unit;
  return html`
    <div class=${`row ${isSelected ? 'selected' : ''} ${byHand ? 'by-hand' : ''}`} role="row" aria-rowindex=${number + 2}
        aria-selected=${isSelected} data-port-line=${path} style=${{ top: `${top}px` }}
        onClick=${(event) => { if (!event.target.closest('input, .tools')) ShowPort(path); }}>
      <span role="gridcell" class=${`direction ${direction}`} title=${direction}>${direction === 'input' ? 'in' : 'out'}</span>
      <span role="gridcell" class="name" title=${path}>${owner && html`<small>${owner}/</small>`}${name}</span>
      <span role="gridcell" class="type">${type}</span>
      <span role="gridcell" class="value" onDblClick=${edit}>${isEdited
        ? html`<${Editor} path=${path} type=${type} item=${item} onEdit=${onEdit} onProblem=${onProblem} values=${known?.values} />`
        : known?.kind === 'opaque' ? html`<span class="none">not shown</span>`
        : item ? html`${FormatPortValue(known?.meaning, item.value)}${unit && html` <small>${unit}</small>`}` : html`<span class="none">–</span>`}</span>
      <span role="gridcell" class="rate">${rate === null ? '' : FormatRate(rate)}</span>
      <span role="gridcell" class="bandwidth">${FormatBandwidth(bandwidth)}</span>
      <span role="gridcell" class="age">${FormatAge(age)}</span>
      <span role="gridcell" class="tools">
        ${byHand && html`<button class="release" disabled=${!canDrive.value} onClick=${() => Release(path)}
            title="Readers find again what is published" aria-label=${`Release ${path}`}>Release</button>`}
        <button class="edit" disabled=${!canSet} onClick=${edit} title="Set by hand (F2)"
            aria-label=${`Set ${path} by hand`}><${Icon} name="edit" size=${13} /></button></span>
    </div>`;
});

/** Only Enter sets a value; Escape, and leaving the field, drop what was typed. What the row has cut is fetched whole. */
function Editor({ path, type, item, onEdit, onProblem, values }) {
  const [text, setText] = useState(item?.cut ? null : EditableText(item?.value)); // null: it is still to come
  const input = useRef(null);
  const giveUp = (why) => { onProblem(`${path} cannot be edited here: ${why}`); onEdit(null); };
  useEffect(() => {
    input.current.focus();
    if (item && !IsExact(catalogue.value, type, item.value)) giveUp(kRounded);
    if (!item?.cut) return undefined;
    const timer = setTimeout(() => giveUp('its value is too long'), kPatience);
    const { end } = watches.watch(path, { rate: kRate, elements: kWhole, onValue: (whole) => {
      if (!whole || whole.cut) return; // one that was on its way
      clearTimeout(timer);
      if (IsExact(catalogue.value, type, whole.value)) setText((known) => known ?? EditableText(whole.value));
      else giveUp(kRounded);
    } });
    return () => { clearTimeout(timer); end(); };
  }, []);
  useEffect(() => input.current.select(), [text === null]);
  const onKey = async (event) => {
    event.stopPropagation();
    if (event.key === 'Escape') return onEdit(null);
    if (event.key !== 'Enter' || text === null) return undefined;
    const reply = await PublishByHand(path, text, null);
    onProblem(reply.ok ? '' : (reply.errors ?? []).map(ErrorText).join('\n') || 'it was refused');
    return reply.ok && onEdit(null);
  };
  const list = `values:${path}`;
  return html`<input ref=${input} type="text" spellcheck="false" autocomplete="off" aria-label=${`Value of ${path} by hand; Enter sets it`}
      list=${values?.length > 0 ? list : undefined} value=${text ?? ''} readonly=${text === null} placeholder=${text === null ? 'is fetched …' : ''} onInput=${(event) => setText(event.target.value)}
      onKeyDown=${onKey} onBlur=${() => onEdit(null)} />
    ${values?.length > 0 && html`<datalist id=${list}>${values.map((value) => html`<option key=${value} value=${value} />`)}</datalist>`}`;
}
