// The data-flow graph: boxes and edges, moved and zoomed as one; mouse and keys are in files beside.

import { useEffect, useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { announcement, selected } from '../state/choices.js';
import { hello } from '../state/store.js';
import { BoxView, GroupFrame, NodeId } from './box_view.js';
import { EdgeNote, EdgeView } from './edge_view.js';
import { FarView } from './far_view.js';
import { OnGraphKey } from './graph_keys.js';
import { Fit, StartFitting, Zoom, band, connecting, layout, shown, size, view } from './graph_state.js';
import { HoverCard } from './hover_card.js';
import { Minimap } from './minimap.js';
import { AttachPointer } from './pointer.js';

export function GraphView() {
  const host = useRef(null);
  useEffect(() => {
    const observer = new ResizeObserver(([entry]) => {
      size.value = { width: entry.contentRect.width, height: entry.contentRect.height };
    });
    observer.observe(host.current);
    const stopFitting = StartFitting();
    const detach = AttachPointer(host.current);
    return () => { observer.disconnect(); stopFitting(); detach(); };
  }, []);
  const path = selected.value;
  const active = path && document.getElementById(NodeId(path)) ? NodeId(path) : path ? `port:${path}` : undefined;
  return html`
    <div class=${`graph ${connecting.value ? 'connecting' : ''}`} ref=${host} tabindex="0" id="graph"
         role="tree" aria-label=${`Data flow of ${hello.value?.application ?? 'the application'}`}
         aria-describedby="graph-help" aria-activedescendant=${active} onKeyDown=${OnGraphKey}>
      <svg aria-hidden="false" role="presentation"><${Drawing} /></svg>
      <p id="graph-help" class="unseen">Arrow keys go from module to module, with Shift along the ports
        of a module. Enter opens and folds groups, C connects a port, Delete deletes, question mark
        lists all keys.</p>
      <p class="unseen" role="status" aria-live="polite">${announcement.value}</p>
      ${layout.value.boxes.size === 0 && html`<p class="empty">${
        hello.value ? 'The application has no modules yet. Press A to add one.' : 'Waiting for the application …'}</p>`}
      <${HoverCard} />
      <${Minimap} />
      <${ZoomButtons} />
    </div>`;
}

function Drawing() {
  const { x, y, scale } = view.value;
  return html`
    <g class=${`scene ${scale < 0.5 ? 'coarse' : ''}`} style=${{ '--name': `${NameSize(scale)}px` }}
        transform=${`translate(${x},${y}) scale(${scale})`}>
      <${Contents} />
    </g>`;
}

/** From further away names are larger than the rest, so that they can be read; in steps. */
function NameSize(scale) {
  return [14, 17, 20, 24, 28].find((size) => size * scale >= 9) ?? 34;
}

function Contents() {
  const { groups, boxes, edges, far } = shown.value;
  const frames = far ? groups.filter((group) => group.depth < 2) : groups;
  return html`
    ${frames.map((box) => html`<${GroupFrame} key=${box.path} box=${box} />`)}
    ${far ? html`<${FarView} />` : html`
      <g>${edges.map((edge) => html`<${EdgeView} key=${edge.key} edge=${edge} />`)}</g>
      <g>${edges.map((edge) => html`<${EdgeNote} key=${edge.key} edge=${edge} />`)}</g>
      <g>${boxes.map((box) => html`<${BoxView} key=${box.path} box=${box} />`)}</g>`}
    <${NewEdge} />
    <${Band} />`;
}

/** The line from a port to the pointer while one connects. */
function NewEdge() {
  const drag = connecting.value;
  const place = drag?.pointer && layout.value.ports.get(drag.port);
  if (!place) return null;
  const end = (drag.target && layout.value.ports.get(drag.target)) || drag.pointer;
  const reach = Math.max(30, Math.abs(end.x - place.x) / 2) * (place.side === 'left' ? -1 : 1);
  return html`<path class=${`edge new ${drag.target ? 'fits' : drag.blocked ? 'blocked' : ''}`}
    d=${`M${place.x},${place.y}C${place.x + reach},${place.y} ${end.x - reach},${end.y} ${end.x},${end.y}`} />`;
}

/** What is being drawn around boxes to choose them. */
function Band() {
  const area = band.value;
  return area && html`<rect class="band" x=${area.left} y=${area.top} width=${area.right - area.left} height=${area.bottom - area.top} />`;
}

function ZoomButtons() {
  return html`
    <div class="zoom-buttons" role="group" aria-label="Zoom">
      <button onClick=${() => Zoom(1.25)} aria-label="Zoom in" title="Zoom in (+)">+</button>
      <button onClick=${() => Zoom(0.8)} aria-label="Zoom out" title="Zoom out (−)">−</button>
      <button onClick=${Fit} aria-label="Fit the graph" title="Fit (F)">⤢</button>
      <output aria-label="Zoom factor">${Math.round(view.value.scale * 100)} %</output>
    </div>`;
}
