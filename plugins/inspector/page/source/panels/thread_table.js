// The threads, and how they keep their periods.

import { html } from 'htm/preact';
import { ThreadOf } from '../model/structure.js';
import { FormatMilliseconds } from '../model/value_format.js';
import { selected } from '../state/choices.js';
import { shapeRevision, structure, threadStatistics } from '../state/store.js';
import { ThreadColour } from '../graph/thread_colour.js';

export function ThreadTable({ brief }) {
  shapeRevision.value;
  const threads = [...structure.ofKind('thread')];
  const counts = new Map();
  if (!brief) {
    for (const module of structure.ofKind('module')) {
      const name = ThreadOf(structure, module.path);
      counts.set(name, (counts.get(name) ?? 0) + 1);
    }
  }
  if (threads.length === 0) return html`<p class="none">The application has no threads.</p>`;
  return html`<div class="scroll"><table class="threads">
    <thead><tr><th scope="col">thread</th><th scope="col">period</th><th scope="col">cycle takes</th><th
        scope="col">at most</th>
      ${!brief && html`<th scope="col">jitter</th><th scope="col">cycles</th><th scope="col">overruns</th><th
          scope="col">modules</th>`}</tr></thead>
    <tbody>${threads.map((thread) => html`<${Row} key=${thread.path} thread=${thread} brief=${brief}
        modules=${counts.get(thread.name) ?? 0} />`)}</tbody>
  </table></div>`;
}

function Row({ thread, brief, modules }) {
  const statistics = threadStatistics.value[thread.path];
  const isSelected = selected.value === thread.path;
  const load = statistics?.duration_ms && thread.period ? statistics.duration_ms.mean / (thread.period * 10) : null;
  return html`<tr class=${isSelected ? 'selected' : ''} data-thread=${thread.name}>
    <th scope="row"><button class="link" aria-pressed=${isSelected}
        onClick=${() => { selected.value = isSelected ? null : thread.path; }}>
      <i style=${{ background: ThreadColour(thread.name) }}></i>${thread.name}</button></th>
    <td>${thread.period ? FormatMilliseconds(thread.period * 1000) : thread.activation === 'free_running' ? 'free-running' : 'by data'}</td>
    <td>${FormatMilliseconds(statistics?.duration_ms?.mean)}${load !== null && !brief && html`
      <span class="load" title=${`${load.toFixed(1)} % of the period`}><i
          style=${{ width: `${Math.min(100, load)}%` }}></i></span>`}</td>
    <td>${FormatMilliseconds(statistics?.duration_ms?.max)}</td>
    ${!brief && html`<td>${FormatMilliseconds(statistics?.jitter_ms)}</td><td>${statistics?.cycles ?? '–'}</td>
      <td class=${statistics?.overruns > 0 ? 'bad' : ''}>${statistics?.overruns ?? '–'}</td><td>${modules}</td>`}
  </tr>`;
}
