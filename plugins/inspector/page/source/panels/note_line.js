// The note on what is selected, and the way to write one.

import { html } from 'htm/preact';
import { notes } from '../state/arrangement.js';
import { openDialog } from '../state/choices.js';

export function NoteLine({ path }) {
  const text = notes.value.get(path);
  const write = () => { openDialog.value = { kind: 'note', path }; };
  return text ? html`<button class="note-card" id="note" onClick=${write} title="Change the note (N)">${text}</button>`
    : html`<button class="link note-add" id="note" onClick=${write} title="Write a note (N)">Add a note</button>`;
}
