// What a port carries, beside the pointer.

import { signal } from '@preact/signals';
import { useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { NumberScales } from '../model/number_scales.js';
import { FormatNumber, FormatValue, kNoText } from '../model/value_format.js';
import { useWatched } from '../panels/use_watched.js';
import { catalogue, structure } from '../state/store.js';
import { size } from './graph_state.js';

export const hovered = signal(null); // the port under the pointer: {path, x, y}

export function HoverCard() {
  const at = hovered.value;
  const element = at ? structure.get(at.path) : null;
  if (!element) return null;
  const right = at.x > size.value.width - 300;
  const below = at.y > size.value.height - 130;
  const style = {
    left: right ? undefined : `${at.x + 16}px`, right: right ? `${size.value.width - at.x + 12}px` : undefined,
    top: below ? undefined : `${at.y + 14}px`, bottom: below ? `${size.value.height - at.y + 12}px` : undefined,
  };
  return html`
    <div class="hover-card" style=${style} role="tooltip">
      <strong>${element.name}</strong> <span class="type">${element.data_type}</span>
      ${element.description && html`<p>${element.description}</p>`}
      <${LiveValue} path=${element.path} key=${element.path} type=${element.data_type} />
    </div>`;
}

function LiveValue({ path, type }) {
  const scales = useRef(new NumberScales());
  const item = useWatched(path, { rate: 5 });
  if (!item) return html`<p class="value none">nothing yet</p>`;
  return html`<p class="value">${
    catalogue.value.isOpaque(type) ? kNoText : FormatValue(item.value, 90, scales.current)}</p>
    <p class="stamp">${item.count} values, the last at ${FormatNumber(item.stamp)} s</p>`;
}
