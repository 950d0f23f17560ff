// An application that is none: a structure, values that go by a clock of its own, and changes. For
// what a real one cannot show on demand: a thousand modules, a server that refuses, one that is gone and comes again.

export class MockApplication {
  constructor({ name = 'mock', structure, catalogue, values = {} }) {
    this.name = name;
    this.catalogue = catalogue;
    this.values = values; // port path -> function of time
    this.elements = new Map(structure.elements.map((element) => [element.path, element]));
    this.connections = [...structure.connections];
    this.revision = 1;
    this.layout = {}; // what viewers have arranged
    this.panel = '';  // the operator's, as it is saved
    this.delay = 0;   // ms, before the structure is told
    this.isFrozen = false; // says nothing any more, and what is asked waits
    this.saidAt = null; // it is frozen, and a slow network still brings what it said then (s of the machine's time); null: it is not
    this.asked = [];  // all requests
    this.cut = new Set();  // ports of which no page gets a whole value
    this.overruns = {};    // thread path -> how many there have been
    this.stop = { in_force: false, by: '', since: 0 };
    this.drivesBeside = []; // names of what leaves over a network and drives
    this.unreached = [];    // {path, why}: driving ports that no STOP reaches; null: the structure is being changed, nobody can tell
    this.isBraking = false; // while STOP is in force
    this.isUnheard = false; // connections open, and bear no sign of life
    this.isOwnSilent = false; // those of the STOP give no sign of life, and answer
    this.isOwnDeaf = false;   // they do not even read
    this.isHanging = false; // the main connections say nothing more, those of the STOP do
    this.answers = {}; // op -> function (reply, message, socket), in the place of the mock's own answer
    this.time = 0;
    this.paused = false;
    this.speed = 1;
    this.past = [];
    this.future = [];
    this.log = [{ number: 1, time: 0, kind: 'change', text: 'the mock began' }];
  }

  get structure() {
    return { elements: [...this.elements.values()], connections: this.connections };
  }

  get state() {
    return { time: this.time, paused: this.paused, speed: this.speed, faults: 0, ended: false,
      undo: this.past.at(-1)?.label ?? null, redo: this.future.at(-1)?.label ?? null,
      undo_client: this.past.at(-1)?.client ?? null, redo_client: this.future.at(-1)?.client ?? null };
  }

  /** All changes or none; returns errors. What is new is told by `difference`. */
  change(changes, label = LabelOf(changes), client = 'a terminal') {
    const before = this.#snapshot();
    for (const [index, change] of changes.entries()) {
      const error = this.#apply(change);
      if (error) {
        this.#restore(before);
        return [{ ...error, change: index }];
      }
    }
    this.past.push({ label, client, state: before });
    this.future = [];
    this.log.push({ number: this.log.length + 1, time: this.time, kind: 'change', text: label });
    return [];
  }

  travel(from, to) {
    const step = from.pop();
    if (!step) return null;
    to.push({ label: step.label, client: step.client, state: this.#snapshot() });
    this.#restore(step.state);
    return step;
  }

  /** What has changed since an earlier structure, as the protocol tells it. */
  difference(before) {
    const key = (connection) => JSON.stringify(connection);
    const old = new Map(before.elements.map((element) => [element.path, element]));
    const had = new Set(before.connections.map(key));
    const has = new Set(this.connections.map(key));
    return {
      op: 'structure_change', revision: ++this.revision,
      gone: [...old.keys()].filter((path) => !this.elements.has(path)),
      elements: [...this.elements.values()].filter((element) => old.get(element.path) !== element),
      connected: this.connections.filter((connection) => !had.has(key(connection))),
      disconnected: before.connections.filter((connection) => !has.has(key(connection))),
    };
  }

  #snapshot() {
    return { elements: [...this.elements.values()], connections: this.connections };
  }

  #restore({ elements, connections }) {
    this.elements = new Map(elements.map((element) => [element.path, element]));
    this.connections = connections;
  }

