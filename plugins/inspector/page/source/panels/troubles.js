// What has gone wrong with an element, as the log has it.

import { html } from 'htm/preact';
import { FormatTime } from '../model/value_format.js';
import { TroublesOf } from '../state/log.js';
import { log } from '../state/store.js';
import { Section } from './parts.js';

const kShown = 5;

export function Troubles({ path }) {
  const found = TroublesOf(log.value, path);
  if (found.length === 0) return null;
  return html`<${Section} title="Faults and warnings" count=${found.length} id="troubles">
    <ul class="troubles">${found.slice(-kShown).reverse().map((entry) => html`
      <li key=${entry.number} class=${entry.kind}><time>${FormatTime(entry.time)}</time> ${entry.text}</li>`)}</ul><//>`;
}
