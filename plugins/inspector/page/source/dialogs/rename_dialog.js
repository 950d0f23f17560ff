// Another name for a module or a group: connections, values and state stay.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { NameProblem } from '../model/changes.js';
import { NameOf, ParentOf } from '../model/structure.js';
import { Rename } from '../state/actions.js';
import { structure } from '../state/store.js';
import { CloseDialog, Dialog } from './dialog.js';
import { useSubmission } from './submission.js';

export function RenameDialog({ path }) {
  const before = NameOf(path);
  const [name, setName] = useState(before);
  const { button, onEnter, problem, clear } = useSubmission({
    failed: `Could not rename ${before}`, may: () => name !== '',
    send: () => (name === before ? { ok: true } : NameProblem(structure, ParentOf(path), name) || Rename(path, name)),
  });
  return html`
    <${Dialog} title=${`Rename ${before}`}>
      <h2>Rename ${before}</h2>
      <input id="new-name" class="wide-input" aria-label="Name" value=${name} spellcheck="false" autocomplete="off" autofocus
        onFocus=${(event) => event.target.select()} onInput=${(event) => { setName(event.target.value); clear(); }}
        onKeyDown=${onEnter()} />
      ${problem}
      <div class="dialog-foot"><button onClick=${() => CloseDialog()}>Cancel</button>
        <button class="primary" id="rename-now" ...${button()}>Rename</button></div>
    <//>`;
}
