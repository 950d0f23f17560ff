// A port that others in the network may read.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { ErrorText, Offer } from '../state/actions.js';
import { openDialog } from '../state/choices.js';
import { structure } from '../state/store.js';
import { CloseDialog, Dialog } from './dialog.js';

const kQualities = [['', 'the newest value, reliably'], ['each', 'each value, in a queue'], ['sensor', 'at best effort'], ['latched', 'who comes late gets the newest']];

export function OfferDialog({ path }) {
  const [topic, setTopic] = useState('');
  const [as, setAs] = useState('');
  const [qos, setQos] = useState('');
  const [problem, setProblem] = useState('');
  const offer = async () => {
    const dialog = openDialog.value;
    const given = Object.entries({ topic: topic.trim(), as: as.trim(), qos }).filter(([, value]) => value !== '');
    const reply = await Offer(path, Object.fromEntries(given));
    if (reply.ok) CloseDialog(dialog);
    else setProblem((reply.errors ?? []).map(ErrorText).join('\n'));
  };
  const field = (id, label, value, set, placeholder) => html`
    <label for=${id}>${label}</label>
    <input id=${id} value=${value} placeholder=${placeholder} spellcheck="false" autocomplete="off" autofocus=${id === 'offer-topic'}
      onInput=${(event) => { set(event.target.value); setProblem(''); }}
      onKeyDown=${(event) => { if (event.key === 'Enter') offer(); }} />`;
  return html`
    <${Dialog} title="Offer in the network">
      <h2>Offer ${structure.get(path)?.name} <small>to others in the network</small></h2>
      <div class="form">
        ${field('offer-topic', 'Topic', topic, setTopic, 'by its path')}
        ${field('offer-as', 'Messages', as, setAs, 'by their description; sensor_msgs/msg/LaserScan')}
        <label for="offer-qos">Values</label>
        <select id="offer-qos" value=${qos} onChange=${(event) => setQos(event.target.value)}>
          ${kQualities.map(([value, text]) => html`<option key=${value} value=${value}>${text}</option>`)}</select>
      </div>
      ${problem && html`<p class="problem" role="alert">${problem}</p>`}
      <div class="dialog-foot"><button onClick=${() => CloseDialog()}>Cancel</button>
        <button class="primary" id="offer" onClick=${offer}>Offer</button></div>
    <//>`;
}
