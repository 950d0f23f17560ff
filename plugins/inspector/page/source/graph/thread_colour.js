// Each thread has a colour, by its place among the threads; style.css says which.

import { structure } from '../state/store.js';

const kColours = 8;

export function ThreadColour(name) {
  const index = [...structure.ofKind('thread')].findIndex((thread) => thread.name === name);
  return index < 0 ? 'var(--no-thread)' : `var(--thread-${index % kColours})`;
}
