// The layout of one level: the boxes of a group's members, its own ports on the border, and the
// curves between them. All places are relative to the group's left upper corner.

import { NameOf } from '../model/structure.js';
import { BowPath, ForwardPath, LanePath } from './edge_path.js';
import { IsDistant, kInside, kOutside } from './levels.js';
import { kGroupHeader, kPadding, kRow, PortHeight, PortLabelWidth } from './measure.js';
import { PlaceInRanks } from './ranks.js';

const kLane = 9;      // between two lanes
const kGridGap = 22;

/** {boxes with x and y, edges, border: Map port -> {x, y, side}, width, height}. */
export function LevelLayout(structure, { boxes, connections, closing, ports, group, isQuick }) {
  const isRoot = group === structure.root;
  const inputs = ports.filter((port) => port.direction === 'input');
  const outputs = ports.filter((port) => port.direction === 'output');
  const top = isRoot ? 0 : kGroupHeader + kPadding;
  const side = isRoot ? 0 : kPadding;

  const flow = FlowEdges(connections, closing);
  const touched = new Set(flow.flatMap((edge) => [edge.source, edge.target]));
  for (const connection of connections) touched.add(connection.source).add(connection.target);
  const flowing = boxes.filter((box) => touched.has(box.path));
  const alone = boxes.filter((box) => !touched.has(box.path));
  const ranked = flowing.map((box) => ({ id: box.path, width: box.width, height: box.height }));
  if (inputs.length > 0) ranked.push(Border(kInside, inputs));
  if (outputs.length > 0) ranked.push(Border(kOutside, outputs));
  const ranks = PlaceInRanks(ranked, WithBorders(ranked, flow), isQuick);

  const placed = new Map();
  for (const box of flowing) {
    const { x, y } = ranks.places.get(box.path);
    placed.set(box.path, { ...box, x: x + side, y: y + top });
  }
  const grid = PlaceGrid(alone, Math.max(ranks.width, 900), side, ranks.height > 0 ? top + ranks.height + kGridGap : top);
  for (const box of grid.boxes) placed.set(box.path, box);
  const contentBottom = Math.max(top + ranks.height, grid.bottom);

  const width = Math.max(ranks.width, grid.right - side, isRoot ? 0 : 200) + 2 * side;
  const border = new Map();
  PlaceBorder(inputs, ranks.places.get(kInside), 0, 'left', { connections, placed, top, end: 'from' }, border);
  PlaceBorder(outputs, ranks.places.get(kOutside), width, 'right', { connections, placed, top, end: 'to' }, border);

  const near = connections.filter((connection) => !IsDistant(structure, connection));
  const { edges, lowest } = Edges(near, closing, { placed, border, bends: ranks.bends, side, top });
  const height = Math.max(contentBottom, lowest + 6) + (isRoot ? 0 : kPadding);
  const ordered = boxes.map((box) => placed.get(box.path));
  return { boxes: ordered, edges, border, width, height: Math.max(height, top + 24) };
}

function FlowEdges(connections, closing) {
  const weights = new Map();
  for (const { source, target } of connections) {
    const key = `${source} ${target}`;
    if (source === target || closing.has(key)) continue;
    const edge = weights.get(key) ?? { source, target, weight: 0 };
    edge.weight += 1;
    weights.set(key, edge);
  }
  return [...weights.values()];
}

function Border(id, ports) {
  return { id, width: PortLabelWidth(ports) + 4, height: ports.length * kRow };
}

/** A group's own ports stand at its edges: before all that has nothing before it, and after the rest. */
function WithBorders(ranked, flow) {
  const ids = new Set(ranked.map((box) => box.id));
  const edges = flow.filter((edge) => ids.has(edge.source) && ids.has(edge.target));
  const has = (end, id) => edges.some((edge) => edge[end] === id);
  const extra = [];
  for (const { id } of ranked) {
    if (id === kInside || id === kOutside) continue;
    if (ids.has(kInside) && !has('target', id)) extra.push({ source: kInside, target: id, weight: 0 });
    if (ids.has(kOutside) && !has('source', id)) extra.push({ source: id, target: kOutside, weight: 0 });
  }
  return [...edges, ...extra];
}

/** What is connected with nothing stands in rows below. */
function PlaceGrid(boxes, width, left, top) {
  let [x, y, rowHeight, right] = [left, top, 0, left];
  const placed = [];
  for (const box of boxes) {
    if (x > left && x + box.width > left + width) {
      x = left;
      y += rowHeight + kGridGap;
      rowHeight = 0;
    }
    placed.push({ ...box, x, y });
    x += box.width + kGridGap;
    right = Math.max(right, x - kGridGap);
    rowHeight = Math.max(rowHeight, box.height);
  }
  return { boxes: placed, right, bottom: boxes.length > 0 ? y + rowHeight : 0 };
}

