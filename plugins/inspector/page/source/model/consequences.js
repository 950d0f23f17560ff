// What a change would take away from others: the inputs that would be without a source, and the modules
// that live on what comes through them.

import { IsGroup } from './structure.js';
import { OriginsOf } from './origin.js';

/**
 * What follows if elements (`gone`: paths, with all that is in them) and connections (`cut`: {from, to}) go:
 * {inputs: [port], dependents: [path of a module], isGrave}. `inputs` have a source now and none then;
 * `dependents` are modules further on that need what these modules publish; grave: something required is
 * among them.
 */
export function ConsequencesOf(structure, { gone = [], cut = [] }) {
  const isGone = (path) => gone.some((each) => path === each || path.startsWith(`${each}/`));
  const isCut = ({ from, to }) => isGone(from) || isGone(to) || cut.some((each) => each.from === from && each.to === to);
  const left = { get: (path) => structure.get(path),
    connectionsOf: (path) => structure.connectionsOf(path).filter((connection) => !isCut(connection)) };
  const inputs = [];
  for (const port of structure.ofKind('port')) {
    if (!IsInputOfModule(structure, port) || port.by_hand || isGone(port.path)) continue;
    if (OriginsOf(left, port.path).length === 0 && OriginsOf(structure, port.path).length > 0) inputs.push(port);
  }
  inputs.sort((a, b) => Number(b.required) - Number(a.required));
  const starved = new Set(inputs.filter((port) => port.required || HasNoSource(left, structure, port.owner))
    .map((port) => port.owner));
  const dependents = Dependents(structure, left, starved);
  return { inputs, dependents, isGrave: dependents.length > 0 || inputs.some((port) => port.required) };
}

function IsInputOfModule(structure, port) {
  return port.direction === 'input' && structure.get(port.owner)?.kind === 'module';
}

function HasNoSource(left, structure, module) {
  return structure.portsOf(module).every((port) => port.direction !== 'input' || OriginsOf(left, port.path).length === 0);
}

/** The modules that required inputs lead to, from those that get nothing any more, nearest first. */
function Dependents(structure, left, starved) {
  const found = new Set(starved);
  const order = [...starved];
  for (let at = 0; at < order.length; ++at) {
    for (const port of structure.portsOf(order[at])) {
      if (port.direction !== 'output') continue;
      for (const reader of Readers(structure, left, port.path)) {
        if (!reader.required || found.has(reader.owner)) continue;
        found.add(reader.owner);
        order.push(reader.owner);
      }
    }
  }
  return order.slice(starved.size);
}

/** The inputs of modules that an output feeds, through the ports of groups. */
function Readers(structure, left, path, seen = new Set()) {
  if (seen.has(path)) return [];
  seen.add(path);
  return left.connectionsOf(path).filter((connection) => connection.from === path).flatMap(({ to }) => {
    const port = structure.get(to);
    const owner = structure.get(port?.owner);
    if (!owner) return [];
    return IsGroup(owner) ? Readers(structure, left, to, seen) : [port];
  });
}
