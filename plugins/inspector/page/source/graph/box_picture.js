// What a module draws, in its box, and the sign that shows it there or no more.

import { html } from 'htm/preact';
import { DrawingPicture } from '../panels/drawing_picture.js';
import { DrawingOf, IsPictured, TogglePicture } from '../state/pictured.js';
import { NoteHeight, kPicture } from './measure.js';

export function BoxPicture({ box }) {
  const path = DrawingOf(box.path);
  if (!path || !box.picture) return null;
  const width = box.width - 20;
  return html`<foreignObject class="picture-in-box" x="12" y=${box.height - NoteHeight(box.note) - kPicture - 2} width=${width} height=${kPicture - 6}>
    <${DrawingPicture} path=${path} width=${width} height=${kPicture - 6} /></foreignObject>`;
}

/** Left of the box's right upper corner. */
export function PictureSign({ box }) {
  if (!DrawingOf(box.path)) return null;
  const isShown = IsPictured(box.path);
  const stay = (event) => event.stopPropagation(); // it is no press on the box
  return html`<g class=${`picture-sign ${isShown ? 'shown' : ''}`} transform=${`translate(${box.width - 26},8)`} data-picture-of=${box.path}
      role="button" aria-pressed=${isShown} aria-label=${`Show what ${box.element.name} draws`} onPointerDown=${stay} onPointerUp=${stay}
      onClick=${(event) => { stay(event); TogglePicture(box.path); }}>
    <title>${isShown ? 'Hide what it draws' : 'Show what it draws'}</title>
    <rect x="-3" y="-3" width="22" height="20" rx="4" /><path d="M1,12l4,-5l3,3l3,-6l4,4" /></g>`;
}
