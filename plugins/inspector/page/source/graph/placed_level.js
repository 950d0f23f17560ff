// A level whose boxes have been put somewhere by hand. What is new finds a free place, and boxes that have
// grown push others away.

import { PlanLanes, RouteEdges } from './edge_routes.js';
import { IsDistant } from './levels.js';
import { kGroupHeader, kPadding, kRow, PortLabelWidth } from './measure.js';

const kGap = 16;      // between boxes that push each other away
const kNewGap = 60;   // before a box that has no place yet
const kMostPushed = 200;

/** As LevelLayout(), with left and top: where it begins. `placeOf(path)`: {x, y} or undefined. */
export function PlacedLevel(structure, { boxes, connections, ports, group, placeOf }) {
  const isRoot = group === structure.root;
  const inputs = ports.filter((port) => port.direction === 'input');
  const outputs = ports.filter((port) => port.direction === 'output');
  const top = isRoot ? -Infinity : kGroupHeader + kPadding;
  const side = isRoot ? -Infinity : kPadding + (inputs.length > 0 ? PortLabelWidth(inputs) + 30 : 0);
  const placed = new Map();
  for (const box of boxes) {
    const place = placeOf(box.path);
    if (place) placed.set(box.path, { ...box, x: Math.max(place.x, side), y: Math.max(place.y, top) });
  }
  for (const box of boxes) {
    if (!placed.has(box.path)) placed.set(box.path, PutFree(box, connections, placed, side, top));
  }
  if (placed.size <= kMostPushed) PushApart([...placed.values()]);

  const all = [...placed.values()];
  const left = isRoot ? Math.min(...all.map((box) => box.x)) : 0;
  const upper = isRoot ? Math.min(...all.map((box) => box.y)) : 0;
  const right = Math.max(...all.map((box) => box.x + box.width));
  const bottom = Math.max(...all.map((box) => box.y + box.height));
  const width = isRoot ? right - left : Math.max(200, right + kPadding + (outputs.length > 0 ? PortLabelWidth(outputs) + 30 : 0));
  const border = new Map();
  PutBorder(inputs, 0, 'left', 'from', 'target', { connections, placed, top }, border);
  PutBorder(outputs, width, 'right', 'to', 'source', { connections, placed, top }, border);

  const near = connections.filter((connection) => !IsDistant(structure, connection));
  const closing = GoingBack(near, placed);
  const rowOf = new Map();
  const lanes = PlanLanes(near, closing, rowOf, 1);
  const { edges, lowest } = RouteEdges(near, { closing, placed, border, bends: new Map(), lanes, rowOf,
    bottoms: [bottom], side: 0, top: 0 });
  const lowestPort = Math.max(...[...border.values()].map((place) => place.y + kRow / 2));
  const height = Math.max(bottom, lowest + 6, lowestPort) + (isRoot ? 0 : kPadding) - upper;
  return { boxes: boxes.map((box) => placed.get(box.path)), edges, border, left, top: upper, width, height };
}

/** Beside what it takes its values from, below what is there. */
function PutFree(box, connections, placed, side, top) {
  const before = connections.filter((each) => each.target === box.path).map((each) => placed.get(each.source)).filter(Boolean);
  const all = [...placed.values()];
  const x = before.length > 0 ? Math.max(...before.map((each) => each.x + each.width)) + kNewGap
    : Math.max(side, Math.min(...all.map((each) => each.x)));
  let y = before.length > 0 ? before[0].y : Math.max(...all.map((each) => each.y + each.height)) + kGap;
  y = Math.max(y, top);
  const place = { ...box, x, y };
  for (let found = true; found;) {
    found = false;
    for (const other of all) {
      if (!Overlap(place, other)) continue;
      place.y = other.y + other.height + kGap;
      found = true;
    }
  }
  return place;
}

/** Whoever is further right or below makes room. */
function PushApart(boxes) {
  for (let turn = 0; turn < 12; ++turn) {
    let isQuiet = true;
    for (const a of boxes) {
      for (const b of boxes) {
        if (a === b || !Overlap(a, b)) continue;
        const [dx, dy] = [a.x + a.width - b.x, a.y + a.height - b.y];
        const isRight = b.x + b.width / 2 >= a.x + a.width / 2;
        const isBelow = b.y + b.height / 2 >= a.y + a.height / 2;
        if (isRight && (dx <= dy || !isBelow)) b.x += dx + kGap;
        else if (isBelow) b.y += dy + kGap;
        else continue;
        isQuiet = false;
      }
    }
    if (isQuiet) return;
  }
}

function Overlap(a, b) {
  return a.x < b.x + b.width && b.x < a.x + a.width && a.y < b.y + b.height && b.y < a.y + a.height;
}

/** Ports of the group at the height of what they are connected with, in that order. */
function PutBorder(ports, x, side, end, other, { connections, placed, top }, border) {
  const wish = (port) => {
    const heights = connections.filter((each) => each[end] === port.path).map((each) => placed.get(each[other]))
      .filter(Boolean).map((box) => box.y + box.height / 2);
    return heights.length > 0 ? heights.reduce((sum, y) => sum + y, 0) / heights.length : top + kRow;
  };
  const wishes = ports.map((port) => ({ port, y: wish(port) })).sort((a, b) => a.y - b.y);
  const middle = wishes.reduce((sum, { y }) => sum + y, 0) / wishes.length;
  let y = Math.max(top + kRow / 2, middle - (ports.length - 1) * kRow / 2);
  for (const { port } of wishes) {
    border.set(port.path, { x, y, side });
    y += kRow;
  }
}

/** The pairs whose connections run against the flow, as the boxes stand. */
function GoingBack(connections, placed) {
  const back = new Set();
  for (const { source, target } of connections) {
    const [from, to] = [placed.get(source), placed.get(target)];
    if (from && to && to.x < from.x + from.width + 12) back.add(`${source} ${target}`);
  }
  return back;
}
