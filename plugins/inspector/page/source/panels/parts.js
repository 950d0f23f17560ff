// Small parts that panels are made of.

import { html } from 'htm/preact';
import { NameOf } from '../model/structure.js';
import { Disconnect } from '../state/actions.js';
import { Reveal } from '../state/choices.js';
import { canChange } from '../state/store.js';
import { Select } from '../graph/graph_keys.js';
import { Icon } from './icon.js';

export function Title({ kind, name, path, children }) {
  return html`<div class="title"><p class="kind">${kind}</p><h2>${name}</h2>
    ${path && html`<p class="path" title=${path}>${path}</p>`}${children}</div>`;
}

export function Section({ title, count, children, id }) {
  return html`<section class="part" id=${id} aria-label=${title}>
    <h3>${title}${count !== undefined && html` <small>${count}</small>`}</h3>${children}</section>`;
}

/** Pairs of a name and what it has; those without anything are left out. */
export function Facts({ facts }) {
  return html`<dl class="facts">${facts.filter(([, value]) => value !== null && value !== undefined && value !== '' && value !== false)
    .map(([name, value]) => html`<div key=${name}><dt>${name}</dt><dd>${value}</dd></div>`)}</dl>`;
}

/** The name of an element, which leads to it. */
export function Link({ path, text }) {
  const go = () => { Reveal(path); Select(path); };
  return html`<button class="link" onClick=${go} title=${path}>${text ?? NameOf(path)}</button>`;
}

/** Connections that wait for an end. */
export function Awaited({ awaits }) {
  if (!awaits?.length) return null;
  return html`<ul class="connections">${awaits.map(({ from, to, why }) => html`<li key=${`${from} ${to}`} class="awaited">
    <span class="arrow">waits</span> ${from} → ${to} <small>${why}</small>
    <button class="remove" disabled=${!canChange.value} title="Wait no more" aria-label=${`Do not connect ${from} to ${to}`}
      onClick=${() => Disconnect(from, to)}>✕</button></li>`)}</ul>`;
}

export function ActionButton({ icon, text, onClick, disabled, id, title }) {
  return html`<button class="action" id=${id} disabled=${disabled} onClick=${onClick} title=${title}>
    <${Icon} name=${icon} size=${15} />${text}</button>`;
}
