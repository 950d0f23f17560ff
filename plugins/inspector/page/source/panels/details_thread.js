// A thread: its period, how well it keeps it, and what it runs.

import { html } from 'htm/preact';
import { ThreadOf } from '../model/structure.js';
import { FormatMilliseconds } from '../model/value_format.js';
import { revision, structure, threadStatistics } from '../state/store.js';
import { Facts, Link, Section, Title } from './parts.js';

export function ThreadDetails({ element }) {
  revision.value;
  const statistics = threadStatistics.value[element.path];
  const duration = statistics?.duration_ms;
  const modules = [...structure.ofKind('module')].filter((module) => ThreadOf(structure, module.path) === element.name);
  return html`
    <${Title} kind="thread" name=${element.name} path=${element.path} />
    <${Facts} facts=${[
      ['period', element.period ? FormatMilliseconds(element.period * 1000) : 'by data, or free-running'],
      ['cycles', statistics && String(statistics.cycles)],
      ['cycle takes', duration && `${FormatMilliseconds(duration.mean)}, at most ${FormatMilliseconds(duration.max)}`],
      ['measured period', statistics && FormatMilliseconds(statistics.period_ms)],
      ['jitter', statistics && FormatMilliseconds(statistics.jitter_ms)],
      ['overruns', statistics && String(statistics.overruns)],
    ]} />
    <${Section} title="Runs" count=${modules.length}><ul class="members">${modules.slice(0, 200).map((module) =>
      html`<li key=${module.path}><${Link} path=${module.path} /> <small>${module.type}</small></li>`)}</ul><//>`;
}
