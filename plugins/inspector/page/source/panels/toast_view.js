import { html } from 'htm/preact';
import { CloseToast, toasts } from '../state/toasts.js';

export function Toasts() {
  return html`<div class="toasts" aria-live="assertive" id="toasts">
    ${toasts.value.map((toast) => html`
      <div key=${toast.number} class=${`toast ${toast.kind}`} role=${toast.kind === 'error' ? 'alert' : 'status'}>
        <p>${toast.text}</p>
        ${toast.details.length > 0 && html`<ul>${toast.details.map((detail) => html`<li
            key=${detail}>${detail}</li>`)}</ul>`}
        <button class="remove" aria-label="Close" onClick=${() => CloseToast(toast.number)}>✕</button>
      </div>`)}
  </div>`;
}
