// The graph from far away: thousands of boxes in a handful of paths, one for each thread.

import { html } from 'htm/preact';
import { ThreadOf } from '../model/structure.js';
import { AlarmCount } from '../state/alarms.js';
import { selected } from '../state/choices.js';
import { structure } from '../state/store.js';
import { shown } from './graph_state.js';
import { ThreadColour } from './thread_colour.js';

const kAlarmed = ' alarmed'; // no name of a thread
const kLetters = 0.62; // width of a letter, in its size

export function FarView() {
  const { groups, boxes, edges } = shown.value;
  const byThread = new Map();
  for (const box of boxes) {
    const thread = AlarmCount(box.path) > 0 ? kAlarmed : ThreadOf(structure, box.path);
    byThread.set(thread, (byThread.get(thread) ?? '') + Rectangle(box));
  }
  const lines = edges.map(Line).join('');
  const chosen = boxes.find((box) => box.path === selected.value);
  return html`
    <path class="edges-far" d=${lines} />
    ${[...byThread].map(([thread, path]) =>
      html`<path key=${thread} class="boxes-far" style=${{ fill: thread === kAlarmed ? 'var(--bad)' : ThreadColour(thread) }} d=${path} />`)}
    ${chosen && html`<path class="chosen-far" d=${Rectangle(chosen)} />`}
    ${groups.filter((group) => group.depth < 2).map((group) => html`<text class="name-far" key=${group.path}
      x=${group.x + group.width / 2} y=${group.y + group.height / 2} text-anchor="middle"
      style=${{ fontSize: `${LetterSize(group)}px` }}>${group.element.name}</text>`)}`;
}

function Rectangle({ x, y, width, height }) {
  return `M${Math.round(x)},${Math.round(y)}h${width}v${height}h${-width}z`;
}

function Line({ start, end }) {
  return `M${Math.round(start.x)},${Math.round(start.y)}L${Math.round(end.x)},${Math.round(end.y)}`;
}

function LetterSize({ width, height, element }) {
  return Math.min(height * 0.5, width * 0.8 / (element.name.length * kLetters));
}
