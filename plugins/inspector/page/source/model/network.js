// Other applications in the network, as boxes among the modules: what they offer is their ports, an input here is
// connected to it as to any other.

const kBox = '@'; // no name of an element begins so in files of people

export const kFarDetail = 'in the network, 10.00 ms'; // as wide as any

/** Whether the element is another application, or a port of one. */
export const IsFar = (element) => element?.far === true;

/** Whether what another one offers are messages of ROS 2, and no values of Runnel. */
export const IsMessage = (port) => IsFar(port) && port.data_type.includes('/msg/');

/** "//planner/planner/twist" of a topic. */
export const FarPath = (topic) => `/${topic}`;

/** "/robot/pose" of "//robot/pose.x"; null of what is a port here. */
const FarTopic = (path) => (path.startsWith('//') ? path.slice(1).replace(/(\/[^/.[]+)[.[][^/]*$/, '$1') : null);

/**
 * What the structure has besides, because of a message of the network: elements. An output by which something is taken
 * becomes a port of the application that offers it.
 */
export function NetworkElements(structure, network) {
  const elements = new Map();
  const root = structure.root;
  if (!network || !root) return [];
  const all = network.applications ?? [];
  const applications = new Map(all.filter(({ name }) => name).map((each) => [each.name, each]));
  const taken = new Set();
  const others = new Set(all.filter(({ name }) => !name).flatMap(({ offers }) => offers.map(({ topic }) => topic))); // of nodes of ROS 2
  const boxOf = (topic) => {
    const word = topic.split('/')[1];
    const isKnown = !others.has(topic) && (applications.has(word) || topic.split('/').length > 2);
    const name = isKnown ? word : 'topics';
    const path = `${root}/${kBox}${name}`;
    if (!elements.has(path)) {
      elements.set(path, { path, kind: 'application', far: true, name: isKnown ? `//${name}` : name, is_there: !isKnown || applications.has(word),
        delay: applications.get(word)?.delay ?? null, structure: applications.get(word)?.structure ?? '' });
    }
    return path;
  };
  const short = (topic, box) => (box.endsWith(`${kBox}topics`) ? topic.slice(1) : topic.slice(topic.indexOf('/', 1) + 1));
  const addPort = (topic, type, state) => {
    const owner = boxOf(topic);
    const path = FarPath(topic);
    elements.set(path, { path, kind: 'port', far: true, owner, name: short(topic, owner), direction: 'output', data_type: type, topic,
      interface: false, required: false, description: '', unit: '', awaits: [], state });
  };
  for (const name of applications.keys()) boxOf(`/${name}/x`);
  for (const take of network.takes ?? []) {
    const port = structure.get(take.port);
    if (!port || !take.is_wanted) continue;
    taken.add(take.topic);
    const owner = boxOf(take.topic);
    elements.set(take.port, { ...port, far: true, owner, name: short(take.topic, owner), topic: take.topic, state: StateOf(take),
      misfit: take.misfit, master: take.owner });
  }
  for (const { offers } of all) {
    for (const { topic, type } of offers) {
      if (taken.has(topic)) continue;
      addPort(topic, type, 'offered');
    }
  }
  for (const { awaits, direction } of structure.ofKind('port')) {
    for (const awaited of (direction === 'input' && awaits) || []) {
      const topic = FarTopic(awaited.from);
      if (topic === null || taken.has(topic)) continue;
      if (!elements.has(FarPath(topic))) addPort(topic, '', 'waiting');
      elements.get(FarPath(topic)).awaits.push(awaited);
    }
  }
  for (const offer of network.offers ?? []) {
    const port = structure.get(offer.port);
    if (!port) continue;
    const known = elements.get(offer.port) ?? { ...port, offers: [] };
    elements.set(offer.port, { ...known, offers: [...known.offers, offer] });
  }
  return [...elements.values()];
}

/** "connected", "waiting" or "other type". */
function StateOf({ misfit, writers }) {
  if (writers.length > 0) return 'connected';
  return misfit ? 'does not fit' : 'waiting';
}

/** How far an application's clock seems to be off, for people. */
export function DelayText(delay) {
  if (delay === null || delay === undefined) return '';
  const milliseconds = delay * 1000;
  return `${Math.abs(milliseconds) < 10 ? milliseconds.toFixed(2) : Math.round(milliseconds)} ms`;
}

