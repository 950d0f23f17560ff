// Sorts what is to be drawn into levels: each open group shows its members, and the connections
// between them. A connection belongs to the innermost group that holds both of its ends.

import { IsGroup, ParentOf } from '../model/structure.js';

export const kInside = '@in';   // the inputs of the group itself, seen from inside
export const kOutside = '@out'; // its outputs

/** What all levels have, whether their groups are open or not: Map group -> [{key, from, to, source, target}]. */
export function ConnectionsByLevel(structure) {
  const levels = new Map();
  for (const [key, connection] of structure.connections) {
    const place = PlaceOf(structure, connection);
    if (!place) continue;
    if (!levels.has(place.level)) levels.set(place.level, []);
    levels.get(place.level).push({ key, ...connection, source: place.source, target: place.target });
  }
  return levels;
}

/** Where a connection is drawn: its level, and the members of the level that it connects. */
export function PlaceOf(structure, connection) {
  const from = structure.get(connection.from)?.owner;
  const to = structure.get(connection.to)?.owner;
  if (!from || !to) return null;
  const isLoop = structure.get(connection.from).direction === 'output'; // around the group, if it is one of its own
  if (from === to && IsGroup(structure.get(from)) && !isLoop) return { level: from, source: kInside, target: kOutside };
  if (to.startsWith(`${from}/`)) return { level: from, source: kInside, target: MemberOn(structure, to, from) };
  if (from.startsWith(`${to}/`)) return { level: to, source: MemberOn(structure, from, to), target: kOutside };
  let level = ParentOf(from);
  while (level && !to.startsWith(`${level}/`)) level = ParentOf(level);
  if (!level) return null;
  return { level, source: MemberOn(structure, from, level), target: MemberOn(structure, to, level) };
}

/** The member of a group that a path leads through. */
function MemberOn(structure, path, group) {
  let at = path;
  while (ParentOf(at) !== group) at = ParentOf(at);
  return at;
}

/** The paths of connections that close a circle, if members are walked through in their order. */
export function ClosingEdges(members, edges) {
  const next = new Map(members.map((member) => [member, []]));
  for (const edge of edges) next.get(edge.source)?.push(edge.target);
  const state = new Map(); // 1: on the way, 2: done
  const closing = new Set();
  for (const start of members) {
    if (state.has(start)) continue;
    const way = [{ at: start, index: 0 }];
    state.set(start, 1);
    while (way.length > 0) {
      const top = way[way.length - 1];
      const targets = next.get(top.at);
      if (top.index === targets.length) {
        state.set(top.at, 2);
        way.pop();
        continue;
      }
      const target = targets[top.index++];
      if (state.get(target) === 1) closing.add(`${top.at} ${target}`);
      else if (next.has(target) && !state.has(target)) {
        state.set(target, 1);
        way.push({ at: target, index: 0 });
      }
    }
  }
  return closing;
}

/** Whether an end of a connection lies deeper than in a member of its level. */
export function IsDistant(structure, connection) {
  const isDeep = (member, port) => member[0] === '/' && structure.get(port).owner !== member;
  return isDeep(connection.source, connection.from) || isDeep(connection.target, connection.to);
}
