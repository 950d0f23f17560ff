// The newest value of a port, for as long as a component is shown.

import { useEffect, useState } from 'preact/hooks';
import { watches } from '../state/store.js';

/** {stamp, measured, count, value, cut, drops} or null; '' watches nothing. */
export function useWatched(path, options) {
  const [item, setItem] = useState(null);
  useEffect(() => {
    setItem(null);
    if (!path) return undefined;
    return watches.watch(path, { ...options, onValue: setItem }).end;
  }, [path, options?.rate, options?.elements]);
  return item;
}
