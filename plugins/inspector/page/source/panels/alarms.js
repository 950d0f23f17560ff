// What is wrong now: a count in the header that leads from one to the next, and lists in the details.

import { html } from 'htm/preact';
import { Select } from '../graph/graph_keys.js';
import { NameOf } from '../model/structure.js';
import { AlarmsAt, NextAlarm, alarms } from '../state/alarms.js';
import { Reveal } from '../state/choices.js';
import { Icon } from './icon.js';
import { Link, Section } from './parts.js';

const kListed = 20;

export function AlarmCounter() {
  const all = alarms.value;
  if (all.length === 0) return null;
  const next = () => { const path = NextAlarm(); Reveal(path); Select(path); };
  const what = all.slice(0, kListed).map(({ owner, text }) => `${NameOf(owner)}: ${text}`).join('\n');
  return html`<button id="alarms" class="alarms" onClick=${next} title=${`${what}\nPress for the next one`}
    aria-label=${`${CountText(all.length)}: to the next one`}><${Icon} name="alarm" size=${15} />${CountText(all.length)}</button>`;
}

function CountText(count) {
  return `${count} alarm${count === 1 ? '' : 's'}`;
}

/** The alarms of an element and of what is in it; of all if none is given. */
export function AlarmList({ path }) {
  const found = path ? AlarmsAt(path).filter(({ path: at, kind }) => at !== path || !['failed', 'stuck'].includes(kind)) : alarms.value;
  if (found.length === 0) return null;
  return html`<${Section} title="Alarms" count=${found.length} id="alarm-list">
    <ul class="alarm-list" role="alert">${found.slice(0, kListed).map((alarm) => html`<li key=${`${alarm.kind} ${alarm.path}`}
        class=${alarm.kind} data-alarm=${alarm.path}>
      ${alarm.path !== path && html`<${Link} path=${alarm.path} text=${NameOf(alarm.owner)} /> `}${alarm.text}</li>`)}
      ${found.length > kListed && html`<li class="none">and ${found.length - kListed} more</li>`}</ul><//>`;
}
