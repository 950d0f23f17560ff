// Several boxes are chosen: what they are, and what can be done with all of them.

import { html } from 'htm/preact';
import { NameOf } from '../model/structure.js';
import { DeleteCarefully } from '../state/careful.js';
import { chosen } from '../state/choices.js';
import { CopyChosen, DuplicateChosen } from '../state/clipboard.js';
import { canChange, structure } from '../state/store.js';
import { ActionButton, Link, Section, Title } from './parts.js';

export function ChosenDetails() {
  const paths = chosen.value;
  const locked = !canChange.value;
  return html`
    <${Title} kind="chosen" name=${`${paths.length} boxes`} />
    <div class="actions">
      <${ActionButton} id="copy" icon="layers" text="Copy" onClick=${CopyChosen} title="Copy (Ctrl+C)" />
      <${ActionButton} id="duplicate" icon="add" text="Duplicate" disabled=${locked} onClick=${() => DuplicateChosen()}
        title="Make the same again beside them, with new names" />
      <${ActionButton} id="delete" icon="trash" text="Delete" disabled=${locked} onClick=${() => DeleteCarefully(paths)} />
    </div>
    <${Section} title="Chosen" count=${paths.length}><ul class="members">${paths.map((path) => html`<li key=${path}>
      <${Link} path=${path} text=${NameOf(path)} /> <small>${structure.get(path)?.type ?? 'group'}</small></li>`)}</ul><//>
    <p class="hint">Drag one of them to move all. Shift and a click adds or leaves out.</p>`;
}
