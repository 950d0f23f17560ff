// A new port of a group: what it takes from outside or gives, so that others can connect with it.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { NameProblem } from '../model/changes.js';
import { CreatePort } from '../state/actions.js';
import { catalogue, structure } from '../state/store.js';
import { CloseDialog, Dialog } from './dialog.js';
import { useSubmission } from './submission.js';

export function PortDialog({ path }) {
  const [name, setName] = useState('');
  const [direction, setDirection] = useState('input');
  const [type, setType] = useState('');
  const types = TypesOfPorts();
  const { button, onEnter, problem, clear } = useSubmission({
    failed: 'Could not add the port', may: () => name !== '' && types.length > 0,
    send: () => NameProblem(structure, path, name) || CreatePort(path, name, direction, type || types[0]),
  });
  return html`
    <${Dialog} title="Add a port">
      <h2>Add a port <small>to ${path}</small></h2>
      <div class="form">
        <label for="port-name">Name</label>
        <input id="port-name" value=${name} spellcheck="false" autocomplete="off" autofocus
          onInput=${(event) => { setName(event.target.value); clear(); }}
          onKeyDown=${onEnter()} />
        <label for="port-direction">Direction</label>
        <select id="port-direction" value=${direction} onChange=${(event) => setDirection(event.target.value)}>
          <option value="input">input</option><option value="output">output</option></select>
        <label for="port-type">Type</label>
        <select id="port-type" value=${type || types[0]} onChange=${(event) => setType(event.target.value)}>
          ${types.map((each) => html`<option key=${each} value=${each}>${each}</option>`)}</select>
      </div>
      ${problem}
      <div class="dialog-foot"><button onClick=${() => CloseDialog()}>Cancel</button>
        <button class="primary" id="create-port" ...${button()}>Add</button></div>
    <//>`;
}

/** The types that ports of the application and of its module types have. */
function TypesOfPorts() {
  const types = new Set();
  for (const port of structure.ofKind('port')) types.add(port.data_type);
  for (const module of catalogue.value.modules) for (const port of module.ports ?? []) types.add(port.type);
  return [...types].filter(Boolean).sort();
}
