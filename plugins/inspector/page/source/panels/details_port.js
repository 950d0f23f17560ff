// A port: what it carries, field by field, its connections, and how often values come.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { ConnectionKey, NameOf } from '../model/structure.js';
import { FormatNumber, FormatRate } from '../model/value_format.js';
import { DisconnectCarefully } from '../state/careful.js';
import { openDialog, selected } from '../state/choices.js';
import { FlowRate, canChange, catalogue, revision, structure } from '../state/store.js';
import { unreached } from '../stop/stop_state.js';
import { AlarmList } from './alarms.js';
import { BlackboardSection } from './blackboard_section.js';
import { ByHand } from './by_hand.js';
import { ImagePicture } from './image_picture.js';
import { ActionButton, Awaited, Facts, Link, Section, Title } from './parts.js';
import { ServiceForm } from './service_form.js';
import { useWatched } from './use_watched.js';
import { ValueTable } from './value_table.js';

const kFew = 12;
const kMany = 400;

function WhyUnreached(path) {
  const found = unreached.value?.find((each) => each.path === path);
  return found ? `no STOP counts there: ${found.why}` : '';
}

export function PortDetails({ element }) {
  revision.value;
  const { path } = element;
  const [elements, setElements] = useState(kFew);
  const item = useWatched(path, { rate: 8, elements });
  const connections = structure.connectionsOf(path);
  const rate = FlowRate(path);
  const type = catalogue.value.type(element.data_type);
  return html`
    <${Title} kind=${`${element.interface ? 'group ' : ''}${element.direction}`} name=${element.name} path=${path}>
      ${element.description && html`<p class="summary">${element.description}</p>`}<//>
    <${AlarmList} path=${path} />
    <div class="actions">
      <${ActionButton} id="connect" icon="plug" text="Connect …" disabled=${!canChange.value}
        onClick=${() => { openDialog.value = { kind: 'connect', path }; }} title="Connect with another port (C)" />
    </div>
    <${Facts} facts=${[
      ['type', element.data_type],
      ['of', structure.get(element.owner) && html`<${Link} path=${element.owner} />`],
      ['rate', !element.service && rate !== null && FormatRate(rate)],
      ['values', !element.service && item?.count !== undefined && item?.count !== null && String(item.count)],
      ['last at', !element.service && item?.stamp !== undefined && `${FormatNumber(item.stamp)} s`],
      ['measured', item?.measured !== undefined && `${FormatNumber(item.stamp - item.measured)} s before`],
      ['lost from its queue', item?.drops ? String(item.drops) : ''],
      ['required', element.required ? 'yes' : ''],
      ['unit', element.unit], ['in', element.bounds], ['default', element.default],
      ['topic', element.topic], ['state', element.far && element.state], ['why', element.misfit], ['heard', element.master],
      ...(element.offers ?? []).map(({ topic, readers, misfit, is_stopped }) => ['offered', `${topic}${readers.length > 0 ? `, read by ${readers.join(', ')}` : ''}${is_stopped ? ', STOPPED: its safe value is sent' : ''}${misfit ? `; ${misfit}` : ''}`]),
      ['drives', element.driving ? 'something moves by it: under the STOP of the robot' : ''],
      ['CANNOT BE REACHED', WhyUnreached(path)],
      ['blocked', element.blocked ? 'readers find its safe value, until it is released' : ''],
      ['set by hand', element.by_hand ? 'what is published is not read' : ''],
    ]} />
    <${BlackboardSection} key=${`board ${path}`} path=${path} />
    ${element.service && html`<${ServiceForm} key=${path} port=${element} />`}
    ${!element.service && html`<${Section} title="Value" id="value">
      ${type?.meaning === 'image' ? html`<${ImagePicture} path=${path} />`
        : item ? html`<${ValueTable} port=${path} type=${element.data_type} value=${item.value} />`
        : html`<p class="none">${type?.kind === 'opaque' ? 'values of this type cannot be shown' : 'nothing has come yet'}</p>`}
      ${item?.cut && type?.meaning !== 'image' && elements === kFew && html`<button class="link"
          onClick=${() => setElements(kMany)}>show up to ${kMany} elements of lists</button>`}
      ${item?.cut && elements === kMany && html`<p class="note">longer lists are cut</p>`}
    <//>`}
    ${type?.kind !== 'opaque' && html`<${ByHand} key=${path} port=${element} />`}
    <${Section} title="Connections" count=${connections.length}>
      ${connections.length === 0 && html`<p class="none">none</p>`}
      <ul class="connections">${connections.map((connection) => html`<${ConnectionRow}
          key=${connection.from + connection.to} port=${path} connection=${connection} />`)}</ul>
      <${Awaited} awaits=${element.awaits} />
    <//>`;
}

function ConnectionRow({ port, connection }) {
  const isSource = connection.from === port;
  const other = isSource ? connection.to : connection.from;
  const owner = structure.get(other)?.owner;
  return html`<li>
    <span class="arrow">${isSource ? 'to' : 'from'}</span>
    <${Link} path=${other} text=${`${owner ? NameOf(owner) : ''}/${NameOf(other)}`} />
    <button class="link" title="How it passes values on" onClick=${() => { selected.value = ConnectionKey(connection); }}>
      <small>${connection.queue > 0 ? `queue of ${connection.queue}` : connection.pull ? '' : 'newest value'}</small></button>
    ${connection.pull && html`<small>pulled</small>`}
    ${connection.conversion && html`<small>${connection.conversion}</small>`}
    ${connection.when_present && html`<small>when present</small>`}
    ${connection.late && html`<small>late</small>`}
    <button class="remove" disabled=${!canChange.value} title="Disconnect" aria-label=${`Disconnect ${other}`}
      onClick=${() => DisconnectCarefully(connection.from, connection.to)}>✕</button></li>`;
}
