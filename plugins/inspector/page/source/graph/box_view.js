// One box of the graph: a module, or a group that is folded, with its ports.

import { useComputed } from '@preact/signals';
import { html } from 'htm/preact';
import { memo } from '../panels/memo.js';
import { AlarmCount, AlarmsAt } from '../state/alarms.js';
import { DelayText } from '../model/network.js';
import { ThreadOf } from '../model/structure.js';
import { chosen, selectedThread } from '../state/choices.js';
import { revision, structure } from '../state/store.js';
import { notes } from '../state/arrangement.js';
import { DrawingOf } from '../state/pictured.js';
import { BoxBars } from './box_bars.js';
import { BoxPicture, PictureSign } from './box_picture.js';
import { BoxTime } from './box_time.js';
import { NoteHeight, PortHeight, kHeader, kNoteRow } from './measure.js';
import { PortView } from './port_view.js';
import { ThreadColour } from './thread_colour.js';

export const BoxView = memo(({ box }) => {
  const { path, element } = box;
  const isSelected = useComputed(() => chosen.value.includes(path));
  const thread = useComputed(() => {
    revision.value;
    return ThreadOf(structure, path);
  }).value;
  const isFaint = useComputed(() => selectedThread.value !== null && selectedThread.value !== thread);
  const count = useComputed(() => AlarmCount(path)).value;
  const isGroup = element.kind !== 'module';
  const isAlarmed = element.failure || count > 0;
  const hasSign = !isGroup && DrawingOf(path) !== undefined;
  const classes = ['box', element.kind, element.far && 'far', element.far && !element.is_there && 'absent', isSelected.value && 'selected', element.failure && 'failed', count > 0 && 'alarmed', element.paused && 'paused',
    isFaint.value && 'faint'].filter(Boolean).join(' ');
  return html`
    <g class=${classes} transform=${`translate(${box.x},${box.y})`} data-node=${path} id=${NodeId(path)}
       role="treeitem" aria-label=${DescribeBox(box, thread)} aria-selected=${isSelected.value}>
      ${isGroup && html`<rect class="behind" x="4" y="4" width=${box.width} height=${box.height} rx="6" />`}
      <rect class="body" width=${box.width} height=${box.height} rx="6" />
      <path class="stripe" style=${{ fill: ThreadColour(thread) }}
        d=${`M6,0a6,6 0 0 0 -6,6V${box.height - 6}a6,6 0 0 0 6,6z`} />
      ${box.inputs.length + box.outputs.length > 0 &&
        html`<path class="rule" d=${`M8,${kHeader - 3}H${box.width - 8}`} />`}
      <text class="name" x="14" y="18" style=${{ '--most': `${MostSize(box)}px` }}>${Cut(element.name, (box.width - 44) / 8)}</text>
      <text class="type" x="14" y="32">${Cut(Detail(box), (box.width - 26) / 6.6)}</text>
      ${!isGroup && html`<${BoxTime} path=${path} x=${box.width - 10 - (isAlarmed ? 22 : 0) - (hasSign ? 22 : 0)} y=${18} />
        <${PictureSign} box=${box} /><${BoxPicture} box=${box} />`}
      ${box.bars && html`<${BoxBars} box=${box} />`}
      ${isGroup && !element.far && html`<g class="fold" data-fold=${path}><rect x=${box.width - 28} y="5" width="22" height="22"
          rx="4" />
        <path d=${`M${box.width - 20},${11}l5,5l-5,5`} /></g>`}
      ${isAlarmed && html`<g class="fault" transform=${`translate(${box.width - (isGroup || hasSign ? 40 : 18)},16)`}>
        <circle r="8.5" /><text y="4" text-anchor="middle">!</text><title>${AlarmsAt(path).map(({ text }) => text).join('\n')}</title></g>`}
      ${box.note.length > 0 && html`<g class="note-on" transform=${`translate(0,${box.height - NoteHeight(box.note)})`}>
        <path d=${`M6,0H${box.width - 1}V${NoteHeight(box.note) - 6}a5,5 0 0 1 -5,5H6z`} />
        ${box.note.map((line, index) => html`<text key=${index} x="14" y=${14 + index * kNoteRow}>${line}</text>`)}</g>`}
      ${box.inputs.map((port, index) =>
        html`<${PortView} key=${port.path} port=${port} x=${0} y=${PortHeight(index)} side="left" />`)}
      ${box.outputs.map((port, index) =>
        html`<${PortView} key=${port.path} port=${port} x=${box.width} y=${PortHeight(index)} side="right" />`)}
    </g>`;
});

/** The frame of a group that is open, with its own ports on the border. */
export const GroupFrame = memo(({ box }) => {
  const { path, element } = box;
  const isSelected = useComputed(() => chosen.value.includes(path));
  const thread = element.thread ?? null;
  const note = useComputed(() => notes.value.get(path) ?? '').value;
  return html`
    <g class=${`frame ${isSelected.value ? 'selected' : ''}`} transform=${`translate(${box.x},${box.y})`}
       data-node=${path} id=${NodeId(path)} role="treeitem" aria-expanded="true"
       aria-label=${DescribeBox(box, thread)} aria-selected=${isSelected.value}>
      <rect class="body" width=${box.width} height=${box.height} rx="10" />
      <path class="bar" d=${`M0,30V10a10,10 0 0 1 10,-10H${box.width - 10}a10,10 0 0 1 10,10V30z`} />
      <g class="fold" data-fold=${path}><rect x="6" y="4" width="22" height="22" rx="4" />
        <path d="M12,12l5,5l5,-5" /></g>
      <text class="name" x="34" y="20">${element.name}</text>
      ${note && html`<text class="frame-note" x=${56 + element.name.length * 8.2 + (thread ? 10 : 0)} y="20">${
        Cut(note, Math.max(0, (box.width - 70 - element.name.length * 8.2) / 6.3))}</text>`}
      ${thread && html`<circle class="thread" cx=${44 + element.name.length * 8.2} cy="15.5" r="4"
        style=${{ fill: ThreadColour(thread) }}><title>run by ${thread}</title></circle>`}
      ${[...box.level.border].map(([port, place]) =>
        html`<${PortView} key=${port} port=${structure.get(port)} x=${place.x} y=${place.y}
          side=${place.side} inside />`)}
    </g>`;
});

export function NodeId(path) {
  return `node:${path}`;
}

/** What a screen reader says of a box. */
export function DescribeBox({ element, hidden, open, inputs, outputs }, thread) {
  const parts = [element.name, element.kind === 'module' ? `module ${element.type}` : element.far ? 'another application' : 'group'];
  if (element.kind !== 'module' && !element.far) parts.push(open ? 'open' : `folded, ${hidden} modules`);
  parts.push(Count(inputs.length, 'input'), Count(outputs.length, 'output'));
  if (thread) parts.push(`thread ${thread}`);
  if (element.failure) parts.push(`failed: ${element.failure}`);
  return parts.join(', ');
}

/** How large the name can be. */
function MostSize({ element, width, height }) {
  return Math.max(13, Math.min((width - 40) / (element.name.length * 0.6), height * 0.5));
}

function Count(number, word) {
  return `${number} ${word}${number === 1 ? '' : 's'}`;
}

function Detail({ element, hidden }) {
  if (element.far) return !element.is_there ? 'not there' : element.delay === null ? 'in the network' : `in the network, ${DelayText(element.delay)}`;
  return element.kind === 'module' ? element.type ?? '' : Count(hidden, 'module');
}

function Cut(text, letters) {
  return text.length > letters ? `${text.slice(0, Math.max(1, Math.floor(letters) - 1))}…` : text;
}
