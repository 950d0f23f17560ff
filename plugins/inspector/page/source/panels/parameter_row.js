// A parameter: its value in a field that suits its type, its bounds, and what the application says
// of a value that it does not take.

import { useEffect, useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { CheckValue } from '../model/parameter_check.js';
import { FormatBounds } from '../model/value_format.js';
import { ErrorText, SetParameter } from '../state/actions.js';
import { canChange, catalogue, refusals } from '../state/store.js';

export function ParameterRow({ parameter }) {
  const [draft, setDraft] = useState(null);   // what is being typed, or null
  const [problem, setProblem] = useState('');
  const [dropped, setDropped] = useState(''); // what was typed and not set
  const sent = useRef(null); // until it has become the value: it is not sent again
  const id = `parameter:${parameter.path}`;
  refusals.value;
  const canBeSet = parameter.settable || parameter.remakes;
  const locked = !canBeSet || !canChange.value;
  useEffect(() => {
    setProblem('');
    setDropped('');
    sent.current = null;
  }, [parameter.value]);

  const send = async (text) => {
    if (text !== null && text === sent.current) return;
    if (text === null || text === parameter.value) return setDraft(null);
    const wrong = CheckValue(parameter, text, catalogue.value);
    setProblem(wrong);
    if (wrong) return;
    sent.current = text;
    const reply = await SetParameter(parameter.path, text, { quiet: true });
    if (reply.ok) return setDraft(null);
    sent.current = null;
    setProblem((reply.errors ?? []).map(ErrorText).join('\n') || 'it was refused');
  };
  // A value that nobody has confirmed must not reach a robot.
  const drop = () => {
    if (draft !== null && draft !== parameter.value && draft !== sent.current) setDropped(draft);
    setDraft(null);
    setProblem('');
  };
  const type = (text) => { setDraft(text); setDropped(''); };
  const bounds = FormatBounds(parameter);
  const isChanged = (parameter.default ?? null) !== null && parameter.value !== parameter.default;
  const isEdited = draft !== null && draft !== parameter.value;
  return html`
    <div class=${`parameter ${problem ? 'wrong' : ''} ${isEdited ? 'edited' : ''}`} data-parameter=${parameter.path}>
      <label for=${id} title=${parameter.name}>${parameter.name}</label>
      <div class="field">
        <${Field} id=${id} parameter=${parameter} text=${draft ?? parameter.value ?? ''} locked=${locked}
          wrong=${problem !== ''} onDraft=${type} onSend=${send} onDrop=${drop} />
        ${parameter.unit && html`<span class="unit">${parameter.unit}</span>`}
        ${isChanged && canBeSet && html`<button class="reset" disabled=${locked}
            title=${`Back to ${parameter.default}`}
          aria-label=${`Set ${parameter.name} back to ${parameter.default}`}
          onClick=${() => send(parameter.default)}>↺</button>`}
      </div>
      ${parameter.description && html`<p class="description">${parameter.description}</p>`}
      <p class="note" id=${`${id}:note`}>
        ${[bounds, parameter.remakes ? 'makes the module anew' : !parameter.settable && 'fixed while it runs']
          .filter(Boolean).join(' · ')}</p>
      ${dropped && html`<p class="note dropped" role="status">“${dropped}” was not set: Enter sets a value</p>`}
      ${problem && html`<p class="problem" role="alert" id=${`${id}:problem`}>${problem}</p>`}
    </div>`;
}

function Field({ id, parameter, text, locked, wrong, onDraft, onSend, onDrop }) {
  const input = useRef(null);
  const common = { id, disabled: locked, 'aria-invalid': wrong,
    'aria-describedby': `${id}:note${wrong ? ` ${id}:problem` : ''}` };
  const values = catalogue.value.type(parameter.data_type)?.values;
  if (parameter.data_type === 'bool') {
    return html`<input type="checkbox" class="switch" role="switch" ...${common} checked=${text === 'true'}
      onChange=${(event) => onSend(event.target.checked ? 'true' : 'false')} />`;
  }
  if (values?.length > 0) {
    return html`<select ...${common} value=${text} onChange=${(event) => onSend(event.target.value)}>
      ${values.map((value) => html`<option key=${value} value=${value}
          selected=${value === text}>${value}</option>`)}</select>`;
  }
  const onKey = (event) => {
    if (event.key === 'Enter') onSend(event.target.value);
    else if (event.key === 'Escape') input.current.blur(); else return;
    event.stopPropagation();
  };
  return html`<input type="text" ref=${input} spellcheck="false" autocomplete="off" ...${common} value=${text}
    onInput=${(event) => onDraft(event.target.value)} onKeyDown=${onKey}
    onBlur=${onDrop} />`;
}
