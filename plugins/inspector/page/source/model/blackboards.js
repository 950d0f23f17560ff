// Which ports are blackboards (plugins/blackboards): an output beside the service that changes it.

const kReply = 'CommitReply';

/** {value, changes, readers, writers} of the blackboard that a port belongs to, all paths; null if to none. */
export function BlackboardOf(structure, path) {
  const ends = path.endsWith('_changes') ? [path.slice(0, -'_changes'.length), path] : [path, `${path}_changes`];
  const [value, changes] = ends.map((each) => structure.get(each));
  if (!value || changes?.service?.reply !== kReply) return null;
  const modulesBehind = (port) => [...new Set(structure.connectionsOf(port).filter((each) => each.from === port)
    .map((each) => structure.get(each.to)?.owner).filter(Boolean))];
  const writers = modulesBehind(changes.path);
  return { value: value.path, changes: changes.path, writers, readers: modulesBehind(value.path).filter((each) => !writers.includes(each)) };
}
