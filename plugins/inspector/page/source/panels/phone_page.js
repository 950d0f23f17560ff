// The page on a phone: the map, the graph, values, parameters, one at a time.

import { html } from 'htm/preact';
import { GraphView } from '../graph/graph_view.js';
import { NameOf } from '../model/structure.js';
import { SetPanels, chosen, panels, selected } from '../state/choices.js';
import { structure } from '../state/store.js';
import { WorldView, hasWorld } from '../world/world_view.js';
import { ParameterList, ValueList } from './all_modules.js';
import { Details } from './details.js';
import { Icon } from './icon.js';
import { LogView } from './log_view.js';
import { PauseButton } from './pause_button.js';

const kViews = {
  map: ['Map', 'world', WorldView], graph: ['Graph', 'mark', GraphOnPhone], values: ['Values', 'plot', ValueList],
  parameters: ['Parameters', 'tune', ParameterList], log: ['Log', 'list', LogView], details: ['Details', 'list', Details],
};
const kTabs = ['map', 'graph', 'values', 'parameters', 'log'];

export function PhonePage() {
  const wanted = panels.value.phone ?? 'graph';
  const view = wanted === 'map' && !hasWorld.value ? 'graph' : wanted;
  const [title, , View] = kViews[view] ?? kViews.graph;
  return html`
    <main class=${`phone-view ${view}`} aria-label=${title}><${View} /></main>
    <nav class="phone-tabs" aria-label="Views">
      ${kTabs.map((name) => html`<button key=${name} id=${`phone-${name}`} aria-current=${name === view} disabled=${name === 'map' && !hasWorld.value}
        onClick=${() => SetPanels({ phone: name })}><${Icon} name=${kViews[name][1]} size=${20} />${kViews[name][0]}</button>`)}
      <${PauseButton} />
    </nav>`;
}

/** What is tapped has a line of its own below the graph, which leads to its details. */
function GraphOnPhone() {
  const path = selected.value;
  const element = structure.get(path);
  return html`<${GraphView} />
    ${path && html`<button class="phone-chosen" id="phone-details" onClick=${() => SetPanels({ phone: 'details' })}>
      <span><strong>${chosen.value.length > 1 ? `${chosen.value.length} boxes` : element?.name ?? NameOf(path)}</strong>
      <small> ${element?.type ?? element?.data_type ?? element?.kind ?? 'connection'}</small></span><span>Details ›</span></button>`}`;
}
