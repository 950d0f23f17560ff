// Changes that would leave something without what it needs: they ask first, and say what that is.

import { ConsequencesOf } from '../model/consequences.js';
import { Outermost } from '../model/copies.js';
import { NameOf } from '../model/structure.js';
import { Delete, DeleteAll, Disconnect, Swap } from './actions.js';
import { openDialog } from './choices.js';
import { structure } from './store.js';

export function DeleteCarefully(chosen) {
  const paths = Outermost(chosen); // what is within others goes with them
  const what = paths.length === 1 ? NameOf(paths[0]) : `${paths.length} elements`;
  return AskFirst(`Delete ${what}?`, 'Delete', ConsequencesOf(structure, { gone: paths }),
    () => (paths.length === 1 ? Delete(paths[0]) : DeleteAll(paths)));
}

export function DisconnectCarefully(from, to) {
  const name = (path) => `${NameOf(structure.get(path)?.owner ?? '')}/${NameOf(path)}`;
  return AskFirst(`Disconnect ${name(from)} from ${name(to)}?`, 'Disconnect', ConsequencesOf(structure, { cut: [{ from, to }] }),
    () => Disconnect(from, to));
}

/** `lost`: names of the ports that the other type has not. */
export function SwapCarefully(path, type, lost, swap = () => Swap(path, type)) {
  const cut = structure.portsOf(path).filter((port) => lost.includes(port.name))
    .flatMap((port) => structure.connectionsOf(port.path));
  return AskFirst(`Swap ${NameOf(path)} for ${type}?`, 'Swap', ConsequencesOf(structure, { cut }), swap);
}

function AskFirst(title, verb, consequences, action) {
  if (!consequences.isGrave) return action();
  openDialog.value = { kind: 'confirm', path: title, title, verb, ...consequences, action };
  return null;
}
