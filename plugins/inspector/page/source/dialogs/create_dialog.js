// A new module from the catalogue, or a new group. First what it is; its parameters are a second step for whoever
// wants to give them.

import { useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { FreeName, NameProblem } from '../model/changes.js';
import { CreateGroup, CreateModule } from '../state/actions.js';
import { Reveal, selected } from '../state/choices.js';
import { catalogue, revision, structure } from '../state/store.js';
import { Select } from '../graph/graph_keys.js';
import { ChoiceList } from './choice_list.js';
import { Dialog } from './dialog.js';
import { HasParameters, SettingsForm, SettingsOf, SettingsProblem } from './settings_form.js';
import { useSubmission } from './submission.js';

const kGroup = Symbol('a group'); // in the place of a module's type

export function CreateDialog({ group }) {
  revision.value;
  const [type, setType] = useState(null);
  const [typed, setTyped] = useState(null);     // the name
  const [chosen, setChosen] = useState(null);   // the type whose parameters are given
  const [settings, setSettings] = useState({});
  const name = typed ?? (type ? FreeName(structure, group, type) : '');
  const parameters = catalogue.value.module(chosen ?? type)?.parameters ?? [];

  const { submit, button, onEnter, problem, clear } = useSubmission({
    failed: 'Could not add it', may: Boolean,
    send: async (wanted) => {
      if (wanted === kGroup) return (typed && NameProblem(structure, group, typed)) || CreateGroup(group, typed, { quiet: true });
      const free = typed ?? FreeName(structure, group, wanted);
      const wrong = NameProblem(structure, group, free) || (chosen && SettingsProblem(parameters, settings));
      if (wrong) return wrong;
      const reply = await CreateModule(wanted, group, free, chosen ? SettingsOf(parameters, {}, settings) : {});
      return { ...reply, path: `${group}/${free}` };
    },
    done: ({ path }) => { if (path) ShowNew(path, selected.value); },
  });
  const give = (wanted) => { setType(wanted); setChosen(wanted); setSettings({}); clear(); };
  const find = (text) => catalogue.value.search(text).map((module) => ({
    key: module.type, title: module.type, note: Ports(module), detail: module.summary,
  }));
  const nameField = html`<label>Name <input id="new-name" value=${name} spellcheck="false" autocomplete="off"
    onInput=${(event) => { setTyped(event.target.value); clear(); }} onKeyDown=${onEnter(chosen ?? type)} /></label>`;
  if (chosen) {
    return html`
      <${Dialog} key="parameters" title=${`Add ${chosen}`} className="wide">
        <h2>Add ${chosen} <small>to ${group}</small></h2>
        <${SettingsForm} parameters=${parameters} typed=${settings} onEnter=${onEnter(chosen)}
          onType=${(which, text) => { setSettings({ ...settings, [which]: text }); clear(); }} />
        ${problem}
        <div class="dialog-foot">${nameField}
          <button id="back" onClick=${() => { setChosen(null); clear(); }}>Back</button>
          <button class="primary" id="create" ...${button(chosen)}>Add</button></div>
      <//>`;
  }
  return html`
    <${Dialog} key="types" title="Add a module" className="wide">
      <h2>Add a module <small>to ${group}</small></h2>
      <${ChoiceList} label="Module types" placeholder="What shall it do?" find=${find}
          onChoose=${(entry) => submit(entry.key)}
        onCurrent=${(entry) => { setType(entry?.key ?? null); clear(); }} onMore=${(entry) => give(entry.key)}
        hasMore=${HasParameters}
        empty="no module type is like that" />
      <div class="dialog-foot">
        ${nameField}
        <button ...${button(kGroup)}>New group</button>
        <button class="primary" id="create" ...${button(type)}>Add ${type ?? ''}</button>
      </div>
      ${problem}
    <//>`;
}

function Ports({ ports = [] }) {
  const count = (direction) => ports.filter((port) => port.direction === direction).length;
  return `${count('input')} in, ${count('output')} out`;
}

/** Selects a new element as soon as the structure has it, unless the user has selected another since. */
function ShowNew(path, before, attempts = 40) {
  if (selected.value !== before) return;
  if (structure.get(path)) {
    Reveal(path);
    Select(path);
  } else if (attempts > 0) {
    setTimeout(() => ShowNew(path, before, attempts - 1), 50);
  }
}
