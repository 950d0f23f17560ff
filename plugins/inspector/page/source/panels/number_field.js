// A number that only Enter sets: leaving the field, or Escape, drops what was typed.

import { useEffect, useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { CheckNumber } from '../model/parameter_check.js';

/** `bounds`: {minimum, maximum, isWhole}; `set(number)` promises the reply. */
export function NumberField({ id, label, bounds, value, disabled, set }) {
  const [draft, setDraft] = useState(null);
  const [problem, setProblem] = useState('');
  const input = useRef(null);
  const drop = () => { setDraft(null); setProblem(''); };
  useEffect(drop, [value]);
  const onKey = async (event) => {
    if (event.key === 'Escape') input.current.blur();
    else if (event.key !== 'Enter') return;
    event.stopPropagation();
    if (event.key !== 'Enter' || draft === null) return;
    const wrong = CheckNumber(draft, bounds);
    setProblem(wrong);
    if (!wrong) {
      await set(Number(draft));
      drop();
    }
  };
  return html`<input ref=${input} id=${id} type="text" inputmode="decimal" autocomplete="off" aria-label=${`${label}; Enter sets it`} disabled=${disabled}
      aria-invalid=${problem !== ''} value=${draft ?? value}
      onInput=${(event) => setDraft(event.target.value)} onKeyDown=${onKey} onBlur=${drop} />
    ${problem && html`<p class="problem" role="alert">${problem}</p>`}`;
}
