// The way that data takes from one module to another.

import { IsGroup, ParentOf } from './structure.js';

/**
 * {from, to, modules}: the outputs between which a latency can be measured, and the modules on the shortest way, or null
 * if none leads there. Both ends are paths of modules, or of their ports; what has no outputs stands for what feeds it.
 */
export function ChainBetween(structure, first, last) {
  const [start, end] = [ModuleOf(structure, first), ModuleOf(structure, last)];
  if (!start || !end || start === end) return null;
  const before = new Map([[start, null]]); // module -> {module, output, input} by which it was reached
  const queue = [start];
  while (queue.length > 0 && !before.has(end)) {
    const module = queue.shift();
    for (const output of Outputs(structure, module)) {
      if (module === start && structure.get(first).kind === 'port' && structure.get(first).direction === 'output' && output !== first) continue;
      for (const input of Ends(structure, output)) {
        const next = structure.get(input).owner;
        if (before.has(next)) continue;
        before.set(next, { module, output });
        queue.push(next);
      }
    }
  }
  if (!before.has(end)) return null;
  const way = [end];
  const outputs = [];
  for (let at = before.get(end); at; at = before.get(at.module)) {
    way.unshift(at.module);
    outputs.unshift(at.output);
  }
  const told = structure.get(last);
  const own = told.kind === 'port' && told.direction === 'output' ? last : Outputs(structure, end)[0];
  const to = own ?? outputs.at(-1);
  return to === outputs[0] ? null : { from: outputs[0], to, modules: way };
}

function ModuleOf(structure, path) {
  const element = structure.get(path);
  if (!element) return null;
  if (element.kind === 'module') return path;
  const owner = element.kind === 'port' ? structure.get(element.owner) : null;
  return owner?.kind === 'module' ? owner.path : null;
}

function Outputs(structure, module) {
  return structure.portsOf(module).filter((port) => port.direction === 'output').map((port) => port.path);
}

/** The inputs of modules that an output feeds, through the ports of groups. */
function Ends(structure, output, seen = new Set()) {
  if (seen.has(output)) return [];
  seen.add(output);
  return structure.connectionsOf(output).filter((connection) => connection.from === output).flatMap(({ to }) => {
    const owner = structure.get(structure.get(to)?.owner ?? ParentOf(to));
    return owner && IsGroup(owner) ? Ends(structure, to, seen) : structure.get(to)?.kind === 'port' ? [to] : [];
  });
}
