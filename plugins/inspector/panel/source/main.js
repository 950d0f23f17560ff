// The operator's panel: widgets on a grid, in one column on a phone, with what drives and the STOP under the thumb.

import { render } from 'preact';
import { effect, signal } from '@preact/signals';
import { html } from 'htm/preact';
import { Boundary } from '../../page/source/panels/boundary.js';
import { Toasts } from '../../page/source/panels/toast_view.js';
import { TokenBanner } from '../../page/source/panels/token_banner.js';
import { LostBanner } from '../../page/source/panels/toolbar.js';
import { StartKeeping } from '../../page/source/state/choices.js';
import { Start, catalogue, hello, isConnected, structureOf } from '../../page/source/state/store.js';
import { WatchThePage } from './driving/driving.js';
import { Frame } from './editing/frame.js';
import { Palette } from './editing/palette.js';
import { Settings } from './editing/settings.js';
import { Header } from './header.js';
import { InOrder, RowsOf } from './model/grid.js';
import { Load, chosen, isEditing, isLoaded, widgets } from './panel_state.js';
import { ShowStop } from '../../page/source/stop/stop_view.js';
import { HandBanner } from './widgets/hand_banner.js';

const kNarrow = '(max-width: 640px)';
const kByThumb = 'joystick'; // the first of them stays on a phone's screen, beside the STOP
const kOfDesks = ['keys', 'gamepad', 'stop'];

const isNarrow = signal(matchMedia(kNarrow).matches);
matchMedia(kNarrow).addEventListener('change', (event) => { isNarrow.value = event.matches; });

function Page() {
  const editing = isEditing.value;
  return html`
    <div class=${`panel ${isConnected.value ? '' : 'stale'} ${editing ? 'is-editing' : ''} ${isNarrow.value ? 'narrow' : ''}`}>
      <${Header} />
      <${LostBanner} />
      <${TokenBanner} />
      <${HandBanner} />
      ${editing && html`<${Palette} />`}
      <div class="panel-main">${isLoaded.value && (isNarrow.value && !editing ? html`<${Column} />` : html`<${Grid} />`)}
        ${editing && html`<${Settings} />`}</div>
      <${Toasts} />
    </div>`;
}

/** As many rows as there were when arranging began: while something is dragged the grid keeps its scale. */
let rows = 1;

function Grid() {
  if (!isEditing.value) rows = Math.max(1, RowsOf(widgets.value));
  return html`<main class="grid" aria-label="Panel" style=${{ '--rows-of-all': rows }}
      onPointerDown=${(event) => { if (event.target === event.currentTarget) chosen.value = null; }}>
    ${widgets.value.map((widget) => html`<${Frame} key=${widget.id} widget=${widget} />`)}
    ${widgets.value.length === 0 && html`<p class="none empty-panel">Nothing is on this panel. ${isEditing.value ? 'Add something from above.' : 'Press Arrange to put something onto it.'}</p>`}
  </main>`;
}

function Column() {
  const all = InOrder(widgets.value).filter(({ kind }) => !kOfDesks.includes(kind));
  const byThumb = all.filter(({ kind }) => kind === kByThumb).slice(0, 1);
  return html`
    <main class="column" aria-label="Panel">${all.filter((each) => !byThumb.includes(each)).map((widget) => html`<${Frame} key=${widget.id} widget=${widget} />`)}</main>
    ${byThumb.length > 0 && html`<section class="thumb" aria-label="Driving">${byThumb.map((widget) => html`<${Frame} key=${widget.id} widget=${widget} />`)}</section>`}`;
}

StartKeeping();
ShowStop();
WatchThePage();
effect(() => {
  if (isConnected.value && structureOf.value === hello.value.run && catalogue.value.types.size > 0) Load();
});
effect(() => {
  const name = hello.value?.application;
  if (name) document.title = `${isConnected.value ? '' : '(away) '}${name} – panel`;
});
const { protocol, host } = location;
Start(`${protocol === 'https:' ? 'wss' : 'ws'}://${host}/`);
render(html`<${Boundary} what="The panel" of=${0}><${Page} /><//>`, document.getElementById('panel'));
