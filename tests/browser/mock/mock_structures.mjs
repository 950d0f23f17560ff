// Applications for the mock: a robot in a room, and one of a thousand modules.

import { ModuleElements } from './mock_application.mjs';

const kTypes = [
  { name: 'double', kind: 'leaf', meaning: '', fields: [] },
  { name: 'Pose2', kind: 'structure', meaning: 'pose', fields: [{ name: 'x', type: 'double', unit: 'm', description: '' },
    { name: 'y', type: 'double', unit: 'm', description: '' }, { name: 'heading', type: 'double', unit: 'rad', description: '' }] },
  { name: 'Point2', kind: 'structure', meaning: 'point', fields: [{ name: 'x', type: 'double', unit: 'm', description: '' }, { name: 'y', type: 'double', unit: 'm', description: '' }] },
  { name: 'Twist2', kind: 'structure', meaning: 'twist', fields: [{ name: 'forward', type: 'double', unit: 'm/s', description: '' }, { name: 'turn', type: 'double', unit: 'rad/s', description: '' }] },
  { name: 'RangeScan', kind: 'structure', meaning: 'range_scan', fields: [{ name: 'ranges', type: 'list', unit: 'm', description: '' }] },
  { name: 'list', kind: 'sequence', meaning: '', element: 'double', fields: [] },
  { name: 'Scene', kind: 'opaque', meaning: '', fields: [] },
  { name: 'WorldMap', kind: 'structure', meaning: 'world_map', fields: [] },
  { name: 'Direction', kind: 'enumeration', meaning: '', values: ['left', 'right'], fields: [] },
];

const kModules = [
  { type: 'mock/world', summary: 'a world with a robot', plugin: 'mock', ports: [
    { name: 'twist', direction: 'input', type: 'Twist2', required: true, driving: true }, { name: 'map', direction: 'output', type: 'WorldMap' }, { name: 'scene', direction: 'output', type: 'Scene' },
    { name: 'pose', direction: 'output', type: 'Pose2' }, { name: 'goal', direction: 'output', type: 'Point2' }],
  parameters: [{ name: 'goal_x', type: 'double', unit: 'm', default: '3' }, { name: 'goal_y', type: 'double', unit: 'm', default: '1' }] },
  { type: 'mock/laser', summary: 'measures distances', plugin: 'mock', ports: [{ name: 'pose', direction: 'input', type: 'Pose2', required: true },
    { name: 'scan', direction: 'output', type: 'RangeScan', pullable: true }], parameters: [] },
  { type: 'mock/planner', summary: 'finds the way', plugin: 'mock', ports: [{ name: 'scan', direction: 'input', type: 'RangeScan', required: true },
    { name: 'goal', direction: 'input', type: 'Point2', required: true }, { name: 'pose', direction: 'input', type: 'Pose2', required: true },
    { name: 'twist', direction: 'output', type: 'Twist2' }],
  parameters: [{ name: 'speed', type: 'double', unit: 'm/s', default: '0.4', minimum: 0.01, maximum: 10, description: 'along the way' },
    { name: 'direction', type: 'Direction', default: 'left' }, { name: 'careful', type: 'bool', default: 'false' },
    { name: 'stubborn', type: 'string', default: 'no' }] },
  { type: 'mock/other_planner', summary: 'finds the way otherwise', plugin: 'mock', ports: [{ name: 'scan', direction: 'input', type: 'RangeScan', required: true },
    { name: 'goal', direction: 'input', type: 'Point2', required: true }, { name: 'pose', direction: 'input', type: 'Pose2', required: true },
    { name: 'twist', direction: 'output', type: 'Twist2' }], parameters: [] },
  { type: 'mock/filter', summary: 'smoothes numbers', plugin: 'mock', ports: [{ name: 'raw', direction: 'input', type: 'double', required: true },
    { name: 'offset', direction: 'input', type: 'double' }, { name: 'smooth', direction: 'output', type: 'double' }],
  parameters: [{ name: 'window', type: 'uint32', default: '5', minimum: 1, maximum: 100 }] },
];

export const kCatalogue = { modules: kModules, types: kTypes };
const Connection = (from, to) => ({ from, to, queue: 0, on_full: 'drop_oldest', pull: false });
const Thread = (root, name, period, order) => ({ path: `${root}/threads/${name}`, kind: 'thread', name, period, priority: 20, order });

