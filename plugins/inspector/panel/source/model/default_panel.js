// The panel of an application for which nobody has made one: what suits its ports. Knows no module and no type by
// name, but by what types mean.

import { OriginsOf } from '../../../page/source/model/origin.js';
import { IsGroup } from '../../../page/source/model/structure.js';
import { FindLayers } from '../../../page/source/world/layers.js';
import { kDrivesAtFirst } from './kinds.js';
import { AxesOf } from './twist.js';

/**
 * The inputs at which the robot can be driven, the best first: where what plans the way hands over, so that what
 * comes behind it, a gate, limits, goes on watching over whoever drives.
 */
export function DrivableInputs(structure, catalogue) {
  const found = [];
  for (const port of structure.ofKind('port')) {
    const owner = structure.get(port.owner);
    if (port.direction !== 'input' || !owner || IsGroup(owner) || !AxesOf(catalogue, port.data_type)) continue;
    if (catalogue.meaning(port.data_type) !== 'twist') continue;
    const [origin] = OriginsOf(structure, port.path);
    const passesOn = origin && structure.portsOf(structure.get(origin).owner)
      .some((each) => each.direction === 'input' && each.data_type === port.data_type);
    found.push({ port, rank: !origin ? 2 : passesOn ? 1 : 0 });
  }
  return found.sort((a, b) => a.rank - b.rank).map(({ port }) => port);
}

/** The widgets. */
export function DefaultPanel(structure, catalogue) {
  const { layers, pose } = FindLayers(structure, catalogue);
  const [drive] = DrivableInputs(structure, catalogue);
  const measured = MeasuredTwist(structure, catalogue, pose);
  const planner = drive ? structure.get(OriginsOf(structure, drive.path)[0])?.owner : null;
  const side = layers.length > 0 ? 8 : 0;
  const widgets = [];
  const put = (id, kind, x, y, w, h, settings = {}) => widgets.push({ id, kind, x, y, w, h, ...settings });
  let below = 0;
  if (layers.length > 0) put('map', 'map', 0, 0, 8, 10);
  if (measured) {
    const { port, axes } = measured;
    put('speed', 'gauge', side, 0, 2, 4, { title: 'Speed', target: port.path, field: axes.forward, minimum: -0.5, maximum: 0.5 });
    put('turning', 'gauge', side + 2, 0, 2, 4, { title: 'Turning', target: port.path, field: axes.turn, minimum: -1.5, maximum: 1.5 });
    put('plot', 'plot', 0, layers.length > 0 ? 10 : 4, layers.length > 0 ? 8 : 4, 4, { title: 'Speed',
      curves: [{ target: port.path, field: axes.forward }, ...(drive ? [{ target: drive.path, field: axes.forward }] : [])] });
    below = 4;
  }
  if (drive) {
    put('joystick', 'joystick', side, below, 4, 6, { target: drive.path, ...kDrivesAtFirst });
    below += 6;
  }
  const camera = PicturePort(structure, catalogue);
  if (camera) {
    put('image', 'image', side, below, 4, 6, { title: 'Camera', target: camera.path });
    below += 6;
  }
  const speed = structure.parametersOf(planner).find((each) => each.settable && each.unit === 'm/s' &&
    each.minimum !== null && each.maximum !== null);
  if (speed) put('slider', 'slider', side, below, 4, 2, { target: speed.path });
  return widgets;
}

/** What a module shows of what it sees. */
function PicturePort(structure, catalogue) {
  return [...structure.ofKind('port')].find((port) => port.direction === 'output' && catalogue.meaning(port.data_type) === 'image' &&
    structure.get(port.owner) && !IsGroup(structure.get(port.owner)));
}

/** How the robot really moves, as the module says that knows where it is. */
function MeasuredTwist(structure, catalogue, pose) {
  const owner = structure.get(pose)?.owner;
  for (const port of owner ? structure.portsOf(owner) : []) {
    const axes = port.direction === 'output' ? AxesOf(catalogue, port.data_type) : null;
    if (axes) return { port, axes };
  }
  return null;
}
