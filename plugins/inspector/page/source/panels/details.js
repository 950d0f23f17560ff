// The panel for what is selected.

import { html } from 'htm/preact';
import { chosen, selected } from '../state/choices.js';
import { revision, structure } from '../state/store.js';
import { ApplicationDetails } from './details_application.js';
import { ChosenDetails } from './details_chosen.js';
import { ConnectionDetails } from './details_connection.js';
import { FarDetails } from './details_far.js';
import { ModuleDetails } from './details_module.js';
import { PortDetails } from './details_port.js';
import { ParameterDetails } from './details_parameter.js';
import { ThreadDetails } from './details_thread.js';

export function Details() {
  revision.value;
  const path = selected.value;
  const element = structure.get(path);
  const connection = structure.connections.get(path);
  return html`<section class="details" aria-label="Details" id="details" tabindex="-1"
      data-element=${path}>
    ${chosen.value.length > 1 ? html`<${ChosenDetails} />`
      : connection ? html`<${ConnectionDetails} key=${path} connection=${connection} />`
      : element?.far && element.kind !== 'port' ? html`<${FarDetails} key=${path} element=${element} />`
      : element ? html`<${kViews[element.kind] ?? ApplicationDetails} key=${path} element=${element} />`
      : path ? html`<p class="empty">${path} is not there any more.</p>`
      : html`<${ApplicationDetails} element=${structure.get(structure.root)} />`}
  </section>`;
}

const kViews = {
  module: ModuleDetails,
  group: ModuleDetails,
  port: PortDetails,
  parameter: ParameterDetails,
  thread: ThreadDetails,
};
