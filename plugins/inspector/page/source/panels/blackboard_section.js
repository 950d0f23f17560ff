// A blackboard: its revision, who reads it, who writes to it, and what has come of the changes.

import { html } from 'htm/preact';
import { BlackboardOf } from '../model/blackboards.js';
import { NameOf } from '../model/structure.js';
import { FormatRate } from '../model/value_format.js';
import { FlowRate, structure } from '../state/store.js';
import { Facts, Link, Section } from './parts.js';
import { useWatched } from './use_watched.js';

export function BlackboardSection({ path }) {
  const board = BlackboardOf(structure, path);
  const revision = useWatched(board?.value ?? '', { rate: 8 })?.count;
  const state = useWatched(board?.changes ?? '', { rate: 8 })?.service;
  if (!board) return null;
  const rate = FlowRate(board.value);
  const links = (paths) => paths.map((each, index) => html`${index > 0 ? ', ' : ''}<${Link} key=${each} path=${each} text=${NameOf(each)} />`);
  const owner = structure.get(board.value).owner;
  return html`
    <${Section} title="Blackboard" id="blackboard">
      <${Facts} facts=${[
        ['revision', revision !== undefined && revision !== null && String(revision)],
        ['committed', rate !== null && FormatRate(rate)],
        ['owned by', html`<${Link} path=${owner} text=${NameOf(owner)} />`],
        ['written by', links(board.writers)],
        ['read by', board.readers.length > 0 && links(board.readers)],
        ['change sets', state && `${state.answered} answered, ${state.waiting} waiting${state.failed > 0 ? `, ${state.failed} failed` : ''}`],
        [path === board.value ? 'changed by' : 'changes', html`<${Link} path=${path === board.value ? board.changes : board.value}
            text=${NameOf(path === board.value ? board.changes : board.value)} />`],
      ]} />
    <//>`;
}
