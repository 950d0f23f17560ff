// Connecting ports of different types: by which part of the values, by which conversion; `connection`: one that is there.

import { html } from 'htm/preact';
import { Connect, SetConversion } from '../state/actions.js';
import { structure } from '../state/store.js';
import { ChoiceList } from './choice_list.js';
import { CloseDialog, Dialog } from './dialog.js';

export function ConvertDialog({ from, to, conversions, connection }) {
  const [source, target] = [structure.get(from), structure.get(to)];
  const entries = conversions.map(({ part, convert }) => ({
    key: `${part} ${convert}`, part, convert, title: part === '' ? 'the whole value' : part, note: convert,
  }));
  const find = (text) => entries.filter(({ key }) => key.toLowerCase().includes(text.trim().toLowerCase()));
  return html`
    <${Dialog} title=${`How ${source?.name} becomes ${target?.name}`}>
      <h2>What of ${source?.name} shall ${target?.name} get? <small>${source?.data_type} → ${target?.data_type}</small></h2>
      <${ChoiceList} label="Parts and conversions" placeholder="Part or conversion" find=${find}
        onChoose=${(entry) => { CloseDialog(); connection ? SetConversion(connection, entry) : Connect(from, to, entry); }} />
    <//>`;
}
