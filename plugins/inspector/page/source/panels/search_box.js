// Finds modules, groups, ports, parameters and threads by parts of their names, types and paths.

import { useComputed, useSignal } from '@preact/signals';
import { useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { FindElements } from '../model/element_search.js';
import { Reveal } from '../state/choices.js';
import { revision, structure } from '../state/store.js';
import { Select } from '../graph/graph_keys.js';

const kShown = 12;

export function SearchBox() {
  const text = useSignal('');
  const at = useSignal(0);
  const field = useRef(null);
  const found = useComputed(() => {
    revision.value;
    return text.value.trim() === '' ? [] : FindElements(structure, text.value, kShown);
  });
  const closing = useRef(0);
  const stay = () => clearTimeout(closing.current);
  const close = () => { stay(); text.value = ''; at.value = 0; };
  const go = (element) => {
    if (!element) return;
    close();
    Reveal(element.owner ?? element.path);
    document.getElementById('graph')?.focus();
    Select(element.path);
  };
  const onKey = (event) => {
    const count = found.value.length;
    if (event.key === 'ArrowDown' && count > 0) at.value = (at.value + 1) % count;
    else if (event.key === 'ArrowUp' && count > 0) at.value = (at.value + count - 1) % count;
    else if (event.key === 'Enter') go(found.value[at.value]);
    else if (event.key === 'Escape') { close(); field.current.blur(); } else return;
    event.preventDefault();
  };
  return html`
    <div class="search">
      <input id="search" ref=${field} type="search" role="combobox" placeholder="Find …  /" autocomplete="off"
          spellcheck="false"
        aria-label="Find modules, ports, parameters" aria-expanded=${found.value.length > 0}
        aria-controls="search-found"
        aria-activedescendant=${found.value.length > 0 ? `found-${at.value}` : undefined} value=${text.value}
        onInput=${(event) => { text.value = event.target.value; at.value = 0; }} onKeyDown=${onKey}
        onFocus=${stay} onBlur=${() => { closing.current = setTimeout(close, 150); }} />
      ${text.value.trim() !== '' && html`
        <ul id="search-found" role="listbox" aria-label="Found">
          ${found.value.map((element, index) => html`
            <li key=${element.path} id=${`found-${index}`} role="option" aria-selected=${index === at.value}
                onPointerDown=${(event) => { event.preventDefault(); go(element); }}>
              <span>${element.name}</span> <small>${element.kind} ${element.type ?? element.data_type ?? ''}</small>
              <small class="path">${element.path}</small></li>`)}
          ${found.value.length === 0 && html`<li class="none" role="option"
              aria-selected="false">nothing is called like that</li>`}
        </ul>`}
    </div>`;
}
