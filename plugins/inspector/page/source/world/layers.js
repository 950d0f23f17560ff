// What of an application can be drawn in its world: the outputs whose types have a meaning. Knows no
// module and no type by name.

import { IsSource, OriginsOf } from '../model/origin.js';
import { NameOf } from '../model/structure.js';

const kAtFirst = 3; // of a kind that are shown until the user chooses others; an application may have hundreds

// From the bottom to the top of the drawing.
const kDrawable = ['world_map', 'path', 'hit_and_leave_points', 'range_scan', 'drawing', 'point', 'pose', 'contact'];

/**
 * Layers {port, meaning, label, pose, goal, atFirst}; pose: the port that says where it is seen from;
 * atFirst: shown unless the user wants it otherwise.
 */
export function FindLayers(structure, catalogue) {
  const layers = [];
  for (const port of structure.ofKind('port')) {
    if (!IsSource(structure, port)) continue;
    const meaning = catalogue.meaning(port.data_type);
    if (kDrawable.includes(meaning)) {
      layers.push({ port: port.path, meaning, label: `${NameOf(port.owner)}/${port.name}`, owner: port.owner });
    }
  }
  const pose = MainPose(layers);
  for (const layer of layers) {
    if (['range_scan', 'contact', 'drawing'].includes(layer.meaning)) {
      layer.pose = PoseSeenBy(structure, catalogue, layer.owner) ?? pose;
    }
    if (layer.meaning === 'point') layer.goal = GoalParameters(structure, layer);
  }
  const cameras = FindCameras(structure, catalogue, pose);
  const counts = {};
  for (const layer of layers) {
    counts[layer.meaning] = (counts[layer.meaning] ?? 0) + 1;
    layer.atFirst = counts[layer.meaning] <= kAtFirst;
  }
  layers.sort((a, b) => kDrawable.indexOf(a.meaning) - kDrawable.indexOf(b.meaning));
  return { layers, cameras, pose, key: [...layers, ...cameras].map((layer) =>
    `${layer.port} ${layer.pose} ${layer.goal?.x} ${layer.camera?.fov} ${layer.camera?.aspect}`).join('\n') };
}

/** The pose of the robot: that of the module which has the map, or else the first. */
function MainPose(layers) {
  const map = layers.find((layer) => layer.meaning === 'world_map');
  const poses = layers.filter((layer) => layer.meaning === 'pose');
  return (poses.find((layer) => layer.owner === map?.owner) ?? poses[0])?.port ?? null;
}

/** The pose that a module is told, which its measurements belong to; or that it gives itself. */
function PoseSeenBy(structure, catalogue, owner) {
  const poses = structure.portsOf(owner).filter((port) => catalogue.meaning(port.data_type) === 'pose');
  for (const port of poses) {
    const [origin] = OriginsOf(structure, port.path);
    if (origin) return origin;
  }
  return null;
}

/** Where pictures are taken, and how much of the world is on them, if their modules say so by parameters. */
function FindCameras(structure, catalogue, pose) {
  const cameras = [];
  for (const port of structure.ofKind('port')) {
    if (!IsSource(structure, port) || catalogue.meaning(port.data_type) !== 'image') continue;
    const number = (name) => Number(structure.parametersOf(port.owner).find((parameter) => parameter.name === name)?.value);
    const fov = number('field_of_view');
    const from = PoseSeenBy(structure, catalogue, port.owner) ?? pose;
    if (!(fov > 0) || !from) continue;
    const aspect = number('width') / number('height');
    cameras.push({ port: port.path, meaning: 'camera', pose: from, camera: { fov, aspect: aspect > 0 ? aspect : 4 / 3 } });
  }
  return cameras.slice(0, kAtFirst);
}

/** A point <name> can be dragged if its module has the parameters <name>_x and <name>_y. */
function GoalParameters(structure, { port, owner }) {
  const name = NameOf(port);
  const find = (wanted) => structure.parametersOf(owner)
    .find((parameter) => parameter.name === wanted && parameter.settable)?.path;
  const [x, y] = [find(`${name}_x`), find(`${name}_y`)];
  return x && y ? { x, y, name: `${name} of ${NameOf(owner)}` } : null;
}

/** The radius of the robot, if the module that has its pose says so by a parameter. */
export function RobotRadius(structure, posePort) {
  const owner = structure.get(posePort)?.owner;
  const parameter = structure.parametersOf(owner).find(({ name, unit }) => /radius$/.test(name) && unit === 'm');
  const radius = Number(parameter?.value);
  return radius > 0 ? radius : 0.15;
}
