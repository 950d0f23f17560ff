// Connecting without a mouse: the ports that suit, with a search.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { OtherPartners, Partners } from '../model/compatibility.js';
import { Connect } from '../state/actions.js';
import { ConnectOtherwise } from '../state/connecting.js';
import { openDialog } from '../state/choices.js';
import { structure } from '../state/store.js';
import { ChoiceList } from './choice_list.js';
import { CloseDialog, Dialog } from './dialog.js';

export function ConnectDialog({ path }) {
  const port = structure.get(path);
  const partners = Partners(structure, path);
  const others = OtherPartners(structure, path); // of which few may suit: those that are asked for
  const find = (text) => {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    return (words.length > 0 ? [...partners, ...others] : partners).filter(({ port: other }) => words.every((word) => other.path.toLowerCase().includes(word)))
      .map(({ port: other, ends, differs }) => ({
        key: other.path, title: `${structure.get(other.owner)?.name ?? ''}/${other.name}`, ends, differs,
        note: differs ? `${other.data_type}: by a part, or a conversion` : ends.from === path ? 'takes what this gives' : 'gives what this takes', detail: other.path,
      }));
  };
  const [isAsking, setAsking] = useState(false);
  const choose = async ({ ends, differs }) => {
    const dialog = openDialog.value;
    if (differs) {
      setAsking(true);
      await ConnectOtherwise(ends.from, ends.to);
    }
    CloseDialog(dialog);
    if (!differs) Connect(ends.from, ends.to);
  };
  return html`
    <${Dialog} title=${`Connect ${port?.name}`}>
      <h2>Connect ${port?.name} <small>${port?.data_type}</small></h2>
      ${isAsking ? html`<p class="none">asking the application …</p>` : html`<${ChoiceList} label=${`Ports that ${port?.name} can be connected with`} placeholder="With which port?"
          find=${find} onChoose=${choose}
        empty=${`no other port of type ${port?.data_type} is left`} />`}
    <//>`;
}
