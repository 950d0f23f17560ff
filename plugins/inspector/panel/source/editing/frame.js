// The card around a widget; while the panel is arranged it is moved by its bar and resized by its corner, in steps of
// the grid, by mouse or by arrow keys.

import { useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { NameOf } from '../../../page/source/model/structure.js';
import { Boundary } from '../../../page/source/panels/boundary.js';
import { Icon } from '../../../page/source/panels/icon.js';
import { kColumns } from '../model/grid.js';
import { kKinds } from '../model/kinds.js';
import { MoveWidget, RemoveWidget, chosen, isEditing, widgets } from '../panel_state.js';
import { WidgetView } from '../widgets/widget.js';

const kTitledByThemselves = ['button', 'switch', 'stop', 'text', 'map'];

export function TitleOf(widget) {
  if (widget.title) return widget.title;
  const label = kKinds[widget.kind]?.label ?? widget.kind;
  return ['slider', 'gauge', 'value'].includes(widget.kind) && widget.target ? NameOf(widget.target).replaceAll('_', ' ') : label;
}

/** Where the pointer has been moved to, in columns and rows of the grid around the card. */
function Cells(card, dx, dy) {
  const grid = card.parentElement;
  const style = getComputedStyle(grid);
  const gap = parseFloat(style.rowGap);
  const column = (grid.clientWidth - parseFloat(style.paddingLeft) - parseFloat(style.paddingRight) + gap) / kColumns;
  const row = parseFloat(style.gridAutoRows) + gap;
  return { columns: Math.round(dx / column), rows: Math.round(dy / row) };
}

export function Frame({ widget }) {
  const card = useRef(null);
  const { id, kind, x, y, w, h } = widget;
  const editing = isEditing.value;
  const drag = (event, place) => {
    if (!editing || event.button !== 0 || event.target.closest('.card-tools')) return;
    event.preventDefault();
    chosen.value = id;
    const before = widgets.value;
    const [startX, startY] = [event.clientX, event.clientY];
    const handle = event.currentTarget;
    handle.setPointerCapture(event.pointerId);
    handle.focus({ preventScroll: true });
    handle.onpointermove = (move) => {
      const { columns, rows } = Cells(card.current, move.clientX - startX, move.clientY - startY);
      MoveWidget(before, id, place(columns, rows));
    };
    const end = () => { handle.onpointermove = handle.onpointerup = handle.onpointercancel = null; };
    handle.onpointerup = end;
    handle.onpointercancel = () => { end(); widgets.value = before; };
  };
  const byKey = (event, place) => {
    const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] }[event.key] ?? [];
    if (event.key === 'Delete') RemoveWidget(id);
    if (dx === undefined) return;
    event.preventDefault();
    MoveWidget(widgets.value, id, place(dx, dy));
  };
  const move = (columns, rows) => ({ x: x + columns, y: y + rows });
  const resize = (columns, rows) => ({ w: w + columns, h: h + rows });
  const hasBar = editing || widget.title || !kTitledByThemselves.includes(kind);
  return html`
    <section class=${`card card-${kind} ${editing ? 'editing' : ''} ${chosen.value === id && editing ? 'chosen' : ''}`} ref=${card} data-widget=${id}
        aria-label=${TitleOf(widget)} style=${{ gridArea: `${y + 1} / ${x + 1} / span ${h} / span ${w}`, '--rows': h }}>
      ${hasBar && html`<header class="card-bar" tabindex=${editing ? 0 : undefined} title=${editing ? 'Drag, or use arrow keys' : undefined}
          onPointerDown=${(event) => drag(event, move)} onKeyDown=${editing && ((event) => byKey(event, move))}>
        <h2>${TitleOf(widget)}</h2>
        ${editing && html`<span class="card-tools"><button class="remove" aria-label=${`Remove ${TitleOf(widget)}`} title="Remove"
          onClick=${() => RemoveWidget(id)}><${Icon} name="trash" size=${14} /></button></span>`}</header>`}
      <div class="card-body" inert=${editing} onPointerDown=${undefined}><${Boundary} what=${`“${TitleOf(widget)}”`} of=${widget}><${WidgetView} widget=${widget} /><//></div>
      ${editing && html`<div class="card-cover" onPointerDown=${(event) => drag(event, move)}></div>
        <button class="card-corner" aria-label=${`Size of ${TitleOf(widget)}: arrow keys change it`} title="Size"
          onPointerDown=${(event) => drag(event, resize)} onKeyDown=${(event) => byKey(event, resize)}></button>`}
    </section>`;
}
