// Ports of groups publish nothing themselves: where what flows through them comes from.

import { IsGroup } from './structure.js';

/** The outputs of modules that feed a port: itself, if it is one. */
export function OriginsOf(structure, path, seen = new Set()) {
  if (seen.has(path)) return [];
  seen.add(path);
  const port = structure.get(path);
  if (!port) return [];
  const owner = structure.get(port.owner);
  if (port.direction === 'output' && !(owner && IsGroup(owner))) return [path];
  return structure.connectionsOf(path)
    .filter((connection) => connection.to === path)
    .flatMap((connection) => OriginsOf(structure, connection.from, seen));
}
