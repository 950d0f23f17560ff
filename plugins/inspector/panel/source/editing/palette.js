// What can be put onto the panel.

import { html } from 'htm/preact';
import { AddWidget } from '../panel_state.js';
import { kKinds } from '../model/kinds.js';
import { KindIcon } from './kind_icon.js';

export function Palette() {
  return html`
    <nav class="palette" aria-label="Add a widget">
      ${Object.entries(kKinds).filter(([, { isOld }]) => !isOld).map(([kind, { label, icon }]) => html`<button key=${kind} data-add=${kind} title=${`Add: ${label}`}
        onClick=${() => AddWidget(kind)}><${KindIcon} name=${icon} /><span>${label}</span></button>`)}
    </nav>`;
}
