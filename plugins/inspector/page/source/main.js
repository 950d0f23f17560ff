// The page: its parts, and the keys that work everywhere.

import { render } from 'preact';
import { html } from 'htm/preact';
import { StartAddress } from './address.js';
import { OpenDialog } from './dialogs/dialogs.js';
import { GraphView } from './graph/graph_view.js';
import { AttachKeys } from './panels/page_keys.js';
import { Boundary } from './panels/boundary.js';
import { Details } from './panels/details.js';
import { Dock } from './panels/dock.js';
import { PhonePage } from './panels/phone_page.js';
import { Splitter } from './panels/splitter.js';
import { Toasts } from './panels/toast_view.js';
import { TokenBanner } from './panels/token_banner.js';
import { LostBanner, Toolbar } from './panels/toolbar.js';
import { SetPanels, StartKeeping, panels } from './state/choices.js';
import { ShowStop } from './stop/stop_view.js';
import { isNarrow, isPhone } from './state/window.js';
import { Start, isConnected } from './state/store.js';
import { WorldView, hasWorld } from './world/world_view.js';

function Page() {
  const { side, dock, world } = panels.value;
  const kind = isPhone.value ? 'phone' : isNarrow.value ? 'narrow' : '';
  return html`
    <div class=${`page ${kind} ${isConnected.value ? '' : 'stale'}`}
        style=${{ '--side': `${side}px`, '--dock': `${dock}px`, '--world': `${world}px` }}>
      <${Toolbar} />
      <${LostBanner} />
      <${TokenBanner} />
      ${isPhone.value ? html`<${PhonePage} />` : html`<${DeskPage} />`}
      <${Toasts} />
      <${OpenDialog} />
    </div>`;
}

function DeskPage() {
  const { dockOpen, worldShown, worldLarge, sideOpen } = panels.value;
  const showsWorld = worldShown && hasWorld.value;
  const showsSide = !isNarrow.value || sideOpen;
  return html`
    <main class="main" aria-label="Data flow">
      ${showsWorld && worldLarge ? html`<${WorldView} />` : html`<${GraphView} />`}
      ${dockOpen && html`<${Splitter} name="dock" axis="y" sign=${-1} least=${80} most=${700} label="Height of the lower panel" />`}
      <${Dock} />
    </main>
    ${showsSide && html`
      <${Splitter} name="side" axis="x" sign=${-1} least=${280} most=${900} label="Width of the side panel" />
      <aside class="side" aria-label="World and details">
        ${isNarrow.value && html`<button class="remove close-side" aria-label="Close the panel"
          onClick=${() => SetPanels({ sideOpen: false })}>✕</button>`}
        ${showsWorld && !worldLarge && html`<div class="world-small"><${WorldView} /></div>
          <${Splitter} name="world" axis="y" sign=${1} least=${120} most=${800} label="Height of the world" />`}
        ${showsWorld && worldLarge && html`<div class="graph-small"><${GraphView} /></div>`}
        <${Details} />
      </aside>`}`;
}

ShowStop(); // first of all, whatever becomes of the rest
StartKeeping();
StartAddress();
AttachKeys();
const { protocol, host, pathname } = location;
Start(`${protocol === 'https:' ? 'wss' : 'ws'}://${host}${pathname}`);
render(html`<${Boundary} what="The page" of=${0}><${Page} /><//>`, document.getElementById('page'));
