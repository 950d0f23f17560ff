// Changes as the server reads them (PROTOCOL.md).

export const Change = {
  create: (path, type, settings) => ({ change: 'create', path, type, ...Given(settings) }),
  createGroup: (path) => ({ change: 'create_group', path }),
  createPort: (path, direction, type) => ({ change: 'create_port', path, direction, type }),
  rename: (path, name) => ({ change: 'rename', path, name }),
  delete: (path) => ({ change: 'delete', path }),
  connect: (from, to, options = {}) => ({ change: 'connect', from, to, ...options }),
  disconnect: (from, to) => ({ change: 'disconnect', from, to }),
  set: (path, value) => ({ change: 'set', path, value }),
  replace: (path, type, settings) => ({ change: 'replace', path, type, ...Given(settings) }),
  createThread: (path, options = {}) => ({ change: 'create_thread', path, ...options }),
  schedule: (path, options) => ({ change: 'schedule', path, ...options }),
  tag: (path, tags) => ({ change: 'tag', path, tags }),
  offer: (path, settings) => ({ change: 'offer', port: path, settings }),
  take: (topic, path, settings) => ({ change: 'take', topic, port: path, settings }),
  move: (path, thread) => ({ change: 'move', path, thread }),
};

const Given = (settings) => (Object.keys(settings ?? {}).length > 0 ? { settings } : {});

/** A name for a new element that no sibling has: bug2, bug2_2, bug2_3 … */
export function FreeName(structure, group, wanted) {
  const clean = wanted.replace(/.*\//, '').replace(/[^A-Za-z0-9_]/g, '_') || 'module';
  let name = clean;
  for (let number = 2; structure.get(`${group}/${name}`); ++number) name = `${clean}_${number}`;
  return name;
}

/**
 * What is wrong with a name of a new element, or "": the rule of core/element/element_path.h, told while
 * it is typed. The server asks again.
 */
export function NameProblem(structure, group, name) {
  if (name === '') return 'a name is needed';
  if (name === '.' || name === '..') return `the name '${name}' is reserved`;
  if (/[ \t\r\n/,]/.test(name)) return 'a name has no blanks, slashes, commas';
  // A lone half of a surrogate pair has no UTF-8.
  if (/[\u0000-\u001f\u007f-\u009f\ufffe\uffff]|\p{Surrogate}/u.test(name)) {
    return 'a name has no control characters';
  }
  if (structure.get(`${group}/${name}`)) return `there is a '${name}' in ${group} already`;
  return '';
}
