// Ports of groups publish nothing themselves: where what flows through them comes from.

import { IsGroup } from './structure.js';

/** Whether values are made there: of a module, or of another application, and not the border of a group. */
export function IsSource(structure, port) {
  const owner = structure.get(port.owner);
  return port.direction === 'output' && Boolean(owner) && (port.interface === false || !IsGroup(owner));
}

/** The outputs that feed a port: itself, if it is one. */
export function OriginsOf(structure, path, seen = new Set()) {
  if (seen.has(path)) return [];
  seen.add(path);
  const port = structure.get(path);
  if (!port) return [];
  if (IsSource(structure, port)) return [path];
  return structure.connectionsOf(path)
    .filter((connection) => connection.to === path)
    .flatMap((connection) => OriginsOf(structure, connection.from, seen));
}
