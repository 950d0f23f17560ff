// A service: a field for each argument, a button that calls it, and what it has replied.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { CallArguments, FormFields } from '../model/call_arguments.js';
import { AbortService, CallService, ErrorText } from '../state/actions.js';
import { canDrive } from '../state/store.js';
import { Section } from './parts.js';
import { useWatched } from './use_watched.js';

export function ServiceForm({ port }) {
  const { path, service } = port;
  const [values, setValues] = useState({});
  const [isUnderWay, setUnderWay] = useState(false);
  const [answer, setAnswer] = useState(null);
  const state = useWatched(path, { rate: 8 })?.service;
  const call = async () => {
    setUnderWay(true);
    setAnswer(null);
    const reply = await CallService(path, CallArguments(service, values));
    setUnderWay(false);
    setAnswer(reply.ok ? { text: reply.text } : { problem: (reply.errors ?? []).map(ErrorText).join('\n') || 'it was refused' });
  };
  const onKey = (event) => {
    if (event.key === 'Enter' && !isUnderWay) call();
    else if (event.key === 'Escape') event.target.blur();
    else return;
    event.stopPropagation();
  };
  return html`
    <${Section} title="Call" id="call">
      <div class="service-form" data-service=${path}>
        ${FormFields(service).map((field) => html`
          <div class="parameter" key=${field.name}>
            <label for=${`call:${path}:${field.name}`} title=${field.description}>${field.name || 'argument'}</label>
            <div class="field">
              <input id=${`call:${path}:${field.name}`} type="text" spellcheck="false" autocomplete="off" disabled=${!canDrive.value}
                placeholder=${field.data_type} value=${values[field.name] ?? field.value}
                onInput=${(event) => setValues({ ...values, [field.name]: event.target.value })} onKeyDown=${onKey} />
              ${field.unit && html`<span class="unit">${field.unit}</span>`}
            </div>
          </div>`)}
        <div class="actions">
          <button class="call" disabled=${!canDrive.value || isUnderWay} onClick=${call}>${isUnderWay ? 'Under way …' : 'Call'}</button>
          ${service.activity && (isUnderWay || state?.running.length > 0) && html`<button class="abort" disabled=${!canDrive.value}
              title="Asks what is under way to end" onClick=${() => AbortService(path)}>Abort</button>`}
        </div>
        ${state && html`<${Progress} state=${state} />`}
        ${answer?.text !== undefined && html`<p class="reply" role="status">${answer.text}</p>`}
        ${answer?.problem && html`<p class="problem" role="alert">${answer.problem}</p>`}
      </div>
    <//>`;
}

/** What is under way, whoever has called, and how many wait or have been served. */
function Progress({ state }) {
  const { running, waiting, answered, failed } = state;
  return html`
    ${running.map((each) => html`<div class="activity" key=${each.number}>
      <progress max="1" value=${each.progress} aria-label="Progress"></progress>
      <span>${running.length > 1 ? `#${each.number} ` : ''}${Math.round(100 * each.progress)} % ${each.doing}${each.abort ? ', asked to end' : ''}</span></div>`)}
    <p class="note calls">${waiting > 0 ? `${waiting} waiting, ` : ''}${answered} answered${failed > 0 ? `, ${failed} failed` : ''}</p>`;
}