/** Ports of the group on its border, in the order of what they are connected with inside. */
function PlaceBorder(ports, place, x, side, { connections, placed, top, end }, border) {
  if (ports.length === 0) return;
  const other = end === 'from' ? 'target' : 'source';
  const wish = (port) => {
    const heights = connections.filter((connection) => connection[end] === port.path)
      .map((connection) => placed.get(connection[other])?.y ?? 0);
    return heights.length > 0 ? heights.reduce((sum, y) => sum + y, 0) / heights.length : Infinity;
  };
  const order = ports.map((port, index) => ({ port, index, wish: wish(port) }))
    .sort((a, b) => (a.wish === b.wish ? a.index - b.index : a.wish - b.wish));
  order.forEach(({ port }, index) =>
    border.set(port.path, { x, y: place.y + top + kRow * index + kRow / 2, side }));
}

function Edges(connections, closing, { placed, border, bends, side, top }) {
  const edges = [];
  let lowest = 0; // what runs back below the boxes
  const lanes = new Map(); // port that data flows back from -> number of its lane
  const shares = new Map(); // bent edges between the same boxes run beside each other
  for (const connection of connections) {
    const start = End(connection.from, placed.get(connection.source), 'outputs', border, NameOf(connection.from));
    const end = End(connection.to, placed.get(connection.target), 'inputs', border, NameOf(connection.to));
    if (!start || !end) continue;
    const pair = `${connection.source} ${connection.target}`;
    const edge = { key: connection.key, from: connection.from, to: connection.to, start, end };
    if (connection.source === connection.target || closing.has(pair)) {
      if (!lanes.has(connection.from)) lanes.set(connection.from, lanes.size);
      const number = lanes.get(connection.from);
      const way = {
        right: ColumnEdge(placed, connection.source, 'right') + 14 + number * 5,
        left: ColumnEdge(placed, connection.target, 'left') - 14 - number * 5,
      };
      way.lane = BottomBetween(placed, way.left, way.right, start.y, end.y) + 14 + number * kLane;
      lowest = Math.max(lowest, way.lane);
      edges.push({ ...edge, path: LanePath(start, end, way), left: way.left, right: way.right,
        top: Math.min(start.y, end.y), bottom: way.lane });
      continue;
    }
    const share = shares.get(pair) ?? 0;
    shares.set(pair, share + 1);
    const points = (bends.get(pair) ?? []).map(({ x, y }) => ({ x: x + side, y: y + top + share * 6 }));
    const path = end.x < start.x ? BowPath(start, end) : ForwardPath(start, end, points);
    const all = [start, end, ...points];
    edges.push({ ...edge, path, left: Math.min(...all.map((p) => p.x)), right: Math.max(...all.map((p) => p.x)),
      top: Math.min(...all.map((p) => p.y)), bottom: Math.max(...all.map((p) => p.y)) });
  }
  return { edges, lowest };
}

function End(port, box, list, border, name) {
  if (border.has(port)) {
    // Inside of the group the port's name stands between the border and the line.
    const { x, y, side } = border.get(port);
    const label = PortLabelWidth([{ name }]) + 14;
    return { x: side === 'left' ? x + label : x - label, y };
  }
  if (!box) return null;
  if (box.open) {
    const place = box.level.border.get(port);
    return place ? { x: box.x + place.x, y: box.y + place.y } : null;
  }
  const index = box[list].findIndex((candidate) => candidate.path === port);
  if (index < 0) return null;
  return { x: list === 'outputs' ? box.x + box.width : box.x, y: box.y + PortHeight(index) };
}

/** The lowest point of the boxes that a lane from `right` to `left` passes, and of its ends. */
function BottomBetween(placed, left, right, ...ends) {
  let bottom = Math.max(...ends);
  for (const box of placed.values()) {
    if (box.x < right && box.x + box.width > left) bottom = Math.max(bottom, box.y + box.height);
  }
  return bottom;
}

/** How far the boxes of the same column reach. */
function ColumnEdge(placed, path, which) {
  const box = placed.get(path);
  const middle = box.x + box.width / 2;
  let edge = which === 'right' ? box.x + box.width : box.x;
  for (const other of placed.values()) {
    if (Math.abs(other.x + other.width / 2 - middle) > 1) continue;
    edge = which === 'right' ? Math.max(edge, other.x + other.width) : Math.min(edge, other.x);
  }
  return edge;
}
