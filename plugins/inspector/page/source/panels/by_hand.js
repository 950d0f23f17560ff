// The value at a port, set by hand: a field that is sent with Enter, and the word that gives the port back.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { CheckNumber } from '../model/parameter_check.js';
import { ErrorText, PublishByHand, Release } from '../state/actions.js';
import { canDrive } from '../state/store.js';

const kRate = { minimum: 0.001, maximum: 1000, unit: 'Hz' };

export function ByHand({ port }) {
  const [text, setText] = useState('');
  const [rate, setRate] = useState('');
  const [problem, setProblem] = useState('');
  const id = `by-hand:${port.path}`;
  const send = async () => {
    if (text === '') return undefined;
    const wrong = rate.trim() === '' ? '' : CheckNumber(rate, kRate);
    if (wrong) return setProblem(`how often a second: ${wrong}`);
    const reply = await PublishByHand(port.path, text, rate.trim() === '' ? null : Number(rate));
    return setProblem(reply.ok ? '' : (reply.errors ?? []).map(ErrorText).join('\n') || 'it was refused');
  };
  const onKey = (event) => {
    if (event.key === 'Enter') send();
    else if (event.key === 'Escape') event.target.blur();
    else return;
    event.stopPropagation();
  };
  return html`
    <div class=${`parameter by-hand ${problem ? 'wrong' : ''}`} data-by-hand=${port.path}>
      <label for=${id} title="What readers find instead of what is published">by hand</label>
      <div class="field">
        <input id=${id} type="text" spellcheck="false" autocomplete="off" disabled=${!canDrive.value}
          placeholder=${port.data_type} value=${text} aria-invalid=${problem !== ''}
          onInput=${(event) => setText(event.target.value)} onKeyDown=${onKey} />
        ${port.unit && html`<span class="unit">${port.unit}</span>`}
        <input class="rate" type="text" inputmode="decimal" size="4" disabled=${!canDrive.value} placeholder="once"
          aria-label="How often a second it is published again; empty: once" title="Hz; empty: once" value=${rate}
          onInput=${(event) => setRate(event.target.value)} onKeyDown=${onKey} />
        <button disabled=${!canDrive.value || text === ''} onClick=${send}>Publish</button>
        ${(port.by_hand || port.blocked) && html`<button class="release" disabled=${!canDrive.value} title="Readers find again what is published"
            onClick=${() => Release(port.path)}>Release</button>`}
      </div>
      ${problem && html`<p class="problem" role="alert">${problem}</p>`}
    </div>`;
}
