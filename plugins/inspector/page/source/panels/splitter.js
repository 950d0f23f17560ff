// A bar between two panels that can be dragged, or moved by arrow keys.

import { html } from 'htm/preact';
import { SetPanels, panels } from '../state/choices.js';

const kStep = 24;

/** `name`: of the size in `panels` that it sets; `axis`: 'x' or 'y'; `sign`: 1 if dragging right or down enlarges. */
export function Splitter({ name, axis, sign, least, most, label }) {
  const set = (value) => SetPanels({ [name]: Math.round(Math.min(most, Math.max(least, value))) });
  const onDown = (event) => {
    event.preventDefault();
    const start = axis === 'x' ? event.clientX : event.clientY;
    const before = panels.value[name];
    const bar = event.currentTarget;
    bar.setPointerCapture(event.pointerId);
    bar.onpointermove = (move) => set(before + sign * ((axis === 'x' ? move.clientX : move.clientY) - start));
    bar.onpointerup = bar.onpointercancel = () => { bar.onpointermove = null; };
  };
  const onKey = (event) => {
    const direction = { ArrowLeft: -1, ArrowUp: -1, ArrowRight: 1, ArrowDown: 1 }[event.key];
    if (direction) set(panels.value[name] + sign * direction * kStep);
  };
  return html`<div class=${`splitter ${axis}`} role="separator" tabindex="0" aria-label=${label}
    aria-orientation=${axis === 'x' ? 'vertical' : 'horizontal'} aria-valuenow=${panels.value[name]}
    aria-valuemin=${least} aria-valuemax=${most} onPointerDown=${onDown} onKeyDown=${onKey} />`;
}
