// Which ports may be connected. The server has the last word; this is what lights up meanwhile.

import { IsGroup, ParentOf } from './structure.js';

/**
 * The two ends in the order of the data, or null if they cannot be connected: {from, to}.
 * A port of a group is both: seen from outside an input takes values, seen from inside it gives them.
 */
export function Connectable(structure, first, second) {
  const a = structure.get(first);
  const b = structure.get(second);
  if (!a || !b || a === b || a.kind !== 'port' || b.kind !== 'port') return null;
  if (!SameType(a.data_type, b.data_type)) return null;
  const ordered = Gives(structure, a, b) && Takes(structure, b, a) ? [a, b]
    : Gives(structure, b, a) && Takes(structure, a, b) ? [b, a]
    : null;
  if (!ordered) return null;
  const [from, to] = ordered;
  const exists = structure.connectionsOf(from.path).some((connection) =>
    connection.from === from.path && connection.to === to.path);
  return exists ? null : { from: from.path, to: to.path };
}

/** All ports that a port may be connected with, those of the same surroundings first. */
export function Partners(structure, path) {
  const partners = [];
  for (const port of structure.ofKind('port')) {
    const ends = Connectable(structure, path, port.path);
    if (ends) partners.push({ port, ends });
  }
  const home = ParentOf(structure.get(path)?.owner ?? '');
  const distance = (entry) => (ParentOf(entry.port.owner) === home || entry.port.owner === home ? 0 : 1);
  return partners.sort((a, b) => distance(a) - distance(b));
}

function SameType(a, b) {
  return a === b || !a || !b;
}

function IsInside(structure, port, other) {
  const owner = structure.get(port.owner);
  return owner !== undefined && IsGroup(owner) && other.owner.startsWith(`${port.owner}/`);
}

function Gives(structure, port, other) {
  return IsInside(structure, port, other) ? port.direction === 'input' : port.direction === 'output';
}

function Takes(structure, port, other) {
  return IsInside(structure, port, other) ? port.direction === 'output' : port.direction === 'input';
}
