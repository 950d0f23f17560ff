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
  const ordered = Gives(structure, a, b) && Takes(structure, b, a) ? [a, b]
    : Gives(structure, b, a) && Takes(structure, a, b) ? [b, a]
    : null;
  if (!ordered) return null;
  const [from, to] = ordered;
  if (!Becomes(from.data_type, to.data_type)) return null;
  const exists = structure.connectionsOf(from.path).some((connection) =>
    connection.from === from.path && connection.to === to.path);
  return exists ? null : { from: from.path, to: to.path };
}

/** The two ends if nothing but their types is in the way, so that a part or a conversion may help; else null. */
export function OnlyTypesDiffer(structure, first, second) {
  const [a, b] = [structure.get(first), structure.get(second)];
  if (!a || !b || a === b || a.kind !== 'port' || b.kind !== 'port' || Connectable(structure, first, second)) return null;
  const [from, to] = Gives(structure, a, b) ? [a, b] : [b, a];
  if (!Gives(structure, from, to) || !Takes(structure, to, from) || Becomes(from.data_type, to.data_type)) return null;
  return { from: from.path, to: to.path };
}

/** Why two ports cannot be connected, or "" if they can: for people. */
export function WhyNot(structure, first, second) {
  if (Connectable(structure, first, second)) return '';
  const [a, b] = [structure.get(first), structure.get(second)];
  if (!a || !b) return 'one of them is gone';
  const name = (port) => `${structure.get(port.owner)?.name ?? ''}/${port.name}`;
  const [from, to] = Gives(structure, a, b) ? [a, b] : [b, a];
  if (!Gives(structure, from, to)) return `both ${name(a)} and ${name(b)} take values`;
  if (!Takes(structure, to, from)) return `both ${name(a)} and ${name(b)} give values`;
  if (!Becomes(from.data_type, to.data_type)) return `${name(from)} gives ${from.data_type}, ${name(to)} takes ${to.data_type}`;
  return `${name(from)} and ${name(to)} are connected already`;
}

/** Those that it may be connected with if there is a part of the values, or a conversion, that suits. */
export function OtherPartners(structure, path) {
  const partners = [];
  for (const port of structure.ofKind('port')) {
    const ends = OnlyTypesDiffer(structure, path, port.path);
    if (ends) partners.push({ port, ends, differs: true });
  }
  return partners;
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

// How many bits a number has for its digits; a sign is one more.
const kDigits = { bool: 1, int8: 7, int16: 15, int32: 31, int64: 63, uint8: 8, uint16: 16, uint32: 32, uint64: 64, float: 24, double: 53 };

/** Whether values are of one type, or become the other's without being told how. */
function Becomes(from, to) {
  if (from === to || !from || !to || to === 'signal' || to === 'string') return true;
  if (!(from in kDigits) || !(to in kDigits)) return false;
  const isWhole = to !== 'float' && to !== 'double';
  const isSigned = from.startsWith('int') || from === 'float' || from === 'double';
  if (isWhole && (from === 'float' || from === 'double' || (isSigned && !to.startsWith('int')))) return false;
  return kDigits[from] <= kDigits[to];
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
