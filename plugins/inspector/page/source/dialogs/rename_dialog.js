// Another name for a module or a group: connections, values and state stay.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { NameProblem } from '../model/changes.js';
import { NameOf, ParentOf } from '../model/structure.js';
import { ErrorText, Rename } from '../state/actions.js';
import { openDialog } from '../state/choices.js';
import { structure } from '../state/store.js';
import { CloseDialog, Dialog } from './dialog.js';

export function RenameDialog({ path }) {
  const before = NameOf(path);
  const [name, setName] = useState(before);
  const [problem, setProblem] = useState('');
  const rename = async () => {
    if (name === before) return CloseDialog();
    const wrong = NameProblem(structure, ParentOf(path), name);
    if (wrong) return setProblem(wrong);
    const dialog = openDialog.value;
    const reply = await Rename(path, name);
    return reply.ok ? CloseDialog(dialog) : setProblem((reply.errors ?? []).map(ErrorText).join('\n'));
  };
  return html`
    <${Dialog} title=${`Rename ${before}`}>
      <h2>Rename ${before}</h2>
      <input id="new-name" class="wide-input" aria-label="Name" value=${name} spellcheck="false" autocomplete="off" autofocus
        onFocus=${(event) => event.target.select()} onInput=${(event) => { setName(event.target.value); setProblem(''); }}
        onKeyDown=${(event) => { if (event.key === 'Enter') rename(); }} />
      ${problem && html`<p class="problem" role="alert">${problem}</p>`}
      <div class="dialog-foot"><button onClick=${() => CloseDialog()}>Cancel</button>
        <button class="primary" id="rename-now" disabled=${name === ''} onClick=${rename}>Rename</button></div>
    <//>`;
}
