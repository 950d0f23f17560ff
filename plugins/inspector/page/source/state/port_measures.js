// What has been seen of ports: their newest values while rows of them are shown, or they are sorted by.

import { effect } from '@preact/signals';
import { FormatPortValue } from '../model/port_table.js';
import { FlowRate, catalogue, hello, run, watches } from './store.js';

export const kElements = 4; // of lists, in a row of a table
const kSampled = 300;       // ports that are looked at in the background at most

const seen = new Map(); // port path -> the item that came last
effect(() => { if (hello.value?.run) seen.clear(); });

export function Remember(path, item) {
  if (item) seen.set(path, item); else seen.delete(path);
}

/** {item, rate, bandwidth, age, value}: null where nothing is known. */
export function MeasuresOf({ path, type }) {
  const rate = FlowRate(path);
  const item = seen.get(path) ?? null;
  return {
    item, rate,
    bandwidth: item?.bytes !== undefined && rate !== null ? rate * item.bytes : null,
    age: item ? Math.max(0, run.peek().time - item.stamp) : null,
    value: item ? (typeof item.value === 'number' ? item.value : FormatPortValue(catalogue.peek().meaning(type), item.value)) : null,
  };
}

/** Has values of all these ports looked at now and then, if they are not too many. The function ends it. */
export function Sample(paths) {
  if (paths.length > kSampled) return () => {};
  const ends = paths.map((path) =>
    watches.watch(path, { rate: 1, elements: kElements, onValue: (item) => Remember(path, item) }).end);
  return () => { for (const end of ends) end(); };
}
