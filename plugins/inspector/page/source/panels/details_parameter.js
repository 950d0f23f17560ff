// A parameter that was found by the search.

import { html } from 'htm/preact';
import { structure } from '../state/store.js';
import { ParameterRow } from './parameter_row.js';
import { Facts, Link, Title } from './parts.js';

export function ParameterDetails({ element }) {
  return html`
    <${Title} kind="parameter" name=${element.name} path=${element.path}>
      ${element.description && html`<p class="summary">${element.description}</p>`}<//>
    <${ParameterRow} parameter=${element} />
    <${Facts} facts=${[['of', element.owner && structure.get(element.owner) && html`<${Link}
        path=${element.owner} />`],
      ['type', element.data_type], ['default', element.default]]} />`;
}
