// Where the server wants a token: a field for it.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { connection, UseToken } from '../state/store.js';

export function TokenBanner() {
  const [token, setToken] = useState('');
  const { state, reason } = connection.value;
  if (state !== 'refused') return null;
  const send = (event) => {
    event.preventDefault();
    if (token !== '') UseToken(token);
    setToken('');
  };
  return html`<form class="lost token" id="token" onSubmit=${send}>
    <label for="token-field">${reason[0].toUpperCase() + reason.slice(1)}</label>
    <input id="token-field" type="password" autocomplete="off" spellcheck="false" placeholder="token" value=${token}
      onInput=${(event) => setToken(event.target.value.trim())} />
    <button class="primary" disabled=${token === ''}>Open</button>
  </form>`;
}
