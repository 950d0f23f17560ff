// The layout of the graph: boxes and curves with absolute places, of what is open only. Levels are
// laid out alone, inner ones first, and kept: a change makes anew its own level and those around it.

import { IsGroup } from '../model/structure.js';
import { BowPath, ForwardPath } from './edge_path.js';
import { ClosingEdges, ConnectionsByLevel, IsDistant, kInside, kOutside } from './levels.js';
import { LevelLayout } from './level_layout.js';
import { kFarDetail } from '../model/network.js';
import { BoxSize, NoteLines, PortHeight, kBars, kPicture } from './measure.js';
import { PlacedLevel } from './placed_level.js';

const kPatience = 250; // effort (EffortOf) at once: dagre takes half a second for as much, and nothing is drawn or sent meanwhile
const kParts = [0.9, 0.62, 0.4]; // of the window's width: how wide open groups may be
const kFew = 100;      // effort; with more of it only one width is tried
const kMany = 60;      // members of a group
const kWorthIt = 1.04;
const kNowhere = () => undefined;
const kRateWidth = 40; // of the rate beside the ports of the last box

export class GraphLayout {
  #kept = new Map(); // group -> {signature, layout}
  #placeOf = kNowhere; // path -> where it has been put by hand
  #noteOf = kNowhere;  // path -> note on it
  #isPictured = () => false;
  #hasBars = () => false;
  #placed = 0;       // the effort of what dagre has placed in this computation

  /**
   * {boxes: Map path -> box, edges: [edge], width, height}.
   * box:  {path, element, x, y, width, height, depth, open, inputs, outputs, hidden}; hidden: number of
   *       modules in a folded group
   * edge: {key, from, to, start, end, path, left, top, right, bottom, depth}
   * `isPictured(path)`: the box has room for what its module draws; `hasBars(path)`: for how a behaviour is.
   * ports: Map port path -> {x, y, side}
   */
  compute(structure, isOpen, { area = null, placeOf = kNowhere, noteOf = kNowhere, isPictured = () => false, hasBars = () => false } = {}) {
    this.#placeOf = placeOf;
    this.#noteOf = noteOf;
    this.#isPictured = isPictured;
    this.#hasBars = hasBars;
    const result = { boxes: new Map(), edges: [], ports: new Map(), left: 0, top: 0, width: 0, height: 0 };
    if (structure.root === null) return result;
    const levels = ConnectionsByLevel(structure);
    const level = this.#best(structure, levels, isOpen, area);
    result.left = level.left ?? 0;
    result.top = level.top ?? 0;
    result.width = level.width + kRateWidth;
    result.height = level.height;
    Flatten(level, 0, 0, 0, result);
    AddDistantEdges(structure, levels, result);
    return result;
  }

  /** Open groups may be more or less wide: what fits the window best is taken. */
  #best(structure, levels, isOpen, area) {
    let best = null;
    for (const part of area ? kParts : [1]) {
      this.#placed = 0;
      const inner = area && { width: area.width * part, isWhole: false };
      const level = this.#level(structure, levels, structure.root, isOpen, { area: area && { ...area, isWhole: true }, inner, window: area });
      const scale = area ? Math.min(1, area.width / level.width, area.height / level.height) : 1;
      if (!best || scale > best.scale * kWorthIt) best = { level, scale };
      if (scale === 1 || this.#placed > kFew || level.boxes.every((box) => !box.open)) break;
    }
    return best.level;
  }

