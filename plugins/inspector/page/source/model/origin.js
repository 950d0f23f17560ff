// Ports of groups publish nothing themselves: where what flows through them comes from.

import { IsFar } from './network.js';
import { IsGroup } from './structure.js';

/** The outputs of modules and of other applications that feed a port: itself, if it is one. */
export function OriginsOf(structure, path, seen = new Set()) {
  if (seen.has(path)) return [];
  seen.add(path);
  const port = structure.get(path);
  if (!port) return [];
  const owner = structure.get(port.owner);
  if (port.direction === 'output' && (IsFar(port) || !(owner && IsGroup(owner)))) return [path];
  return structure.connectionsOf(path)
    .filter((connection) => connection.to === path)
    .flatMap((connection) => OriginsOf(structure, connection.from, seen));
}
