// Before the application's file is written: what of it will be another.

import { useEffect, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { CountChanges, TextDifference } from '../model/text_difference.js';
import { ErrorText, PreviewSave, Save } from '../state/actions.js';
import { CloseDialog, Dialog } from './dialog.js';
import { useSubmission } from './submission.js';

export function SaveDifference() {
  const [told, setTold] = useState(null); // {file, before, after, lines}
  const [unknown, setUnknown] = useState(''); // why nobody can tell
  const Take = ({ file, before, after }) => setTold({ file, before, after, lines: TextDifference(before, after) });
  useEffect(() => {
    PreviewSave().then((reply) => {
      if (reply.ok) Take(reply);
      else setUnknown((reply.errors ?? []).map(ErrorText).join('\n') || 'it was refused');
    });
  }, []);
  const { button, problem } = useSubmission({
    failed: 'Could not save', may: () => told !== null,
    // Nothing is written that was not shown: others change the application, and the file.
    send: async () => {
      const now = await PreviewSave();
      if (!now.ok) return now;
      if (['file', 'before', 'after'].every((name) => now[name] === told[name])) return Save('', { quiet: true });
      Take(now);
      return 'It has been changed meanwhile: this is the difference now.';
    },
  });
  const { added, removed } = CountChanges(told?.lines ?? []);
  const isSame = told !== null && added + removed === 0;
  const name = told?.file.replace(/.*\//, '') ?? '';
  return html`
    <${Dialog} key=${told === null ? 'asks' : 'told'} title="Save" className="wide difference-dialog">
      <h2>${isSame ? 'Nothing to save' : html`Save ${name} ${told && html`<small class="counts"><span class="added">+${added}</span>
        <span class="removed">−${removed}</span> line${added + removed === 1 ? '' : 's'}</small>`}`}</h2>
      ${told && html`<p class="note path" title=${told.file}>${told.file}</p>`}
      ${told === null && !unknown && html`<p class="none">asking the application …</p>`}
      ${isSame && html`<p>The file says all that the application is.</p>`}
      ${told && !isSame && html`<${Difference} lines=${told.lines} />`}
      ${unknown && html`<p class="problem" role="alert">${unknown}</p>`}
      ${problem}
      <div class="dialog-foot"><button onClick=${() => CloseDialog()} autofocus=${isSame}>${isSame ? 'Close' : 'Cancel'}</button>
        ${!isSame && html`<button class="primary" id="save-now" autofocus ...${button()}>Save</button>`}</div>
    <//>`;
}

const kSigns = { same: ' ', gone: '−', new: '+', skipped: ' ' };

/** A unified difference, by lines. */
export function Difference({ lines }) {
  return html`<div class="difference" role="table" aria-label="What will change" tabindex="0">
    ${lines.map(({ kind, text, before, after, count }, index) => (kind === 'skipped'
      ? html`<p key=${index} class="skipped">${count} line${count === 1 ? '' : 's'} as before</p>`
      : html`<p key=${index} class=${kind} role="row"><span class="number" aria-hidden="true">${before ?? ''}</span><span
          class="number" aria-hidden="true">${after ?? ''}</span><span class="sign" aria-label=${kind}>${kSigns[kind]}</span><code>${text}</code></p>`))}
  </div>`;
}
