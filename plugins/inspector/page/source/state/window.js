// How much room the page has.

import { signal } from '@preact/signals';

/** A phone: one thing at a time, chosen by tabs at the bottom. */
export const isPhone = Follow('(max-width: 640px)');
/** A small window: details lie over the graph, and only when they are wanted. */
export const isNarrow = Follow('(max-width: 1000px)');

function Follow(query) {
  const matches = signal(false);
  if (typeof matchMedia === 'undefined') return matches; // tests without a browser
  const list = matchMedia(query);
  matches.value = list.matches;
  list.addEventListener('change', () => { matches.value = list.matches; });
  return matches;
}
