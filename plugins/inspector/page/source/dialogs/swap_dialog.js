// Another module in the place of one: its own type, made anew with other parameters, or another one; the types whose ports
// suit come first.

import { useEffect, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { CompatibleTypes, Swap } from '../state/actions.js';
import { SwapCarefully } from '../state/careful.js';
import { NameOf } from '../model/structure.js';
import { openDialog } from '../state/choices.js';
import { catalogue, structure } from '../state/store.js';
import { ChoiceList } from './choice_list.js';
import { CloseDialog, Dialog } from './dialog.js';
import { HasParameters, SettingsForm, SettingsOf, SettingsProblem } from './settings_form.js';
import { useSubmission } from './submission.js';

export function SwapDialog({ path }) {
  const [types, setTypes] = useState(null);
  const [chosen, setChosen] = useState(null); // {key, lost}: the type whose parameters are given
  const module = structure.get(path);
  useEffect(() => {
    const dialog = openDialog.value;
    CompatibleTypes(path).then((reply) => { if (reply.ok) setTypes(reply.types); else CloseDialog(dialog); });
  }, [path]);
  const find = (text) => {
    const words = text.toLowerCase().split(/\s+/).filter(Boolean);
    const found = (types ?? []).filter(({ type, summary }) => words.every((word) => `${type} ${summary}`.toLowerCase().includes(word)))
      .map(({ type, summary, lost = [] }) => ({
        key: type, title: type, detail: summary, lost,
        note: type === module?.type ? 'its own type, made anew' : lost.length > 0 ? `loses ${lost.join(', ')}` : 'all connections stay',
      }));
    const isOwn = ({ key }) => key === module?.type;
    return [...found.filter(isOwn), ...found.filter((each) => !isOwn(each))];
  };
  const choose = (entry) => {
    if (entry.key === module?.type && HasParameters(entry)) return setChosen(entry);
    CloseDialog();
    return SwapCarefully(path, entry.key, entry.lost);
  };
  if (chosen) return html`<${Parameters} path=${path} type=${chosen.key} lost=${chosen.lost} onBack=${() => setChosen(null)} />`;
  return html`
    <${Dialog} key="types" title=${`Swap ${module?.name}`}>
      <h2>Swap ${module?.name} <small>now ${module?.type}</small></h2>
      ${types === null ? html`<p class="none">asking the application …</p>`
        : html`<${ChoiceList} label="Module types" placeholder="For which type?" find=${find} onChoose=${choose}
            onMore=${setChosen} hasMore=${HasParameters} empty="no type suits" />`}
    <//>`;
}

/** The second step: what the parameters of the new module are to be. Those that the old one has set are handed on, as the application does it. */
function Parameters({ path, type, lost, onBack }) {
  const [settings, setSettings] = useState({});
  const parameters = catalogue.value.module(type)?.parameters ?? [];
  const before = structure.parametersOf(path);
  const given = Object.fromEntries(before.filter(({ value, default: usual }) => value !== usual).map(({ name, value }) => [name, value ?? undefined]));
  const old = Object.fromEntries(before.map(({ name, value }) => [name, value]));
  const { button, onEnter, problem, clear } = useSubmission({
    failed: `Could not swap ${NameOf(path)}`,
    send: () => {
      const dialog = openDialog.value;
      return SettingsProblem(parameters, settings, given) || SwapCarefully(path, type, lost,
        () => Swap(path, type, SettingsOf(parameters, given, settings), { quiet: openDialog.value === dialog }));
    },
  });
  const name = structure.get(path)?.name;
  return html`
    <${Dialog} key="parameters" title=${`Swap ${name} for ${type}`} className="wide">
      <h2>Swap ${name} <small>for ${type}</small></h2>
      <${SettingsForm} parameters=${parameters} given=${given} old=${old} typed=${settings} onEnter=${onEnter()}
        onType=${(which, text) => { setSettings({ ...settings, [which]: text }); clear(); }} />
      ${problem}
      <div class="dialog-foot"><button id="back" onClick=${onBack}>Back</button>
        <button class="primary" id="swap-now" ...${button()}>Swap</button></div>
    <//>`;
}
