// Changes in the text form that the server reads (plugins/structure/change_text.h).

/** A word of a change: quoted if it has to be. */
export function Word(text) {
  const plain = /^[^\s;"\\#{}[\]()=]+$/;
  if (plain.test(text)) return text;
  const escapes = { '"': '\\"', '\\': '\\\\', '\n': '\\n', '\t': '\\t', '\r': '\\r' };
  return `"${text.replace(/["\\\n\t\r]/g, (letter) => escapes[letter])}"`;
}

export const Change = {
  create: (path, type) => `create ${Word(path)} ${Word(type)}`,
  createGroup: (path) => `create group ${Word(path)}`,
  createPort: (path, direction, type) => `create port ${Word(path)} ${direction} ${Word(type)}`,
  delete: (path) => `delete ${Word(path)}`,
  connect: (from, to) => `connect ${Word(from)} ${Word(to)}`,
  disconnect: (from, to) => `disconnect ${Word(from)} ${Word(to)}`,
  set: (path, value) => `set ${Word(path)} ${Word(value)}`,
  replace: (path, type) => `replace ${Word(path)} with ${Word(type)}`,
  move: (path, thread) => `move ${Word(path)} to ${Word(thread)}`,
};

/** A name for a new element that no sibling has: bug2, bug2_2, bug2_3 … */
export function FreeName(structure, group, wanted) {
  const clean = wanted.replace(/.*\//, '').replace(/[^A-Za-z0-9_]/g, '_') || 'module';
  let name = clean;
  for (let number = 2; structure.get(`${group}/${name}`); ++number) name = `${clean}_${number}`;
  return name;
}

/** What is wrong with a name of a new element, or "". */
export function NameProblem(structure, group, name) {
  if (name === '') return 'a name is needed';
  if (/[\s/"\\;#]/.test(name)) return 'a name has no blanks, slashes, quotation marks, semicolons';
  if (structure.get(`${group}/${name}`)) return `there is a '${name}' in ${group} already`;
  return '';
}
