// The page: its parts, and the keys that work everywhere.

import { render } from 'preact';
import { html } from 'htm/preact';
import { OpenDialog } from './dialogs/dialogs.js';
import { GraphView } from './graph/graph_view.js';
import { AttachKeys } from './panels/page_keys.js';
import { Details } from './panels/details.js';
import { Dock } from './panels/dock.js';
import { Splitter } from './panels/splitter.js';
import { Toasts } from './panels/toast_view.js';
import { LostBanner, Toolbar } from './panels/toolbar.js';
import { StartKeeping, panels } from './state/choices.js';
import { Start, isConnected } from './state/store.js';
import { WorldView, hasWorld } from './world/world_view.js';

function Page() {
  const { side, dock, dockOpen, world, worldShown, worldLarge } = panels.value;
  const showsWorld = worldShown && hasWorld.value;
  return html`
    <div class=${`page ${isConnected.value ? '' : 'stale'}`}
        style=${{ '--side': `${side}px`, '--dock': `${dock}px`, '--world': `${world}px` }}>
      <${Toolbar} />
      <${LostBanner} />
      <main class="main" aria-label="Data flow">
        ${showsWorld && worldLarge ? html`<${WorldView} />` : html`<${GraphView} />`}
        ${dockOpen && html`<${Splitter} name="dock" axis="y" sign=${-1} least=${80} most=${700} label="Height of the lower panel" />`}
        <${Dock} />
      </main>
      <${Splitter} name="side" axis="x" sign=${-1} least=${280} most=${900} label="Width of the side panel" />
      <aside class="side" aria-label="World and details">
        ${showsWorld && !worldLarge && html`<div class="world-small"><${WorldView} /></div>
          <${Splitter} name="world" axis="y" sign=${1} least=${120} most=${800} label="Height of the world" />`}
        ${showsWorld && worldLarge && html`<div class="graph-small"><${GraphView} /></div>`}
        <${Details} />
      </aside>
      <${Toasts} />
      <${OpenDialog} />
    </div>`;
}

StartKeeping();
AttachKeys();
const { protocol, host, pathname, search } = location;
Start(`${protocol === 'https:' ? 'wss' : 'ws'}://${host}${pathname}${search}`);
render(html`<${Page} />`, document.getElementById('page'));