export function RobotStructure() {
  const root = '/mock';
  const robot = `${root}/robot`;
  const elements = [
    { path: root, kind: 'application', thread: 'control' }, { path: `${root}/threads`, kind: 'group', is_plain: true },
    Thread(root, 'control', 0.05, 0), Thread(root, 'slow', 0.5, 1),
    ...ModuleElements(kCatalogue, 'mock/world', `${root}/world`), ...ModuleElements(kCatalogue, 'mock/laser', `${root}/laser`),
    { path: robot, kind: 'group', thread: null },
    ...['scan RangeScan', 'pose Pose2', 'goal Point2'].map((words) => {
      const [name, type] = words.split(' ');
      return { path: `${robot}/${name}`, kind: 'port', name, direction: 'input', data_type: type, interface: true, required: false, description: '', owner: robot };
    }),
    { path: `${robot}/twist`, kind: 'port', name: 'twist', direction: 'output', data_type: 'Twist2', interface: true, required: false, description: '', owner: robot },
    ...ModuleElements(kCatalogue, 'mock/planner', `${robot}/planner`),
  ];
  const connections = [
    Connection(`${root}/world/pose`, `${root}/laser/pose`), Connection(`${root}/laser/scan`, `${robot}/scan`),
    Connection(`${root}/world/pose`, `${robot}/pose`), Connection(`${root}/world/goal`, `${robot}/goal`),
    ...['scan', 'pose', 'goal'].map((name) => Connection(`${robot}/${name}`, `${robot}/planner/${name}`)),
    Connection(`${robot}/planner/twist`, `${robot}/twist`), Connection(`${robot}/twist`, `${root}/world/twist`),
  ];
  return { elements, connections };
}

/** Values of the robot: it drives in a circle. `application` is asked for its goal. */
export function RobotValues(application) {
  const heading = (time) => ((time * 0.3) % (2 * Math.PI)) - Math.PI;
  const pose = (time) => ({ x: 2 * Math.sin(time * 0.3), y: -2 * Math.cos(time * 0.3), heading: heading(time) + Math.PI });
  const number = (path) => Number(application().elements.get(path).value);
  return {
    '/mock/world/pose': pose, '/mock/robot/pose': pose, '/mock/laser/pose': pose, '/mock/robot/planner/pose': pose,
    '/mock/world/scene': () => null,
    '/mock/world/goal': () => ({ x: number('/mock/world/goal_x'), y: number('/mock/world/goal_y') }),
    '/mock/robot/planner/twist': (time) => ({ forward: 0.6, turn: 0.3 + 0.05 * Math.sin(time) }),
    '/mock/world/map': () => ({ outlines: [{ points: [{ x: -5, y: -4 }, { x: 5, y: -4 }, { x: 5, y: 4 }, { x: -5, y: 4 }], is_hole: false },
      { points: [{ x: -4.8, y: -3.8 }, { x: 4.8, y: -3.8 }, { x: 4.8, y: 3.8 }, { x: -4.8, y: 3.8 }], is_hole: true }], bounds: [] }),
    '/mock/laser/scan': (time) => ({ start_angle: -1.57, angle_step: 0.05, range_minimum: 0.02, range_maximum: 4,
      ranges: Array.from({ length: 63 }, (_, i) => 2 + Math.sin(i * 0.3 + time)) }),
  };
}

/** `groups` groups of `each` filters in chains, with connections across; two connections a module and more. */
export function LargeStructure(groups = 40, each = 25) {
  const root = '/large';
  const elements = [{ path: root, kind: 'application', thread: 'control' }, { path: `${root}/threads`, kind: 'group', is_plain: true },
    Thread(root, 'control', 0.05, 0), Thread(root, 'slow', 0.5, 1), Thread(root, 'fast', 0.001, 2)];
  const connections = [];
  const threads = [null, 'slow', 'fast'];
  const filter = (group, number) => `${root}/group_${group}/filter_${number}`;
  for (let group = 0; group < groups; ++group) {
    const path = `${root}/group_${group}`;
    elements.push({ path, kind: 'group', thread: threads[group % 3] });
    for (const [name, direction] of [['entry', 'input'], ['exit', 'output']]) {
      elements.push({ path: `${path}/${name}`, kind: 'port', name, direction, data_type: 'double', interface: true, required: false, description: '', owner: path });
    }
    for (let number = 0; number < each; ++number) {
      elements.push(...ModuleElements(kCatalogue, 'mock/filter', filter(group, number)));
      connections.push(Connection(number === 0 ? `${path}/entry` : `${filter(group, number - 1)}/smooth`, `${filter(group, number)}/raw`));
      const other = number < 3 ? `${path}/entry` : `${filter(group, number - 3)}/smooth`;
      connections.push(Connection(other, `${filter(group, number)}/offset`));
    }
    connections.push(Connection(`${filter(group, each - 1)}/smooth`, `${path}/exit`));
    if (group > 0) connections.push(Connection(`${root}/group_${Math.floor((group - 1) / 2)}/exit`, `${path}/entry`));
  }
  return { elements, connections };
}
