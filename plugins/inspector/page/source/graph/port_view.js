// A port of a box: a dot that edges begin or end at, its name, and how often it publishes.

import { useComputed } from '@preact/signals';
import { html } from 'htm/preact';
import { memo } from '../panels/memo.js';
import { FormatRate } from '../model/value_format.js';
import { AlarmCount } from '../state/alarms.js';
import { selected } from '../state/choices.js';
import { FlowRate, shapeRevision } from '../state/store.js';
import { candidates, connecting } from './graph_state.js';

export const PortView = memo(({ port, x, y, side, inside }) => {
  const isSelected = useComputed(() => selected.value === port.path);
  const role = useComputed(() => {
    if (candidates.value === null) return '';
    if (connecting.value?.target === port.path) return 'target';
    if (connecting.value?.blocked === port.path) return 'blocked';
    return candidates.value.has(port.path) || connecting.value?.port === port.path ? 'candidate' : 'other';
  });
  const isAlarmed = useComputed(() => AlarmCount(port.path) > 0);
  const isLeft = side === 'left';
  const labelRight = inside ? !isLeft : isLeft; // on which side of the dot there is room for the name
  const label = inside ? isLeft : labelRight;
  return html`
    <g class=${`port ${port.direction} ${port.by_hand ? 'by-hand' : ''} ${port.offers ? 'offered' : ''} ${role.value} ${isSelected.value ? 'selected' : ''} ${isAlarmed.value ? 'alarmed' : ''}`}
       data-port=${port.path} id=${`port:${port.path}`} transform=${`translate(${x},${y})`}
       role="treeitem" aria-label=${DescribePort(port)} aria-selected=${isSelected.value}>
      <rect class="grip" x=${label ? -9 : -(port.name.length * 6.9 + 12)} y="-10" height="20"
        width=${port.name.length * 6.9 + 21} />
      ${inside && html`<path class="lead" 
        d=${`M0,0H${(port.name.length * 6.75 + 14) * (isLeft ? 1 : -1)}`} />`}
      <circle r="4" class=${port.required ? 'required' : ''} />
      <text x=${label ? 10 : -10} y="3.8" text-anchor=${label ? 'start' : 'end'}>${port.name}</text>
      ${!isLeft && html`<${Rate} path=${port.path} />`}
    </g>`;
});

/** Publications per second, beside the beginning of an edge. */
function Rate({ path }) {
  const text = useComputed(() => {
    shapeRevision.value;
    if (AlarmCount(path) > 0) return 'silent';
    const rate = FlowRate(path);
    return rate === null ? '' : FormatRate(rate);
  });
  const words = text.value;
  return words && html`<rect class="rate-ground" x="7" y="-13" width=${words.length * 5.7 + 4} height="11.5" rx="3" />
    <text class="rate" x="9" y="-4">${words}</text>`;
}

export function DescribePort(port) {
  return `${port.direction} ${port.name}, ${port.data_type}${port.required ? ', required' : ''}${port.offers ? ', offered in the network' : ''}${port.far ? `, ${port.state}` : ''}${port.by_hand ? ', set by hand' : ''}`;
}
