// A port that gets what others in the network write.

import { html } from 'htm/preact';
import { Take } from '../state/actions.js';
import { structure } from '../state/store.js';
import { WordForm } from './word_form.js';

const kFields = [
  { name: 'topic', text: 'Topic', hint: '/cmd_vel' },
  { name: 'as', text: 'Messages', hint: 'by their description; geometry_msgs/msg/Twist' },
  { name: 'field', text: 'Field', hint: 'the whole message; percentage, ranges[0]' },
  { name: 'qos', text: 'Values', choices: [['', 'as they are offered'], ['newest', 'the newest value, reliably'], ['each', 'each value, in a queue'], ['sensor', 'at best effort'], ['latched', 'the newest of before, too']] },
  { name: 'stamp', text: 'Stamps', choices: [['', 'when they arrive'], ['sent', 'as their writer says']] },
  { name: 'exclusive', text: 'Writers', choices: [['', 'all are heard'], ['true', 'only the strongest is heard']] },
];

/** `topic`, `as`: of what is known already. */
export function TakeDialog({ path, topic = '', as = '' }) {
  return html`<${WordForm} id="take" title="Take from the network" heading=${`What shall ${structure.get(path)?.name} get`} note="of others in the network"
    button="Take" fields=${kFields} given=${{ topic, as }} apply=${({ topic: of = '', ...words }) => Take(of, path, words)} />`;
}
