// Networks of behaviours, told by what their ports mean: which boxes have bars, and which edges have a colour.

import { computed } from '@preact/signals';
import { catalogue, shapeRevision, structure } from './store.js';

const kModes = ['auto', 'enabled', 'disabled'];
const kSignals = ['stimulation', 'inhibition', 'activity', 'target_rating'];

/** Path of a module or group -> its output that says how the behaviour is. */
const states = computed(() => {
  shapeRevision.value;
  const found = new Map();
  for (const port of structure.ofKind('port')) {
    if (port.direction === 'output' && catalogue.value.meaning(port.data_type) === 'behaviour_state') found.set(port.owner, port.path);
  }
  return found;
});

/** The output that says how the behaviour at this path is, or undefined. */
export const BehaviourOf = (path) => states.value.get(path);

/** Which signal of behaviours an edge carries to its end, or ''. */
export function SignalOf(edge) {
  const meaning = catalogue.value.meaning(structure.get(edge.to)?.data_type);
  return kSignals.includes(meaning) ? meaning : '';
}

/** The parameter of a box by which its mode is set, or undefined. */
export const ModeParameter = (path) => structure.parametersOf(path).find((parameter) => parameter.name === 'stimulation_mode');

export const ModeAfter = (mode) => kModes[(kModes.indexOf(mode) + 1) % kModes.length];
