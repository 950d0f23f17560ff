// Nothing is selected: the application itself, and its threads.

import { html } from 'htm/preact';
import { hello, run, shapeRevision, structure } from '../state/store.js';
import { AlarmList } from './alarms.js';
import { Awaited, Facts, Section, Title } from './parts.js';
import { ThreadTable } from './thread_table.js';

export function ApplicationDetails() {
  shapeRevision.value;
  const count = (kind) => [...structure.ofKind(kind)].length;
  if (!hello.value) return html`<p class="empty">Nothing is known of the application yet.</p>`;
  return html`
    <${Title} kind="application" name=${hello.value.application} path=${hello.value.file} />
    <${Facts} facts=${[
      ['modules', String(count('module'))], ['connections', String(structure.connections.size)],
      ['threads', String(count('thread'))], ['clock', hello.value.clock],
      ['speed', run.value.speed === null ? '' : run.value.speed === 0 ? 'as fast as it can' : `× ${run.value.speed}`],
      ['faults', String(run.value.faults)], ['Runnel', hello.value.runnel],
    ]} />
    <${AlarmList} />
    <${Awaited} awaits=${[...structure.ofKind('application')].flatMap(({ awaits }) => awaits ?? [])} />
    <${Section} title="Threads"><${ThreadTable} brief /><//>
    <p class="hint">Select anything in the graph to see and change it. Drag from port to port to connect.
      Press <kbd>?</kbd> for all keys.</p>`;
}
