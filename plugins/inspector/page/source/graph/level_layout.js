// The layout of one level: the boxes of a group's members, its own ports on the border, and the
// curves between them. All places are relative to the group's left upper corner.

import { LanesHeight, MarginWidth, PlanLanes, RouteEdges } from './edge_routes.js';
import { IsDistant, kInside, kOutside } from './levels.js';
import { kGroupHeader, kPadding, kRow, PortLabelWidth } from './measure.js';
import { EffortOf, PlaceInRanks } from './ranks.js';
import { ChooseRows, PlaceRows } from './rows.js';

const kGridGap = 22;

/** {boxes with x and y, edges, border: Map port -> {x, y, side}, width, height, effort: what it took of `patience`}. */
export function LevelLayout(structure, { boxes, connections, closing, ports, group, patience, area }) {
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
  const ways = WithBorders(ranked, flow);
  const effort = EffortOf(ranked, ways);
  const isQuick = effort > patience;
  const ranks = PlaceInRanks(ranked, ways, isQuick);
  const chosen = ranked.length > 0 ? ChooseRows(ranks, ranked, area) : [[]];
  const near = connections.filter((connection) => !IsDistant(structure, connection));
  const rowIn = new Map(chosen.flatMap((row, number) => row.flatMap((column) => column.boxes.map((box) => [box.id, number]))));
  const lanes = PlanLanes(near, closing, rowIn, chosen.length);
  const margin = chosen.length > 1 ? MarginWidth(lanes) : 0;
  const rows = PlaceRows(ranks, chosen, lanes.gaps.map(LanesHeight), margin);

  const placed = new Map();
  for (const box of flowing) {
    const { x, y } = rows.places.get(box.path);
    placed.set(box.path, { ...box, x: x + side, y: y + top });
  }
  const flowHeight = ranked.length > 0 ? rows.height + (chosen.length > 1 ? LanesHeight(lanes.gaps.at(-1)) : 0) : 0;
  const grid = PlaceGrid(alone, Math.max(rows.width, area?.width ?? 900), side, flowHeight > 0 ? top + flowHeight + kGridGap : top);
  for (const box of grid.boxes) placed.set(box.path, box);
  const contentBottom = Math.max(top + flowHeight, grid.bottom);

  const width = Math.max(rows.width + margin, grid.right - side, isRoot ? 0 : 200) + 2 * side;
  const border = new Map();
  PlaceBorder(inputs, rows.places.get(kInside), 0, 'left', { connections, placed, top, end: 'from' }, border);
  PlaceBorder(outputs, rows.places.get(kOutside), width, 'right', { connections, placed, top, end: 'to' }, border);

  const bends = BendsInRows(ranks.bends, rows);
  const { edges, lowest } = RouteEdges(near, { closing, placed, border, bends, lanes, side, top,
    rowOf: rows.rowOf, bottoms: rows.bottoms });
  const height = Math.max(contentBottom, lowest + 6) + (isRoot ? 0 : kPadding);
  const ordered = boxes.map((box) => placed.get(box.path));
  return { boxes: ordered, edges, border, width, height: Math.max(height, top + 24), effort: isQuick ? 0 : effort };
}

/** The passages that long edges take between boxes, of those that stay in their row. */
function BendsInRows(bends, { rowOf, shifts }) {
  const moved = new Map();
  for (const [pair, points] of bends) {
    const [source, target] = pair.split(' ');
    const row = rowOf.get(source);
    if (row !== rowOf.get(target) || shifts[row].isLoose) continue;
    moved.set(pair, points.map(({ x, y }) => ({ x: x + shifts[row].x, y: y + shifts[row].y })));
  }
  return moved;
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
