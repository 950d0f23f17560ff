// A connection: its ends, and what it does with values that nobody takes.

import { html } from 'htm/preact';
import { Disconnect } from '../state/actions.js';
import { canChange, structure } from '../state/store.js';
import { ActionButton, Facts, Link, Section, Title } from './parts.js';
import { useWatched } from './use_watched.js';
import { ValueTable } from './value_table.js';

export function ConnectionDetails({ connection }) {
  const { from, to } = connection;
  const type = structure.get(from)?.data_type;
  const item = useWatched(from, { rate: 8 });
  const drops = useWatched(to, { rate: 2 })?.drops;
  const name = (path) => `${structure.get(structure.get(path)?.owner)?.name ?? ''}/${structure.get(path)?.name ?? path}`;
  return html`
    <${Title} kind="connection" name=${`${name(from)} → ${name(to)}`} />
    <div class="actions"><${ActionButton} id="disconnect" icon="trash" text="Disconnect" disabled=${!canChange.value}
      onClick=${() => Disconnect(from, to)} /></div>
    <${Facts} facts=${[
      ['from', html`<${Link} path=${from} text=${name(from)} />`], ['to', html`<${Link} path=${to}
          text=${name(to)} />`],
      ['type', type], ['queue', connection.queue > 0 ? `${connection.queue} values` : 'the newest value only'],
      ['if it is full', connection.queue > 0 ? (connection.on_full ?? '').replace('_', ' ') : ''],
      ['lost', drops ? String(drops) : ''],
    ]} />
    <${Section} title="Value">${item ? html`<${ValueTable} port=${from} type=${type} value=${item.value} />`
      : html`<p class="none">nothing has come yet</p>`}<//>`;
}
