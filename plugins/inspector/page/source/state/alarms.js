// The alarms of now as signals, and the way from one to the next.

import { computed } from '@preact/signals';
import { AlarmsOf, CountByElement } from '../model/alarms.js';
import { isConnected, run, shapeRevision, silent, structure } from './store.js';

const runs = computed(() => isConnected.value && !run.value.paused && !run.value.ended);
const kNone = new Map();

export const alarms = computed(() => {
  shapeRevision.value;
  return AlarmsOf(structure, runs.value ? silent.value : kNone); // nothing publishes while time stands still
});

const counts = computed(() => CountByElement(alarms.value));

/** How many alarms there are of an element and of what is in it. */
export function AlarmCount(path) {
  return counts.value.get(path) ?? 0;
}

/** The alarms of an element and of what is in it. */
export function AlarmsAt(path) {
  return alarms.value.filter((alarm) => alarm.path === path || alarm.owner === path || alarm.owner.startsWith(`${path}/`));
}

let shown = null;

/** The alarm after the one that was asked for last. */
export function NextAlarm() {
  const paths = alarms.value.map((alarm) => alarm.path);
  shown = paths[(paths.indexOf(shown) + 1) % paths.length] ?? null;
  return shown;
}
