// A search field over a list to choose from, by mouse or arrow keys.

import { useSignal } from '@preact/signals';
import { useEffect, useLayoutEffect, useRef } from 'preact/hooks';
import { html } from 'htm/preact';

const kShown = 120;

/**
 * `find(text)` gives entries {key, title, note, detail, disabled}; `onChoose(entry)`. `label` is for
 * screen readers. `onCurrent` is told which entry is marked; `onMore(entry)`: the other way to choose one for which
 * hasMore(entry), to give parameters first.
 */
export function ChoiceList({ label, placeholder, find, onChoose, onCurrent, onMore, hasMore, empty }) {
  const text = useSignal('');
  const at = useSignal(0);
  const list = useRef(null);
  const field = useRef(null);
  useEffect(() => field.current.focus(), []);
  const all = find(text.value);
  const entries = all.slice(0, kShown);
  const current = entries[Math.min(at.value, entries.length - 1)];
  // At once, not after the next picture: what follows from the choice, a name say, must not change under the user's hands.
  useLayoutEffect(() => {
    list.current?.querySelector('[aria-selected=true]')?.scrollIntoView({ block: 'nearest' });
    onCurrent?.(current ?? null);
  }, [current?.key]);
  const onKey = (event) => {
    const step = { ArrowDown: 1, ArrowUp: -1, PageDown: 8, PageUp: -8 }[event.key];
    if (step) at.value = Math.min(entries.length - 1, Math.max(0, at.value + step));
    else if (event.key === 'Enter') { if (!event.repeat && current && !current.disabled) onChoose(current); } else return;
    event.preventDefault();
  };
  return html`
    <input ref=${field} type="text" class="choice-search" role="combobox" aria-label=${label}
        placeholder=${placeholder} value=${text.value}
      autocomplete="off" spellcheck="false" aria-controls="choices" aria-expanded="true"
      aria-activedescendant=${current ? `choice-${entries.indexOf(current)}` : undefined}
      onInput=${(event) => { text.value = event.target.value; at.value = 0; }} onKeyDown=${onKey} />
    <ul ref=${list} id="choices" class="choices" role="listbox" aria-label=${label}>
      ${entries.map((entry, index) => html`
        <li key=${entry.key} id=${`choice-${index}`} role="option" aria-selected=${entry === current}
            data-choice=${entry.key}
            aria-disabled=${entry.disabled ?? false} onPointerMove=${() => { at.value = index; }}
            onClick=${() => { if (!entry.disabled) onChoose(entry); }}>
          <span class="choice-title">${entry.title}</span>${entry.note && html` <small>${entry.note}</small>`}
          ${entry === current && onMore && hasMore(entry) && html`<button class="more" onClick=${(event) => { event.stopPropagation(); onMore(entry); }}
            aria-label=${`Parameters of ${entry.title}`}>Parameters …</button>`}
          ${entry.detail && html`<p>${entry.detail}</p>`}</li>`)}
      ${entries.length === 0 && html`<li class="none" role="option"
          aria-selected="false">${empty ?? 'nothing suits'}</li>`}
      ${all.length > kShown && html`<li class="none" role="option"
          aria-selected="false">… and ${all.length - kShown} more</li>`}
    </ul>`;
}
