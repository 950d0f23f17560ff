// A thread: what begins its cycles, its period, how well it keeps it, and what it runs.

import { html } from 'htm/preact';
import { FreeName } from '../model/changes.js';
import { ThreadOf } from '../model/structure.js';
import { FormatMilliseconds } from '../model/value_format.js';
import { CreateThread, Delete, PauseElement, ResumeElement, Schedule } from '../state/actions.js';
import { canChange, refusals, revision, structure, threadStatistics } from '../state/store.js';
import { NumberField } from './number_field.js';
import { ActionButton, Facts, Link, Section, Title } from './parts.js';

const kActivations = { period: 'every period', free_running: 'at the end of the last', trigger: 'when data comes' };

export function ThreadDetails({ element }) {
  revision.value;
  refusals.value;
  const statistics = threadStatistics.value[element.path];
  const duration = statistics?.duration_ms;
  const locked = !canChange.value;
  const modules = [...structure.ofKind('module')].filter((module) => ThreadOf(structure, module.path) === element.name);
  return html`
    <${Title} kind="thread" name=${element.name} path=${element.path} />
    <div class="actions">
      <${ActionButton} id="pause-thread" icon="pause" text=${element.paused ? 'Go on' : 'Pause'} disabled=${locked}
          onClick=${() => (element.paused ? ResumeElement(element.path) : PauseElement(element.path))}
          title="Leave out all that it runs" />
      <${ActionButton} id="new-thread" icon="add" text="New thread" disabled=${locked}
          onClick=${() => CreateThread(FreeThreadName(element), { period: element.period ?? 0.01 })} />
      <${ActionButton} id="delete" icon="trash" text="Delete" disabled=${locked} onClick=${() => Delete(element.path)} />
    </div>
    <${Facts} facts=${[
      ['cycles begin', html`<select id="thread-activation" aria-label="Cycles begin" disabled=${locked}
          value=${element.activation} onChange=${(event) => Schedule(element.path, { activation: event.target.value })}>
        ${Object.entries(kActivations).map(([name, text]) =>
          html`<option key=${name} value=${name}>${text}</option>`)}</select>`],
      ['period', element.period ? html`<${NumberField} id="thread-period" label="Period in ms" bounds=${{ minimum: 0.001 }} value=${String(Number((element.period * 1000).toPrecision(12)))}
          disabled=${locked} set=${(number) => Schedule(element.path, { period: number / 1000 })} /> ms` : null],
      ['priority', html`<${NumberField} id="thread-priority" label="Priority" bounds=${{ isWhole: true, minimum: 0, maximum: 99 }} value=${String(element.priority ?? '')}
          disabled=${locked} set=${(priority) => Schedule(element.path, { priority })} />`],
      ['cycles', statistics && String(statistics.cycles)],
      ['cycle takes', duration && `${FormatMilliseconds(duration.mean)}, at most ${FormatMilliseconds(duration.max)}`],
      ['measured period', statistics && FormatMilliseconds(statistics.period_ms)],
      ['jitter', statistics && FormatMilliseconds(statistics.jitter_ms)],
      ['overruns', statistics && String(statistics.overruns)],
    ]} />
    <${Section} title="Runs" count=${modules.length}><ul class="members">${modules.slice(0, 200).map((module) =>
      html`<li key=${module.path}><${Link} path=${module.path} /> <small>${module.type}</small></li>`)}</ul><//>`;
}

function FreeThreadName(thread) {
  return FreeName(structure, thread.path.slice(0, thread.path.lastIndexOf('/')), thread.name);
}
