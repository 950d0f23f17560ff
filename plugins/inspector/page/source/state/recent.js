// The two modules, or ports of modules, that were selected last: the ends of a chain.

import { effect, signal } from '@preact/signals';
import { selected } from './choices.js';
import { structure } from './store.js';

export const recent = signal([]); // paths, the last one is selected now

effect(() => {
  const path = selected.value;
  const kind = structure.get(path)?.kind;
  if (kind !== 'module' && kind !== 'port') return;
  const before = recent.peek().filter((each) => each !== path);
  recent.value = [...before.slice(-1), path];
});
