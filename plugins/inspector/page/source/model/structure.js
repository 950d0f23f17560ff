// The application's structure as the page knows it: elements by path, and connections. Messages of
// the server change it; everything else only reads it. No signals here, so that it can be tested and
// measured alone.

export class Structure {
  constructor() {
    this.elements = new Map();    // path -> element, as the server told it, with `children` (paths)
    this.connections = new Map(); // ConnectionKey -> {from, to, queue, on_full, pull}
    this.touching = new Map();    // port path -> Set of keys of connections that begin or end there
    this.ports = new Map();       // owner path -> port paths, in order
    this.parameters = new Map();  // owner path -> parameter paths, in order
    this.revision = 0;
    this.root = null;
    this.below = new Map();       // path -> what the server has told of what cover() shows otherwise, or null
    this.covered = '';            // what cover() shows, as text
    this.hidden = null;           // path of a group without a box
  }

  /** The whole structure: what was known before is forgotten. */
  replaceAll(message) {
    for (const map of [this.elements, this.connections, this.touching, this.ports, this.parameters]) {
      map.clear();
    }
    this.below.clear();
    this.root = null;
    this.#put(message.elements);
    this.#connect(message.connections);
    this.revision = message.revision;
  }

  /** A part of it. */
  change(message) {
    this.#uncover();
    for (const connection of message.disconnected ?? []) this.#disconnect(connection);
    for (const path of message.gone ?? []) this.#remove(path);
    this.#put(message.elements ?? []);
    this.#connect(message.connected ?? []);
    this.revision = message.revision;
  }

  /** Shows elements that `make` makes of it besides, or instead of those of these paths. Whether that is another picture. */
  cover(make, hidden = null) {
    this.#uncover();
    const elements = make(this);
    for (const element of elements) {
      const known = this.elements.get(element.path);
      if (known) this.#exchange({ ...known, ...element });
      else this.#put([element]);
      this.below.set(element.path, known ?? null);
    }
    const covered = JSON.stringify([elements, hidden]);
    const isOther = covered !== this.covered;
    this.covered = covered;
    this.hidden = hidden;
    return isOther;
  }

  #uncover() {
    for (const [path, told] of [...this.below].reverse()) {
      if (told) this.#exchange(told);
      else this.#remove(path);
    }
    this.below.clear();
  }

  #exchange(element) {
    const before = this.elements.get(element.path);
    if (before.owner !== element.owner) {
      Drop(this.ports.get(before.owner), element.path);
      Append(this.ports, element.owner, element.path);
    }
    this.elements.set(element.path, element);
  }

  get(path) {
    return this.elements.get(path);
  }

  portsOf(owner) {
    return (this.ports.get(owner) ?? []).map((path) => this.elements.get(path));
  }

  parametersOf(owner) {
    return (this.parameters.get(owner) ?? []).map((path) => this.elements.get(path));
  }

  connectionsOf(port) {
    return [...(this.touching.get(port) ?? [])].map((key) => this.connections.get(key));
  }

  /** Modules and groups that are drawn inside of a group; containers of ports are no groups. */
  membersOf(group) {
    const element = this.elements.get(group);
    return element ? element.children.filter((path) => this.isNode(path)) : [];
  }

  /** Whether the graph has a box for it. The group that holds the threads has none. */
  isNode(path) {
    const element = this.elements.get(path);
    if (!element || path === this.hidden || element.is_plain || !(element.kind === 'module' || IsGroup(element))) return false;
    const holdsThreads = element.children.length > 0 &&
      element.children.every((child) => this.elements.get(child)?.kind === 'thread');
    return !holdsThreads;
  }

  /** All elements of a kind, in the order of the tree. */
  * ofKind(kind) {
    for (const element of this.elements.values()) {
      if (element.kind === kind) yield element;
    }
  }

  #put(elements) {
    for (const told of elements) {
      const known = this.elements.get(told.path);
      if (known) {
        // In its place, for what is not said of it is not so any more; another object, so that views see it.
        this.elements.set(told.path, { ...told, name: told.name ?? known.name, children: known.children });
        continue;
      }
      const element = { ...told, name: told.name ?? NameOf(told.path), children: [] };
      this.elements.set(element.path, element);
      const parent = this.elements.get(ParentOf(element.path));
      if (parent) parent.children.push(element.path);
      else if (this.root === null) this.root = element.path;
      const list = { port: this.ports, parameter: this.parameters }[element.kind];
      if (list) Append(list, element.owner ?? ParentOf(element.path), element.path);
    }
  }

  #remove(path) {
    const element = this.elements.get(path);
    if (!element) return;
    for (const child of [...element.children]) this.#remove(child);
    for (const connection of this.connectionsOf(path)) this.#disconnect(connection);
    this.elements.delete(path);
    this.ports.delete(path);
    this.parameters.delete(path);
    const owner = element.owner ?? ParentOf(path);
    for (const map of [this.ports, this.parameters]) Drop(map.get(owner), path);
    Drop(this.elements.get(ParentOf(path))?.children, path);
    if (this.root === path) this.root = null;
  }

  #connect(connections) {
    for (const connection of connections) {
      const key = ConnectionKey(connection);
      this.connections.set(key, connection);
      for (const end of [connection.from, connection.to]) {
        if (!this.touching.has(end)) this.touching.set(end, new Set());
        this.touching.get(end).add(key);
      }
    }
  }

  #disconnect(connection) {
    const key = ConnectionKey(connection);
    this.connections.delete(key);
    for (const end of [connection.from, connection.to]) {
      this.touching.get(end)?.delete(key);
    }
  }
}

/** Connections have no path of their own: both ends name one. */
export function ConnectionKey(connection) {
  return `${connection.from} → ${connection.to}`;
}

export function ParentOf(path) {
  return path.slice(0, path.lastIndexOf('/'));
}

export function NameOf(path) {
  return path.slice(path.lastIndexOf('/') + 1);
}

export function IsGroup(element) {
  return element.kind === 'group' || element.kind === 'application';
}

/** Modules, groups, and the ports that groups have for others. */
export function CanBeDeleted(element) {
  return element.kind === 'module' || element.kind === 'group' || (element.kind === 'port' && element.interface);
}

/** The thread that runs an element: its own, or that of the nearest group around it. */
export function ThreadOf(structure, path) {
  for (let at = path; at; at = ParentOf(at)) {
    const thread = structure.get(at)?.thread;
    if (thread) return thread;
  }
  return null;
}

function Append(lists, owner, path) {
  if (!lists.has(owner)) lists.set(owner, []);
  lists.get(owner).push(path);
}

function Drop(list, path) {
  const at = list ? list.indexOf(path) : -1;
  if (at >= 0) list.splice(at, 1);
}
