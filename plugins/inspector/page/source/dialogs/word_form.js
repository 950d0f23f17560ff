// A form for the words of a tag, each of which may be left out.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { CloseDialog, Dialog } from './dialog.js';
import { useSubmission } from './submission.js';

/**
 * `fields`: {name, text, hint} or {name, text, choices: [[word, what it means]]}; `given`: words to begin with. `apply(words)`
 * is given those that say something, and returns the server's reply.
 */
export function WordForm({ id, title, heading, note, button, fields, given = {}, apply }) {
  const [words, setWords] = useState(given);
  const set = (name, value) => { setWords({ ...words, [name]: value }); clear(); };
  const said = Object.entries(words).map(([name, value]) => [name, value.trim()]).filter(([, value]) => value !== '');
  const { button: submit, onEnter, problem, clear } = useSubmission({ failed: `${title}: refused`, send: () => apply(Object.fromEntries(said)) });
  const input = ({ name, hint, choices }, isFirst) => (choices
    ? html`<select id=${`${id}-${name}`} value=${words[name] ?? ''} onChange=${(event) => set(name, event.target.value)}>
        ${choices.map(([value, text]) => html`<option key=${value} value=${value}>${text}</option>`)}</select>`
    : html`<input id=${`${id}-${name}`} value=${words[name] ?? ''} placeholder=${hint} spellcheck="false" autocomplete="off" autofocus=${isFirst}
        onInput=${(event) => set(name, event.target.value)} onKeyDown=${onEnter()} />`);
  return html`
    <${Dialog} title=${title}>
      <h2>${heading} <small>${note}</small></h2>
      <div class="form">
        ${fields.map((field, index) => html`<label for=${`${id}-${field.name}`}>${field.text}</label>${input(field, index === 0)}`)}
      </div>
      ${problem}
      <div class="dialog-foot"><button onClick=${() => CloseDialog()}>Cancel</button>
        <button class="primary" id=${id} ...${submit()}>${button}</button></div>
    <//>`;
}