  #apply({ change, path, value, from, to, pull = false, queue = 0, on_full = 'drop_oldest', type, thread, name, direction, settings = {} }) {
    const missing = [path, from, to].find((each) =>
      each !== undefined && !this.elements.has(each) && !change.startsWith('create'));
    if (missing) return { message: `there is no '${missing}'`, path: missing, hint: '' };
    if (change === 'set') {
      const parameter = this.elements.get(path);
      if (parameter.name === 'stubborn') {
        return { message: `'${value}' is not to its taste`, path, hint: 'try 7' };
      }
      this.elements.set(path, { ...parameter, value });
    } else if (change === 'connect') {
      this.connections = [...this.connections, { from, to, queue, on_full, pull }];
    } else if (change === 'disconnect') {
      this.connections = this.connections.filter((each) => each.from !== from || each.to !== to);
    } else if (change === 'delete') {
      const isIn = (each) => each === path || each.startsWith(`${path}/`);
      this.connections = this.connections.filter((each) => !isIn(each.from) && !isIn(each.to));
      for (const each of [...this.elements.keys()]) if (isIn(each)) this.elements.delete(each);
    } else if (change === 'rename') {
      const next = `${path.slice(0, path.lastIndexOf('/'))}/${name}`;
      const put = (each) => (each === path || each?.startsWith(`${path}/`) ? next + each.slice(path.length) : each);
      this.elements = new Map([...this.elements.values()].map((each) => (put(each.path) === each.path ? each
        : { ...each, path: put(each.path), owner: put(each.owner), ...(each.path === path ? { name } : {}) })).map((each) => [each.path, each]));
      this.connections = this.connections.map((each) => (put(each.from) + put(each.to) === each.from + each.to ? each
        : { ...each, from: put(each.from), to: put(each.to) }));
    } else if (change === 'create_group') {
      this.elements.set(path, { path, kind: 'group', thread: null });
    } else if (change === 'create_port') {
      const owner = path.slice(0, path.lastIndexOf('/'));
      this.elements.set(path, { path, kind: 'port', name: path.slice(owner.length + 1), direction, data_type: type, interface: true,
        required: false, description: '', owner });
    } else if (change === 'create') {
      for (const element of ModuleElements(this.catalogue, type, path)) {
        const value = settings[element.name];
        this.elements.set(element.path, element.kind === 'parameter' && value !== undefined ? { ...element, value } : element);
      }
    } else if (change === 'move') {
      this.elements.set(path, { ...this.elements.get(path), thread: thread || null });
    } else if (change === 'replace') {
      const { summary } = this.catalogue.modules.find((module) => module.type === type);
      this.elements.set(path, { ...this.elements.get(path), type, summary });
    } else {
      return { message: `the mock knows no '${change}'`, path: '', hint: '' };
    }
    return null;
  }
}

function LabelOf([{ change, path, value, from, to, type, name }]) {
  return [change, path ?? from, value ?? to ?? type ?? name].filter((word) => word !== undefined).join(' ');
}

/** A module as the catalogue has it, with its ports and parameters. */
export function ModuleElements(catalogue, type, path, { thread = null } = {}) {
  const module = catalogue.modules.find((candidate) => candidate.type === type);
  if (!module) throw new Error(`the mock has no module type '${type}'`);
  const elements = [{ path, kind: 'module', type, summary: module.summary, thread, failure: null }];
  for (const port of module.ports) {
    elements.push({ path: `${path}/${port.name}`, kind: 'port', name: port.name, direction: port.direction,
      data_type: port.type, interface: false, required: port.required ?? false, pullable: port.pullable ?? false,
      description: '', owner: path, ...(port.driving ? { driving: true, moves: true } : {}) });
  }
  for (const parameter of module.parameters) {
    elements.push({ path: `${path}/${parameter.name}`, kind: 'parameter', name: parameter.name, data_type: parameter.type,
      unit: parameter.unit ?? '', minimum: parameter.minimum ?? null, maximum: parameter.maximum ?? null,
      description: parameter.description ?? '', value: parameter.default, default: parameter.default, settable: true, owner: path });
  }
  return elements;
}
