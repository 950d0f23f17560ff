// What is wrong with an application as it is now: modules that have failed or are stuck, required inputs that get
// nothing from anywhere, outputs that have fallen silent.

import { OriginsOf } from './origin.js';
import { NameOf, ParentOf } from './structure.js';

/**
 * [{path, owner, kind: 'failed' | 'stuck' | 'unconnected' | 'silent', text}], the worst first; `path` is of a module or a
 * port, `owner` of the module. `silent`: Map port path -> since when, in seconds.
 */
export function AlarmsOf(structure, silent) {
  const failed = [];
  const unconnected = [];
  for (const element of structure.elements.values()) {
    if (element.kind === 'module' && element.failure) {
      const [kind, text] = element.stuck ? ['stuck', `is stuck: it ${element.failure}`] : ['failed', `has failed: ${element.failure}`];
      failed.push({ path: element.path, owner: element.path, kind, text });
    } else if (LacksSource(structure, element)) {
      unconnected.push({ path: element.path, owner: element.owner, kind: 'unconnected',
        text: `${element.name} is required and has no source` });
    }
  }
  const quiet = [...silent].filter(([path]) => structure.get(path) && structure.connectionsOf(path).length > 0)
    .map(([path, since]) => ({ path, owner: structure.get(path).owner, kind: 'silent',
      text: `${NameOf(path)} has published nothing since ${since.toFixed(1)} s` }));
  return [...failed, ...unconnected, ...quiet];
}

/** Whether it is a required input of a module that nothing can come to, not even through groups around it, or is waited for. */
export function LacksSource(structure, element) {
  return element.kind === 'port' && element.direction === 'input' && element.required && !element.by_hand && !element.awaits?.length &&
    structure.get(element.owner)?.kind === 'module' && OriginsOf(structure, element.path).length === 0;
}

/** How many alarms there are of an element, and of what is in it: Map path -> number. */
export function CountByElement(alarms) {
  const counts = new Map();
  for (const { path, owner } of alarms) {
    for (const at of path === owner ? [] : [path]) counts.set(at, 1);
    for (let at = owner; at; at = ParentOf(at)) counts.set(at, (counts.get(at) ?? 0) + 1);
  }
  return counts;
}
