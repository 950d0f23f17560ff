// A port that others in the network may read.

import { html } from 'htm/preact';
import { Offer } from '../state/actions.js';
import { structure } from '../state/store.js';
import { WordForm } from './word_form.js';

const kFields = [
  { name: 'topic', text: 'Topic', hint: 'by its path' },
  { name: 'as', text: 'Messages', hint: 'by their description; sensor_msgs/msg/LaserScan' },
  { name: 'qos', text: 'Values', choices: [['', 'the newest value, reliably'], ['each', 'each value, in a queue'], ['sensor', 'at best effort'], ['latched', 'who comes late gets the newest']] },
];

export function OfferDialog({ path }) {
  return html`<${WordForm} id="offer" title="Offer in the network" heading=${`Offer ${structure.get(path)?.name}`} note="to others in the network"
    button="Offer" fields=${kFields} apply=${(words) => Offer(path, words)} />`;
}
