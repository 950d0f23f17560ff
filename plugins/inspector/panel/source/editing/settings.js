// The settings of the widget that is chosen.

import { html } from 'htm/preact';
import { IsGroup } from '../../../page/source/model/structure.js';
import { catalogue, revision, structure } from '../../../page/source/state/store.js';
import { DrivableInputs } from '../model/default_panel.js';
import { NumberFields, PartFields } from '../model/fields.js';
import { SettingsOf } from '../model/kinds.js';
import { ChangeWidget, chosen, chosenWidget } from '../panel_state.js';
import { TitleOf } from './frame.js';

export function Settings() {
  revision.value;
  const widget = chosenWidget.value;
  if (!widget) return html`<aside class="settings" aria-label="Settings"><p class="none">Choose a widget to set it, drag its bar to move it, its corner to
    resize it. What is in the way makes room.</p></aside>`;
  return html`
    <aside class="settings" aria-label="Settings" key=${widget.id}>
      <header><h2>${TitleOf(widget)}</h2><button class="remove" aria-label="Close" onClick=${() => { chosen.value = null; }}>✕</button></header>
      ${SettingsOf(widget.kind).map((setting) => html`<${Setting} key=${setting.name} widget=${widget} setting=${setting} />`)}
    </aside>`;
}

function Setting({ widget, setting }) {
  const id = `setting:${setting.name}`;
  const set = (value) => ChangeWidget(widget.id, { [setting.name]: value });
  return html`<div class="setting"><label for=${id}>${setting.label}${setting.unit && html` <small>${setting.unit}</small>`}</label>
    <${Field} id=${id} widget=${widget} setting=${setting} value=${widget[setting.name]} set=${set} />
    ${setting.note && html`<small>${setting.note}</small>`}</div>`;
}

function Field({ id, widget, setting, value, set }) {
  switch (setting.kind) {
    case 'number':
      return html`<input id=${id} type="number" step="any" value=${value ?? ''}
        onChange=${(event) => set(Number.isFinite(event.target.valueAsNumber) ? event.target.valueAsNumber : undefined)} />`;
    case 'flag':
      return html`<input id=${id} type="checkbox" class="switch" role="switch" checked=${Boolean(value)} onChange=${(event) => set(event.target.checked || undefined)} />`;
    case 'field':
      return html`<${Choice} id=${id} value=${value ?? ''} options=${FieldsFor(widget)} onChoice=${(field) => set(field || undefined)} />`;
    case 'curves':
      return html`<${Curves} id=${id} curves=${value ?? []} set=${set} />`;
    case 'text':
      return html`<input id=${id} type="text" value=${value ?? ''} placeholder=${setting.usual ?? ''} onChange=${(event) => set(event.target.value || undefined)} />`;
    default:
      return html`<${Choice} id=${id} value=${value ?? ''} options=${['', ...Targets(setting)].map((path) => [path, path ? Brief(path) : '–'])}
        onChoice=${(path) => ChangeWidget(widget.id, { [setting.name]: path || undefined, ...FirstField(widget, path) })} />`;
  }
}

function Choice({ id, value, options, onChoice }) {
  const all = options.some(([each]) => each === value) ? options : [[value, `${Brief(value)} (away)`], ...options];
  return html`<select id=${id} value=${value} onChange=${(event) => onChoice(event.target.value)}>
    ${all.map(([each, label]) => html`<option key=${each} value=${each} selected=${each === value} title=${each}>${label}</option>`)}</select>`;
}

/** One row for each curve: the numbers of all outputs. */
function Curves({ id, curves, set }) {
  const all = Targets({ kind: 'output' }).flatMap((path) => NumberFields(catalogue.value, structure.get(path).data_type)
    .map(({ field }) => [`${path} ${field}`, `${Brief(path)}${field ? `.${field}` : ''}`]));
  const rows = [...curves.map(({ target, field }) => `${target} ${field ?? ''}`), ...(curves.length < 6 ? [''] : [])];
  const choose = (index, text) => {
    const next = rows.map((row, at) => (at === index ? text : row)).filter(Boolean);
    set(next.length === 0 ? undefined : next.map((row) => {
      const [target, field] = row.split(' ');
      return field ? { target, field } : { target };
    }));
  };
  return html`<div class="curve-list">${rows.map((row, index) => html`<${Choice} key=${index} id=${index === 0 ? id : undefined} value=${row}
    options=${[['', '–'], ...all]} onChoice=${(text) => choose(index, text)} />`)}</div>`;
}

/** Paths that may be chosen: outputs and inputs of modules, parameters that can be set. */
function Targets({ kind, meaning }) {
  if (meaning === 'twist') return DrivableInputs(structure, catalogue.value).map(({ path }) => path);
  const ports = [...structure.ofKind('port')].filter((port) => {
    const owner = structure.get(port.owner);
    return owner && !IsGroup(owner) && (kind === 'output' || port.direction === 'input') &&
      (!meaning || catalogue.value.meaning(port.data_type) === meaning);
  }).map(({ path }) => path);
  if (kind !== 'target') return ports;
  return [...[...structure.ofKind('parameter')].filter(({ settable }) => settable).map(({ path }) => path), ...ports];
}

function FieldsFor(widget) {
  const port = structure.get(widget.target);
  const fields = port ? (widget.kind === 'value' ? [{ field: '' }, ...PartFields(catalogue.value, port.data_type)] : NumberFields(catalogue.value, port.data_type)) : [];
  return fields.map(({ field, unit }) => [field, field ? `${field}${unit ? ` (${unit})` : ''}` : 'all of it']);
}

/** Of another port the parts have other names. */
function FirstField(widget, path) {
  if (widget.kind !== 'gauge') return { field: undefined };
  const port = structure.get(path);
  return { field: (port && NumberFields(catalogue.value, port.data_type)[0]?.field) || undefined };
}

/** "planner/twist" of "/bug_demo/robot/planner/output/twist". */
function Brief(path) {
  const element = structure.get(path);
  return path.replace(`${structure.root}/`, '').replace(element?.kind === 'parameter' ? /\/parameter\/([^/]*)$/ : /\/(?:\w*input|\w*output)s?\/([^/]*)$/, '/$1');
}
