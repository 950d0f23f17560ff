// How long modules take, and how old what chains of them publish is.

import { html } from 'htm/preact';
import { FormatMicroseconds } from '../model/value_format.js';
import { SetLatency, SetProfiled } from '../state/actions.js';
import { canChange, profile } from '../state/store.js';
import { ChainRow } from './chain_row.js';
import { ActionButton, Link } from './parts.js';

export function ProfileTable() {
  const { on, tasks, latencies } = profile.value;
  const byShare = [...tasks].sort((a, b) => b.share - a.share);
  return html`<div class="profile">
    <div class="actions"><${ActionButton} id="profile" icon="follow" text=${on ? 'End measuring' : 'Measure modules'}
        disabled=${!canChange.value} onClick=${() => SetProfiled(!on)} /></div>
    <${ChainRow} />
    ${latencies.map((latency) => html`<p class="latency" key=${`${latency.from} ${latency.to}`}>
      From <${Link} path=${latency.from} /> to <${Link} path=${latency.to} />: last ${
        FormatMicroseconds(latency.last_us)}, mean ${FormatMicroseconds(latency.mean_us)}, at most ${
        FormatMicroseconds(latency.max_us)}, of ${latency.runs} measurements
      <button class="remove" disabled=${!canChange.value} title="Measure it no more" aria-label=${`Measure from ${latency.from} to ${latency.to} no more`}
        onClick=${() => SetLatency(latency.from, latency.to, false)}>✕</button></p>`)}
    ${tasks.length > 0 && html`<div class="scroll"><table class="threads" id="profile-table">
      <thead><tr><th scope="col">module</th><th scope="col">share</th><th scope="col">last</th><th
          scope="col">mean</th><th scope="col">max</th><th scope="col">total</th><th scope="col">runs</th><th
          scope="col">order</th><th scope="col">thread</th></tr></thead>
      <tbody>${byShare.map((task) => html`<tr key=${task.name} data-task=${task.name}>
        <th scope="row"><${Link} path=${task.path} />${task.name.slice(task.path.length)}</th>
        <td>${task.share.toFixed(2)} %</td><td>${FormatMicroseconds(task.last_us)}</td>
        <td>${FormatMicroseconds(task.mean_us)}</td><td>${FormatMicroseconds(task.max_us)}</td>
        <td>${FormatMicroseconds(task.total_us)}</td><td>${task.runs}</td><td>${task.order}</td>
        <td>${task.thread.split('/').pop()}</td></tr>`)}</tbody></table></div>`}
    ${!on && latencies.length === 0 && html`<p class="none">Nothing is measured.</p>`}
  </div>`;
}
