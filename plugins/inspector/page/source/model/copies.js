// Copies of modules and groups, as changes that make them again under other names.

import { Change, FreeName } from './changes.js';
import { ConnectionKey, IsGroup, NameOf } from './structure.js';

/** What is needed to make elements again: {roots, parts, connections}; `root` of a part is the
 * path that it was copied with. Those within others are left out. */
export function CopyOf(structure, paths) {
  const roots = Outermost(paths).filter((path) => structure.isNode(path) && path !== structure.root);
  const parts = roots.flatMap((root) => PartsOf(structure, root));
  const rootOf = (port) => roots.find((root) => port.startsWith(`${root}/`));
  const keys = new Map();
  for (const root of roots) {
    for (const port of structure.ofKind('port')) {
      if (!port.path.startsWith(`${root}/`)) continue;
      for (const connection of structure.connectionsOf(port.path)) {
        const [from, to] = [rootOf(connection.from), rootOf(connection.to)];
        if (!from || !to) continue;
        keys.set(ConnectionKey(connection), { ...connection, from: [from, connection.from.slice(from.length)],
          to: [to, connection.to.slice(to.length)] });
      }
    }
  }
  return { roots: roots.map((root) => ({ name: NameOf(root), path: root })), parts, connections: [...keys.values()] };
}

/** The changes that put a copy into a group, and the paths of what is new there: {changes, paths}. */
export function PasteChanges(structure, copy, group) {
  const names = new Map();
  const used = new Set();
  for (const { name, path } of copy.roots) {
    let free = FreeName(structure, group, name);
    for (let number = 2; used.has(free); ++number) free = FreeName(structure, group, `${name}_${number}`);
    used.add(free);
    names.set(path, free);
  }
  const place = (root, rest) => `${group}/${names.get(root)}${rest}`;
  const changes = copy.parts.map(({ root, rest, kind, type, settings, direction }) => {
    const path = place(root, rest);
    if (kind === 'module') return Change.create(path, type, settings);
    return kind === 'port' ? Change.createPort(path, direction, type) : Change.createGroup(path);
  });
  for (const { root, rest, thread } of copy.parts) if (thread) changes.push(Change.move(place(root, rest), thread));
  for (const { from, to, part, convert, queue, on_full: onFull, pull, when_present: whenPresent, late } of copy.connections) {
    const options = { pull, late, when_present: whenPresent, ...(convert ? { convert } : {}), ...(queue > 0 ? { queue, on_full: onFull } : {}) };
    changes.push(Change.connect(place(...from) + (part ? `.${part}` : ''), place(...to), options));
  }
  return { changes, paths: copy.roots.map(({ path }) => place(path, '')) };
}

/** The paths that lie within none of the others. */
export function Outermost(paths) {
  return paths.filter((path) => !paths.some((other) => path.startsWith(`${other}/`)));
}

function PartsOf(structure, root) {
  const parts = [];
  const walk = (path) => {
    const element = structure.get(path);
    const at = { root, rest: path.slice(root.length), thread: element.thread ?? null };
    if (element.kind === 'module') return parts.push({ ...at, kind: 'module', type: element.type, settings: SettingsOf(structure, path) });
    if (!IsGroup(element)) return undefined;
    parts.push({ ...at, kind: 'group' });
    for (const port of structure.portsOf(path)) {
      parts.push({ root, rest: port.path.slice(root.length), kind: 'port', type: port.data_type, direction: port.direction });
    }
    for (const member of structure.membersOf(path)) walk(member);
    return undefined;
  };
  walk(root);
  return parts;
}

function SettingsOf(structure, module) {
  return Object.fromEntries(structure.parametersOf(module)
    .filter(({ value, default: usual }) => value !== null && value !== undefined && value !== usual)
    .map(({ name, value }) => [name, value]));
}
