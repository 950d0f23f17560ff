// The modules in whose boxes is shown what they draw. Kept by the browser.

import { computed, effect, signal } from '@preact/signals';
import { catalogue, shapeRevision, structure } from './store.js';

const kKey = 'runnel.pictured';

function Kept() {
  try {
    return JSON.parse(localStorage.getItem(kKey)) ?? {};
  } catch {
    return {}; // nothing may be kept here
  }
}

export const pictured = signal(Kept()); // path of a module -> true

effect(() => {
  try {
    localStorage.setItem(kKey, JSON.stringify(pictured.value));
  } catch {
    // A browser that keeps nothing shows it nevertheless.
  }
});

/** Module path -> its output that has drawings. */
const drawings = computed(() => {
  shapeRevision.value;
  const found = new Map();
  for (const port of structure.ofKind('port')) {
    if (port.direction !== 'output' || catalogue.value.meaning(port.data_type) !== 'drawing') continue;
    if (structure.get(port.owner)?.kind === 'module' && !found.has(port.owner)) found.set(port.owner, port.path);
  }
  return found;
});

/** The output of a module that has drawings, or undefined. */
export const DrawingOf = (path) => drawings.value.get(path);
export const IsPictured = (path) => pictured.value[path] === true && drawings.value.has(path);

export function TogglePicture(path) {
  const { [path]: isShown, ...others } = pictured.value;
  pictured.value = isShown ? others : { ...others, [path]: true };
}
