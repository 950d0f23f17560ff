// What a dialog asks of the application, by its button or by Enter alike: one request at a time. A refusal is shown in the
// dialog, or, when that has been closed meanwhile, as a toast.

import { signal } from '@preact/signals';
import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { ErrorText } from '../state/actions.js';
import { openDialog } from '../state/choices.js';
import { Toast } from '../state/toasts.js';
import { CloseDialog } from './dialog.js';

/** The dialog whose request waits for its answer. */
export const submitting = signal(null);

/**
 * `send(how)` gives the server's reply, what is wrong as a text, or null if another dialog asks first; `may(how)`: whether it may
 * be sent; `done(reply)` is called when the dialog was still open; `failed`: what a late refusal is called.
 * {submit(how), button(how), onEnter(how), problem, clear, isBusy}: button and onEnter are properties of elements.
 */
export function useSubmission({ send, failed, may = () => true, done = () => {} }) {
  const [problem, setProblem] = useState('');
  const submit = async (how) => {
    const dialog = openDialog.value;
    if (!dialog || submitting.value === dialog || !may(how)) return;
    submitting.value = dialog;
    let reply = null;
    try { reply = await send(how); } finally { if (submitting.value === dialog) submitting.value = null; }
    if (reply === null) return;
    if (reply.ok) {
      if (CloseDialog(dialog)) done(reply);
      return;
    }
    const errors = typeof reply === 'string' ? [reply] : (reply.errors ?? []).map(ErrorText);
    if (openDialog.value === dialog) setProblem(errors.join('\n') || 'it was refused');
    else Toast('error', failed, errors);
  };
  const isBusy = submitting.value !== null && submitting.value === openDialog.value;
  return {
    submit, isBusy, clear: () => setProblem(''),
    button: (how) => ({ disabled: !may(how), 'aria-busy': isBusy, onClick: () => submit(how) }),
    onEnter: (how) => (event) => { if (event.key === 'Enter' && !event.repeat) submit(how); },
    problem: problem && html`<p class="problem" role="alert">${problem}</p>`,
  };
}
