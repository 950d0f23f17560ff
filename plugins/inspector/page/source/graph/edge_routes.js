// The ways of a level's connections: forward between boxes of one row, back in lanes below them, and from
// row to row in lanes between them.

import { NameOf } from '../model/structure.js';
import { BowPath, CornerPath, ForwardPath, LanePath } from './edge_path.js';
import { PortHeight, PortLabelWidth } from './measure.js';

const kLane = 9;       // between two lanes
const kFirstLane = 14; // from what is above
const kBeside = 12;    // from a column to what runs up and down beside it
const kApart = 5;      // between two of these

/**
 * The lanes that connections need: {gaps: [Map port -> lane], margin: Map port -> number}; gap `n` is below
 * row `n`. The margin is left of all rows: for what does not go to the next row.
 */
export function PlanLanes(connections, closing, rowOf, rows) {
  const gaps = Array.from({ length: rows }, () => new Map());
  const margin = new Map();
  const take = (lanes, port) => { if (!lanes.has(port)) lanes.set(port, lanes.size); };
  for (const connection of connections) {
    const way = WayOf(connection, closing, rowOf);
    for (const gap of way?.gaps ?? []) take(gaps[gap], connection.from);
    if (way?.gaps.length > 1) take(margin, connection.from);
  }
  return { gaps, margin };
}

export function LanesHeight(lanes) {
  return lanes.size * kLane;
}

/** How much room what runs up and down needs left of the first column. */
export function MarginWidth({ gaps, margin }) {
  const most = Math.max(0, ...gaps.map((lanes) => lanes.size));
  return kBeside + Math.min(most, 8) * kApart + margin.size * kApart;
}

/** The gaps that a connection runs through; null: straight from box to box. */
function WayOf({ source, target }, closing, rowOf) {
  const [from, to] = [rowOf.get(source) ?? 0, rowOf.get(target) ?? 0];
  const isBack = source === target || closing.has(`${source} ${target}`);
  if (from === to) return isBack ? { gaps: [from] } : null;
  const [leave, enter] = from < to ? [from, to - 1] : [from - 1, to];
  return { gaps: leave === enter ? [leave] : [leave, enter] };
}

/** {edges, lowest}: each with its path and the area that it takes; `lowest`: what runs below all boxes. */
export function RouteEdges(connections, { closing, placed, border, bends, lanes, rowOf, bottoms, side, top }) {
  const edges = [];
  let lowest = -Infinity; // boxes that have been put somewhere may all be above 0
  const shares = new Map();  // bent edges between the same boxes run beside each other
  const beside = new Map();  // of columns: the ports whose lines run up and down beside them
  const isOneRow = bottoms.length === 1;
  // Lines beside a column that run past each other have another number; those of one port are one line.
  const number = (key, port, from, to) => {
    if (!beside.has(key)) beside.set(key, []);
    const lines = beside.get(key);
    const [low, high] = [Math.min(from, to), Math.max(from, to)];
    const isFree = (at) => lines.every((line) => line.at !== at || line.port === port || line.high < low || line.low > high);
    let at = lines.find((line) => line.port === port)?.at ?? 0;
    while (!isFree(at)) ++at;
    lines.push({ port, at, low, high });
    return at;
  };
  const column = (member, which, port, x, y, lane) => {
    const sign = which === 'right' ? 1 : -1;
    const edge = placed.has(member) ? ColumnEdge(placed, rowOf, member, which) : x;
    return edge + sign * (kBeside + kApart * number(`${which} ${Math.round(edge)}`, port, y, lane));
  };
  for (const connection of connections) {
    const { key, from, to, source, target } = connection;
    const start = End(from, placed.get(source), 'outputs', border);
    const end = End(to, placed.get(target), 'inputs', border);
    if (!start || !end) continue;
    const edge = { key, from, to, start, end };
    const way = WayOf(connection, closing, rowOf);
    if (!way) {
      const pair = `${source} ${target}`;
      const share = shares.get(pair) ?? 0;
      shares.set(pair, share + 1);
      const points = (bends.get(pair) ?? []).map(({ x, y }) => ({ x: x + side, y: y + top + share * 6 }));
      edges.push(WithArea(edge, end.x < start.x ? BowPath(start, end) : ForwardPath(start, end, points), [start, ...points, end],
        points.length > 0 ? points[Math.floor(points.length / 2)] : undefined));
      continue;
    }
    const [first, second = first] = way.gaps;
    const belowRow = (gap) => (isOneRow ? Infinity : bottoms[gap] + top + kFirstLane + lanes.gaps[gap].get(from) * kLane);
    const right = column(source, 'right', from, start.x, start.y, belowRow(first));
    const beforeTarget = column(target, 'left', from, end.x, end.y, belowRow(second));
    const left = Math.abs(beforeTarget - right) < 2 * kBeside && end.x > start.x ? right : beforeTarget; // no step for a hair
    const laneY = (gap) => (isOneRow ? BottomBetween(placed, left, right, start.y, end.y) + kFirstLane +
      lanes.gaps[gap].get(from) * kLane : belowRow(gap));
    lowest = Math.max(lowest, laneY(first), laneY(second));
    if (isOneRow) {
      const lane = laneY(first);
      edges.push(WithArea(edge, LanePath(start, end, { right, left, lane }), [start, { x: right, y: lane }, { x: left, y: lane }, end],
        { x: (right + left) / 2, y: lane }));
      continue;
    }
    const points = [start, { x: right, y: start.y }, { x: right, y: laneY(first) }];
    if (second !== first) {
      const margin = side + kApart * lanes.margin.get(from);
      points.push({ x: margin, y: laneY(first) }, { x: margin, y: laneY(second) });
    }
    points.push({ x: left, y: laneY(second) }, { x: left, y: end.y }, end);
    edges.push(WithArea(edge, CornerPath(points), points, Mean(points[2], points[3])));
  }
  return { edges, lowest };
}

/** `middle`: where a note stands. */
function WithArea(edge, path, points, middle = Mean(points[0], points.at(-1))) {
  const [xs, ys] = [points.map((point) => point.x), points.map((point) => point.y)];
  return { ...edge, path, middle, left: Math.min(...xs), right: Math.max(...xs), top: Math.min(...ys), bottom: Math.max(...ys) };
}

function Mean(a, b) {
  return { x: (a.x + b.x) / 2, y: (a.y + b.y) / 2 };
}

function End(port, box, list, border) {
  if (border.has(port)) {
    // Inside of the group the port's name stands between the border and the line.
    const { x, y, side } = border.get(port);
    const label = PortLabelWidth([{ name: NameOf(port) }]) + 14;
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

/** How far the boxes of the same column and row reach. */
function ColumnEdge(placed, rowOf, path, which) {
  const box = placed.get(path);
  const middle = box.x + box.width / 2;
  let edge = which === 'right' ? box.x + box.width : box.x;
  for (const other of placed.values()) {
    if (Math.abs(other.x + other.width / 2 - middle) > 1 || rowOf.get(other.path) !== rowOf.get(path)) continue;
    edge = which === 'right' ? Math.max(edge, other.x + other.width) : Math.min(edge, other.x);
  }
  return edge;
}
