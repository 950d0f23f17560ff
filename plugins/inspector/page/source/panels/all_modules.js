// The values, or the parameters, of all modules in one list, with a filter.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { ParentOf } from '../model/structure.js';
import { AlarmCount } from '../state/alarms.js';
import { SetPanels, selected } from '../state/choices.js';
import { revision, structure } from '../state/store.js';
import { AlarmList } from './alarms.js';
import { ParameterRow } from './parameter_row.js';
import { PortRow } from './port_row.js';

const kShown = 60; // rows: each of a port watches it

export function ValueList() {
  return html`<${AllModules} label="values" rowsOf=${(path) => structure.portsOf(path).filter((port) => port.direction === 'output')}
    Row=${({ each }) => html`<${PortRow} port=${each} />`} before=${html`<${AlarmList} />`} />`;
}

export function ParameterList() {
  return html`<${AllModules} label="parameters" rowsOf=${(path) => structure.parametersOf(path)}
    Row=${({ each }) => html`<${ParameterRow} parameter=${each} />`} />`;
}

function AllModules({ label, rowsOf, Row, before }) {
  revision.value;
  const [text, setText] = useState('');
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  let room = kShown;
  const modules = [];
  for (const module of structure.ofKind('module')) {
    const rows = rowsOf(module.path).filter((row) => words.every((word) => row.path.toLowerCase().includes(word)));
    if (rows.length === 0) continue;
    modules.push({ module, rows: rows.slice(0, Math.max(0, room)) });
    room -= rows.length;
  }
  const go = (path) => { selected.value = path; SetPanels({ phone: 'details' }); };
  return html`<div class="all-modules">
    <input type="search" class="wide-input" placeholder=${`Filter ${label} …`} aria-label=${`Filter ${label}`} value=${text}
      onInput=${(event) => setText(event.target.value)} />
    ${before}
    ${modules.filter(({ rows }) => rows.length > 0).map(({ module, rows }) => html`<section key=${module.path} class="part">
      <h3><button class="link" onClick=${() => go(module.path)}>${module.name}</button> <small>${ParentOf(module.path)}</small>
        ${AlarmCount(module.path) > 0 && html`<span class="badge bad">alarm</span>`}</h3>
      <ul class="ports">${rows.map((each) => html`<${Row} key=${each.path} each=${each} />`)}</ul></section>`)}
    ${room < 0 && html`<p class="none">… and ${-room} more: filter to see them</p>`}
    ${modules.length === 0 && html`<p class="none">nothing is called like that</p>`}
  </div>`;
}