  #level(structure, levels, group, isOpen, { area: wanted, inner, window }) {
    const boxes = structure.membersOf(group).map((path) => this.#box(structure, levels, path, isOpen, inner, window));
    // What fills a window by itself has its shape.
    const area = wanted && boxes.length > kMany ? { ...window, isWhole: true } : wanted;
    const connections = levels.get(group) ?? [];
    const ports = group === structure.root ? [] : structure.portsOf(group);
    const signature = JSON.stringify([boxes.map((box) => box.signature),
      connections.map((connection) => connection.key), ports.map((port) => port.path), area,
      boxes.map((box) => this.#placeOf(box.path) ?? null)]);
    const place = `${group} ${inner?.width}`;
    const kept = this.#kept.get(place);
    if (kept?.signature === signature) {
      kept.layout.boxes.forEach((box, index) => {
        const { element, inputs, outputs } = boxes[index];
        Object.assign(box, { element, inputs, outputs });
      });
      return kept.layout;
    }
    if (boxes.some((box) => this.#placeOf(box.path))) {
      const layout = PlacedLevel(structure, { group, boxes, connections, ports, placeOf: this.#placeOf });
      layout.signature = signature;
      this.#kept.set(place, { signature, layout });
      return layout;
    }
    const members = [kInside, ...boxes.map((box) => box.path), kOutside];
    const closing = ClosingEdges(members, connections);
    const layout = LevelLayout(structure, { group, boxes, connections, closing, ports, patience: kPatience - this.#placed, area });
    this.#placed += layout.effort;
    layout.signature = signature;
    this.#kept.set(place, { signature, layout });
    return layout;
  }

  #box(structure, levels, path, isOpen, inner, window) {
    const element = structure.get(path);
    const ports = structure.portsOf(path);
    const inputs = ports.filter((port) => port.direction === 'input');
    const outputs = ports.filter((port) => port.direction === 'output');
    const box = { path, element, inputs, outputs, open: IsGroup(element) && !element.far && isOpen(path) };
    if (box.open) {
      box.level = this.#level(structure, levels, path, isOpen, { area: inner, inner, window });
      box.width = box.level.width;
      box.height = box.level.height;
      box.signature = `${path} ${box.level.signature}`;
      return box;
    }
    box.hidden = IsGroup(element) ? CountModules(structure, path) : 0;
    box.note = NoteLines(this.#noteOf(path));
    const detail = element.far ? kFarDetail : IsGroup(element) ? `${box.hidden} modules` : element.type ?? '';
    Object.assign(box, BoxSize(element.name, detail, inputs, outputs, box.note));
    box.picture = this.#isPictured(path);
    if (box.picture) Object.assign(box, { width: Math.max(box.width, 200), height: box.height + kPicture });
    box.bars = this.#hasBars(path);
    if (box.bars) Object.assign(box, { width: Math.max(box.width, 200), height: box.height + kBars });
    box.signature = `${path} ${detail} ${box.picture} ${box.bars} ${ports.map((port) => port.path)} ${box.note.join(' ')}`;
    return box;
  }
}

function CountModules(structure, group) {
  let count = 0;
  for (const path of structure.get(group)?.children ?? []) {
    const kind = structure.get(path)?.kind;
    if (kind === 'module') ++count;
    else if (kind === 'group') count += CountModules(structure, path);
  }
  return count;
}

function Flatten(level, x, y, depth, result) {
  for (const edge of level.edges) {
    result.edges.push({ ...edge, dx: x, dy: y, depth,
      left: edge.left + x, right: edge.right + x, top: edge.top + y, bottom: edge.bottom + y,
      middle: { x: edge.middle.x + x, y: edge.middle.y + y },
      start: { x: edge.start.x + x, y: edge.start.y + y },
      end: { x: edge.end.x + x, y: edge.end.y + y } });
  }
  for (const [port, place] of level.border) {
    result.ports.set(port, { x: place.x + x, y: place.y + y, side: place.side });
  }
  for (const box of level.boxes) {
    const place = { ...box, x: box.x + x, y: box.y + y, depth };
    result.boxes.set(box.path, place);
    if (box.open) {
      Flatten(box.level, place.x, place.y, depth + 1, result);
      continue;
    }
    box.inputs.forEach((port, index) =>
      result.ports.set(port.path, { x: place.x, y: place.y + PortHeight(index), side: 'left' }));
    box.outputs.forEach((port, index) =>
      result.ports.set(port.path, { x: place.x + box.width, y: place.y + PortHeight(index), side: 'right' }));
  }
}

/** Connections that pass the border of a group without a port of it: bows over everything. */
function AddDistantEdges(structure, levels, result) {
  for (const [group, connections] of levels) {
    if (group !== structure.root && !result.boxes.get(group)?.open) continue;
    for (const connection of connections) {
      if (!IsDistant(structure, connection)) continue;
      const start = EndPlace(structure, result, connection.from, connection.source);
      const end = EndPlace(structure, result, connection.to, connection.target);
      if (!start || !end) continue;
      result.edges.push({ key: connection.key, from: connection.from, to: connection.to, start, end,
        middle: { x: (start.x + end.x) / 2, y: (start.y + end.y) / 2 },
        path: end.x < start.x ? BowPath(start, end) : ForwardPath(start, end),
        dx: 0, dy: 0, depth: 0, left: Math.min(start.x, end.x) - 100,
        right: Math.max(start.x, end.x) + 100, top: Math.min(start.y, end.y), bottom: Math.max(start.y, end.y) });
    }
  }
}

function EndPlace(structure, result, port, member) {
  const place = result.ports.get(port);
  if (place) return place;
  const box = result.boxes.get(member);
  if (!box) return null;
  const isOutput = structure.get(port).direction === 'output';
  return { x: isOutput ? box.x + box.width : box.x, y: box.y + box.height / 2 };
}
