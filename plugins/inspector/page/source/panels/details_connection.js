// A connection: its ends, and what it does with values that nobody takes.

import { html } from 'htm/preact';
import { Conversions, SetPull, SetQueue } from '../state/actions.js';
import { OpenLater, openDialog } from '../state/choices.js';
import { DisconnectCarefully } from '../state/careful.js';
import { canChange, refusals, structure } from '../state/store.js';
import { ConnectionKey } from '../model/structure.js';
import { NoteLine } from './note_line.js';
import { NumberField } from './number_field.js';
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
    <${Title} kind="connection" name=${`${name(from)} → ${name(to)}`}><${NoteLine} path=${ConnectionKey(connection)} /><//>
    <div class="actions"><${ActionButton} id="disconnect" icon="trash" text="Disconnect" disabled=${!canChange.value}
      onClick=${() => DisconnectCarefully(from, to)} />
      ${canPull && html`<${ActionButton} id="pull" icon="plug" text=${pull ? 'Push' : 'Pull'} disabled=${!canChange.value}
        title=${pull ? 'Let the output publish when it has a value' : 'Have a value made when the input is read'}
        onClick=${() => SetPull(connection, !pull)} />`}
      ${connection.conversion && html`<${ActionButton} id="convert" icon="swap" text="Convert" disabled=${!canChange.value}
        title="Choose another part of the values, or another conversion" onClick=${() => ChooseConversion(connection)} />`}</div>
    <${Queue} key=${`${connection.queue} ${connection.on_full}`} connection=${connection} />
    <${Facts} facts=${[
      ['from', html`<${Link} path=${from} text=${name(from)} />`], ['to', html`<${Link} path=${to}
          text=${name(to)} />`],
      ['type', type],
      ['pulled', pull ? 'made when the input is read' : ''],
      ['converted', connection.conversion],
      ['made', connection.when_present ? 'when both ends are there' : ''],
      ['in a loop', connection.late ? 'values come one cycle late by it' : ''],
      ['lost', drops ? String(drops) : ''],
    ]} />
    <${Section} title="Value">${item ? html`<${ValueTable} port=${from} type=${type} value=${item.value} />`
      : html`<p class="none">nothing has come yet</p>`}<//>`;
}

async function ChooseConversion(connection) {
  const { from, to } = connection;
  const asked = openDialog.value;
  const reply = await Conversions(from, to);
  if (reply.ok) OpenLater({ kind: 'convert', from, to, conversions: reply.conversions, connection }, asked);
}

const kOnFull = { drop_oldest: 'the oldest is dropped', drop_newest: 'the newest is dropped', refuse: 'the publisher is refused' };

/** How many values wait for the reader: Enter sets it, as of parameters. */
function Queue({ connection }) {
  const { queue, on_full: onFull, pull } = connection;
  refusals.value;
  const locked = !canChange.value || pull;
  return html`<div class="parameter">
    <label for="queue">queue</label>
    <div class="field"><${NumberField} id="queue" label="queue" bounds=${{ isWhole: true, minimum: 0 }} value=${String(queue)} disabled=${locked}
        set=${(length) => SetQueue(connection, length, onFull)} />
      <span class="unit">values</span></div>
    <p class="note">${queue > 0 ? 'each value is read, in order' : '0: the reader finds the newest value only'}</p>
    ${queue > 0 && html`<label for="on-full">if it is full</label>
      <div class="field"><select id="on-full" disabled=${locked} value=${onFull}
          onChange=${(event) => SetQueue(connection, queue, event.target.value)}>
        ${Object.entries(kOnFull).map(([name, text]) => html`<option key=${name} value=${name} selected=${name === onFull}>${text}</option>`)}
      </select></div>`}
  </div>`;
}
