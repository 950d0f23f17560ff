// A note on a module, a group or a connection: a short text that all viewers see.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { ConnectionKey, NameOf } from '../model/structure.js';
import { WriteNote } from '../state/actions.js';
import { notes } from '../state/arrangement.js';
import { structure } from '../state/store.js';
import { CloseDialog, Dialog } from './dialog.js';
import { useSubmission } from './submission.js';

const kMost = 300; // letters

export function NoteDialog({ path }) {
  const [before] = useState(() => notes.value.get(path) ?? ''); // what has not been edited here takes no other viewer's note away
  const [text, setText] = useState(before);
  const connection = structure.connections.get(path);
  const name = connection ? ConnectionKey({ from: NameOf(connection.from), to: NameOf(connection.to) }) : NameOf(path);
  const { submit, button, problem, clear } = useSubmission({
    failed: `Could not keep the note on ${name}`,
    send: (next) => (next.trim() === before ? { ok: true } : WriteNote(path, next)),
  });
  return html`
    <${Dialog} title=${`Note on ${name}`}>
      <h2>Note on ${name}</h2>
      <textarea id="note-text" class="wide-input" rows="3" maxlength=${kMost} aria-label="Note" value=${text} autofocus
        onInput=${(event) => { setText(event.target.value); clear(); }}
        onKeyDown=${(event) => { if (event.key === 'Enter' && !event.shiftKey) { event.preventDefault(); if (!event.repeat) submit(event.target.value); } }} />
      <p class="note">All viewers see it; it is kept beside the application's file.</p>
      ${problem}
      <div class="dialog-foot">
        ${before && html`<button class="danger-quiet" id="note-remove" ...${button('')}>Remove</button>`}
        <button onClick=${() => CloseDialog()}>Cancel</button>
        <button class="primary" id="note-keep" ...${button(text)}>Keep</button></div>
    <//>`;
}
