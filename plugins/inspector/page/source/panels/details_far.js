// Another application in the network: what it offers, what is taken of it, and what it is made of.

import { html } from 'htm/preact';
import { DelayText } from '../model/network.js';
import { structure } from '../state/store.js';
import { Facts, Link, Section, Title } from './parts.js';

export function FarDetails({ element }) {
  const ports = structure.portsOf(element.path);
  return html`
    <${Title} kind="application" name=${element.name} path="in the network" />
    <${Facts} facts=${[
      ['state', element.is_there ? 'is there' : 'is not there'],
      ['clock', element.delay === null ? '' : `values come ${DelayText(element.delay)} after they were sent, by both clocks`],
    ]} />
    <${Section} title="Ports" count=${ports.length}>
      <ul class="connections">${ports.map((port) => html`<li key=${port.path} data-far-port=${port.topic}>
        <${Link} path=${port.path} text=${port.name} /> <small class="type">${port.data_type}</small> <small>${port.state}</small></li>`)}</ul>
    <//>
    ${element.structure && html`<${Section} title="What it is made of"><pre class="far-structure">${element.structure}</pre><//>`}`;
}
