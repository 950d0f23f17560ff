// A connection: its ends, and what it does with values that nobody takes.

import { html } from 'htm/preact';
import { Disconnect, SetPull } from '../state/actions.js';
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
  const { pull } = connection;
  const canPull = pull || (structure.get(from)?.pullable && !(connection.queue > 0));
  return html`
    <${Title} kind="connection" name=${`${name(from)} → ${name(to)}`} />
    <div class="actions"><${ActionButton} id="disconnect" icon="trash" text="Disconnect" disabled=${!canChange.value}
      onClick=${() => Disconnect(from, to)} />
      ${canPull && html`<${ActionButton} id="pull" icon="plug" text=${pull ? 'Push' : 'Pull'} disabled=${!canChange.value}
        title=${pull ? 'Let the output publish when it has a value' : 'Have a value made when the input is read'}
        onClick=${() => SetPull(from, to, !pull)} />`}</div>
    <${Facts} facts=${[
      ['from', html`<${Link} path=${from} text=${name(from)} />`], ['to', html`<${Link} path=${to}
          text=${name(to)} />`],
      ['type', type], ['queue', connection.queue > 0 ? `${connection.queue} values` : 'the newest value only'],
      ['if it is full', connection.queue > 0 ? (connection.on_full ?? '').replace('_', ' ') : ''],
      ['pulled', pull ? 'made when the input is read' : ''],
      ['converted', connection.conversion],
      ['made', connection.when_present ? 'when both ends are there' : ''],
      ['in a loop', connection.late ? 'values come one cycle late by it' : ''],
      ['lost', drops ? String(drops) : ''],
    ]} />
    <${Section} title="Value">${item ? html`<${ValueTable} port=${from} type=${type} value=${item.value} />`
      : html`<p class="none">nothing has come yet</p>`}<//>`;
}
