// How a behaviour is, in its box: bars for activation, activity and target rating, and its mode.

import { html } from 'htm/preact';
import { useWatched } from '../panels/use_watched.js';
import { SetParameter } from '../state/actions.js';
import { BehaviourOf, ModeAfter, ModeParameter } from '../state/behaviours.js';
import { NoteHeight, kBars, kPicture } from './measure.js';

const kOptions = { rate: 10 };
const kRowHeight = 11;
const kLabel = 24; // width of the letter before a bar
const kNumber = 30;
const kBarsOf = [['ι', 'activation'], ['a', 'activity'], ['r', 'target_rating']];
const kMode = 52; // width of the sign

export function BoxBars({ box }) {
  const path = BehaviourOf(box.path);
  const item = useWatched(path ?? '', kOptions);
  if (!path || !box.bars) return null;
  const state = item?.value ?? {};
  const y = box.height - NoteHeight(box.note) - (box.picture ? kPicture : 0) - kBars;
  const width = box.width - kLabel - kNumber - kMode - 22;
  return html`<g class="bars" transform=${`translate(0,${y})`} data-bars=${box.path} role="img" aria-label=${Told(state)}>
    ${kBarsOf.map(([letter, name], row) => html`<g key=${name} class=${name} transform=${`translate(14,${row * kRowHeight})`}>
      <text y="8">${letter}</text>
      <rect class="ground" x=${kLabel - 10} y="2" width=${width} height="6" rx="2" />
      <rect class="bar" x=${kLabel - 10} y="2" width=${Math.max(0, Math.min(1, state[name] ?? 0)) * width} height="6" rx="2" />
      <text x=${box.width - kMode - 30} y="8.5" text-anchor="end">${Number.isFinite(state[name]) ? state[name].toFixed(2) : ''}</text></g>`)}
    <title>${Told(state)}</title></g><${ModeSign} box=${box} mode=${state.mode} y=${y + 9} />`;
}

/** Beside the bars; a press sets the next one. */
function ModeSign({ box, mode, y }) {
  const parameter = ModeParameter(box.path);
  if (!parameter || !mode) return null;
  const stay = (event) => event.stopPropagation(); // it is no press on the box
  const next = ModeAfter(mode);
  return html`<g class=${`mode-sign ${mode}`} transform=${`translate(${box.width - kMode - 9},${y})`}
      data-mode-of=${box.path} role="button" aria-label=${`Stimulation of ${box.element.name}: ${mode}`} onPointerDown=${stay} onPointerUp=${stay}
      onClick=${(event) => { stay(event); SetParameter(parameter.path, next); }}>
    <title>stimulation: ${mode}; press: ${next}</title>
    <rect width=${kMode} height="14" rx="7" /><text x=${kMode / 2} y="10.5" text-anchor="middle">${mode}</text></g>`;
}

function Told(state) {
  return kBarsOf.map(([, name]) => `${name.replace('_', ' ')} ${Number.isFinite(state[name]) ? state[name].toFixed(2) : 'not known'}`).join(', ');
}
