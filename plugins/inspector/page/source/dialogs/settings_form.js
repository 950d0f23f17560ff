// Parameters of a module that is about to be made: those that are fixed while it runs, too.

import { html } from 'htm/preact';
import { CheckValue } from '../model/parameter_check.js';
import { FormatBounds } from '../model/value_format.js';
import { catalogue } from '../state/store.js';

/** Whether there is anything to be given to modules of the type of a list's entry. */
export const HasParameters = ({ key }) => (catalogue.value.module(key)?.parameters ?? []).length > 0;

/** `typed`: texts by name; what is not in it is as `given`, and if that has nothing, the default. `old`: values of the module before. */
export function SettingsForm({ parameters, given = {}, old = {}, typed, onType, onEnter }) {
  return html`<div class="settings" role="group" aria-label="Parameters">
    ${Ordered(parameters).map((each) => html`<${Row} key=${each.name} parameter=${each} given=${given[each.name]} old=${old[each.name]}
      typed=${typed[each.name]} onType=${(text) => onType(each.name, text)} onEnter=${onEnter} />`)}</div>`;
}

/** What is wrong with what was typed, or "". */
export function SettingsProblem(parameters, typed, given = {}) {
  for (const each of parameters) {
    const wrong = WrongWith(each, typed[each.name], given[each.name]);
    if (wrong) return `${each.name}: ${wrong}`;
  }
  return '';
}

/** Of a field that is cleared the default counts; where there is none, the value of the module before would be handed on. */
function WrongWith(parameter, text, given) {
  if (text === undefined) return '';
  if (text !== '') return CheckValue(AsChecked(parameter), text, catalogue.value);
  return given !== undefined && !parameter.default && !IsText(parameter.type) ? 'it has no default: a value is needed' : '';
}

/** What is to be said of parameters when the module is made: {name: text}. */
export function SettingsOf(parameters, given, typed) {
  const settings = {};
  for (const { name, type, default: usual } of parameters) {
    const text = typed[name];
    if (text === undefined) continue;
    if (text !== '' || IsText(type)) settings[name] = text;
    else if (given[name] !== undefined && usual) settings[name] = usual;
  }
  return settings;
}

function Row({ parameter, given, old, typed, onType, onEnter }) {
  const { name, unit, description, static: isStatic } = parameter;
  const usual = given ?? parameter.default ?? '';
  const text = typed ?? usual;
  const id = `setting:${name}`;
  const wrong = WrongWith(parameter, typed, given);
  const note = [FormatBounds(parameter), isStatic && 'fixed while it runs',
    old !== undefined && old !== null && old !== usual && `the old one has ${old}`].filter(Boolean).join(' · ');
  return html`<div class=${`parameter ${wrong ? 'wrong' : ''} ${typed !== undefined && typed !== usual ? 'edited' : ''}`}>
    <label for=${id} title=${description}>${name} <small>${parameter.type}</small></label>
    <div class="field"><${Field} id=${id} parameter=${parameter} text=${text} wrong=${wrong !== ''} onType=${onType} onEnter=${onEnter} />
      ${unit && html`<span class="unit">${unit}</span>`}</div>
    ${description && html`<p class="note about">${description}</p>`}
    ${note && html`<p class="note">${note}</p>`}
    ${wrong && html`<p class="problem" role="alert">${wrong}</p>`}
  </div>`;
}

function Field({ id, parameter, text, wrong, onType, onEnter }) {
  const values = parameter.choices?.length > 0 ? parameter.choices : catalogue.value.type(parameter.type)?.values ?? [];
  const choices = parameter.type === 'bool' ? ['true', 'false'] : values;
  if (choices.length > 0) {
    // Shown as what it is, not as the first of the choices: the value of a module before, or none.
    const other = choices.includes(text) ? '' : html`<option key=${`other ${text}`} value=${text} selected>${text === '' ? 'nothing' : `${text}: not among its choices`}</option>`;
    return html`<select id=${id} value=${text} onChange=${(event) => onType(event.target.value)}>
      ${other}${choices.map((value) => html`<option key=${value} value=${value} selected=${value === text}>${value}</option>`)}</select>`;
  }
  return html`<input type="text" id=${id} spellcheck="false" autocomplete="off" aria-invalid=${wrong} value=${text}
    placeholder=${IsText(parameter.type) ? 'empty' : parameter.default || 'nothing'} onInput=${(event) => onType(event.target.value)} onKeyDown=${onEnter} />`;
}

/** Whether "" is a value; of others it is the default. */
const IsText = (type) => CheckValue({ data_type: type }, '', catalogue.value) === '';

const AsChecked = (parameter) => ({ ...parameter, data_type: parameter.type });

/** Those that can be given only now come first. */
function Ordered(parameters) {
  return [...parameters.filter((each) => each.static), ...parameters.filter((each) => !each.static)];
}
