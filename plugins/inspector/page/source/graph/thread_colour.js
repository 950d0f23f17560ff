// Each thread has a colour, by its place among the threads; style.css says which.

import { structure } from '../state/store.js';

const kColours = 8;

export function ThreadColour(name) {
  if (!name) return 'var(--no-thread)';
  let index = 0;
  for (const thread of structure.ofKind('thread')) {
    if (thread.name === name) return `var(--thread-${index % kColours})`;
    ++index;
  }
  return 'var(--no-thread)';
}
