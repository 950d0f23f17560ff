// A note on a module, a group or a connection: a short text that all viewers see.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { ConnectionKey, NameOf } from '../model/structure.js';
import { Arrange } from '../state/actions.js';
import { NoteEntries, notes } from '../state/arrangement.js';
import { structure } from '../state/store.js';
import { CloseDialog, Dialog } from './dialog.js';

const kMost = 300; // letters

export function NoteDialog({ path }) {
  const before = notes.value.get(path) ?? '';
  const [text, setText] = useState(before);
  const connection = structure.connections.get(path);
  const name = connection ? ConnectionKey({ from: NameOf(connection.from), to: NameOf(connection.to) }) : NameOf(path);
  const keep = (next) => { CloseDialog(); if (next.trim() !== before) Arrange(NoteEntries(path, next)); };
  return html`
    <${Dialog} title=${`Note on ${name}`}>
      <h2>Note on ${name}</h2>
      <textarea id="note-text" class="wide-input" rows="3" maxlength=${kMost} aria-label="Note" value=${text} autofocus
        onInput=${(event) => setText(event.target.value)}
        onKeyDown=${(event) => { if (event.key === 'Enter' && !event.shiftKey) { event.preventDefault(); keep(event.target.value); } }} />
      <p class="note">All viewers see it; it is kept beside the application's file.</p>
      <div class="dialog-foot">
        ${before && html`<button class="danger-quiet" id="note-remove" onClick=${() => keep('')}>Remove</button>`}
        <button onClick=${() => CloseDialog()}>Cancel</button>
        <button class="primary" id="note-keep" onClick=${() => keep(text)}>Keep</button></div>
    <//>`;
}
