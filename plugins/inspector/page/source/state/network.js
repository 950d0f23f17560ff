// Who is in the network of the application, and what is offered and taken there.

import { signal } from '@preact/signals';
import { NetworkElements } from '../model/network.js';

export const network = signal(null); // the server's message

/** Has the structure show it, too. Whether that is another picture. */
export function ShowNetwork(structure) {
  const told = network.value;
  return structure.cover((bare) => NetworkElements(bare, told), told?.element);
}
