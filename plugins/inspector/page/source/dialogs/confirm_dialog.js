// Asks before a change that leaves something without what it needs. The way out has the focus.

import { html } from 'htm/preact';
import { structure } from '../state/store.js';
import { NameOf } from '../model/structure.js';
import { CloseDialog, Dialog } from './dialog.js';

const kShown = 8;

export function ConfirmDialog({ title, verb, inputs, dependents, action }) {
  return html`
    <${Dialog} title=${title} className="confirm">
      <h2>${title}</h2>
      <p>${inputs.length === 1 ? 'This input' : `These ${inputs.length} inputs`} will be without a source:</p>
      <ul class="lost-inputs">${inputs.slice(0, kShown).map((port) => html`<li key=${port.path} title=${port.path}>
        <strong>${NameOf(port.owner)}/${port.name}</strong> <small>${port.data_type}</small>
        ${port.required && html`<span class="badge">required</span>`}</li>`)}
        ${inputs.length > kShown && html`<li class="none">and ${inputs.length - kShown} more</li>`}</ul>
      ${dependents.length > 0 && html`<p class="note">What needs the output of ${inputs.length === 1 ? 'its module' : 'their modules'}: ${
        dependents.slice(0, kShown).map((path) => structure.get(path)?.name ?? NameOf(path)).join(', ')}${
        dependents.length > kShown ? ` and ${dependents.length - kShown} more` : ''}.</p>`}
      <p class="note">Modules keep the last value that came; a robot may go on driving until a timeout of its own.</p>
      <div class="dialog-foot"><button id="confirm-no" autofocus onClick=${() => CloseDialog()}>Cancel</button>
        <button class="danger" id="confirm-yes" onClick=${() => { CloseDialog(); action(); }}>${verb}</button></div>
    <//>`;
}
