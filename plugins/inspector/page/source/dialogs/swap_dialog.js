// Another module in the place of one: the types whose ports suit come first.

import { useEffect, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { CompatibleTypes } from '../state/actions.js';
import { SwapCarefully } from '../state/careful.js';
import { openDialog } from '../state/choices.js';
import { structure } from '../state/store.js';
import { ChoiceList } from './choice_list.js';
import { CloseDialog, Dialog } from './dialog.js';

export function SwapDialog({ path }) {
  const [types, setTypes] = useState(null);
  const module = structure.get(path);
  useEffect(() => {
    const dialog = openDialog.value;
    CompatibleTypes(path).then((reply) => { if (reply.ok) setTypes(reply.types); else CloseDialog(dialog); });
  }, [path]);
  const find = (text) => {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    return (types ?? []).filter(({ type, summary }) => words.every((word) => `${type} ${summary}`.toLowerCase().includes(word)))
      .map(({ type, summary, lost = [] }) => ({
        key: type, title: type, detail: summary, lost,
        note: type === module?.type ? 'as it is' : lost.length > 0 ? `loses ${lost.join(', ')}` : 'all connections stay',
      }));
  };
  const choose = (entry) => { CloseDialog(); SwapCarefully(path, entry.key, entry.lost); };
  return html`
    <${Dialog} title=${`Swap ${module?.name}`}>
      <h2>Swap ${module?.name} <small>now ${module?.type}</small></h2>
      ${types === null ? html`<p class="none">asking the application …</p>`
        : html`<${ChoiceList} label="Module types" placeholder="For which type?" find=${find} onChoose=${choose}
            empty="no type suits" />`}
    <//>`;
}
