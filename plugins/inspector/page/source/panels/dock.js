// The panel at the bottom: plots, ports, log, threads, profile.

import { html } from 'htm/preact';
import { Plots } from '../plots/plots.js';
import { plots } from '../plots/plot_list.js';
import { SetPanels, panels } from '../state/choices.js';
import { log } from '../state/store.js';
import { Icon } from './icon.js';
import { LogView } from './log_view.js';
import { PortTable } from './port_table.js';
import { ProfileTable } from './profile_table.js';
import { ThreadTable } from './thread_table.js';

const kTabs = [['plots', 'Plots', Plots], ['ports', 'Ports', PortTable], ['log', 'Log', LogView], ['threads', 'Threads', ThreadTable],
  ['profile', 'Profile', ProfileTable]];

export function Dock() {
  const current = kTabs.find(([id]) => id === panels.value.tab) ?? kTabs[0];
  const [id, , View] = current;
  const { dockOpen } = panels.value;
  const counts = { plots: plots.value.length, log: log.value.length };
  const onKey = (event) => {
    const step = { ArrowLeft: -1, ArrowRight: 1 }[event.key];
    if (!step) return;
    const next = kTabs[(kTabs.indexOf(current) + step + kTabs.length) % kTabs.length][0];
    SetPanels({ tab: next, dockOpen: true });
    requestAnimationFrame(() => document.getElementById(`tab-${next}`)?.focus());
  };
  return html`
    <section class=${`dock ${dockOpen ? '' : 'folded'}`} aria-label="Plots, ports, log, threads and profile">
      <div class="tabs" role="tablist" onKeyDown=${onKey}>
        ${kTabs.map(([tab, title]) => html`<button key=${tab} role="tab" id=${`tab-${tab}`}
            aria-selected=${tab === id}
          aria-controls="tab-panel" tabindex=${tab === id ? 0 : -1} aria-expanded=${dockOpen && tab === id}
          onClick=${() => SetPanels({ tab, dockOpen: !(dockOpen && tab === id) })}>${title}
          ${counts[tab] > 0 && html`<small>${counts[tab]}</small>`}</button>`)}
        <button class="fold-dock" aria-label=${dockOpen ? 'Fold the panel' : 'Open the panel'} title=${dockOpen ? 'Fold' : 'Open'}
          onClick=${() => SetPanels({ dockOpen: !dockOpen })}><${Icon} name=${dockOpen ? 'more' : 'less'} size=${15} /></button>
      </div>
      ${dockOpen && html`<div role="tabpanel" id="tab-panel" aria-labelledby=${`tab-${id}`} class=${`tab-panel ${id}`}><${View}
          key=${id} /></div>`}
    </section>`;
}
