// Places the boxes of one level, from left to right along the data flow: by dagre, or by the
// same idea without its patience. Boxes are {id, width, height}, edges {source,
// target} without circles. Both return {places: Map id -> {x, y} of the left upper corner, bends:
// Map "source target" -> points that a long edge passes, width, height}.

import dagre from '@dagrejs/dagre';

const kRankGap = 64;
const kNodeGap = 26;

export function PlaceInRanks(boxes, edges, isQuick) {
  return isQuick ? PlaceQuickly(boxes, edges) : PlaceWithDagre(boxes, edges);
}

function PlaceWithDagre(boxes, edges) {
  const graph = new dagre.graphlib.Graph();
  graph.setGraph({ rankdir: 'LR', ranksep: kRankGap, nodesep: kNodeGap, edgesep: 14 });
  graph.setDefaultEdgeLabel(() => ({}));
  for (const box of boxes) graph.setNode(box.id, { width: box.width, height: box.height });
  for (const edge of edges) {
    graph.setEdge(edge.source, edge.target, { weight: edge.weight ?? 1, minlen: 1 });
  }
  dagre.layout(graph);
  const places = new Map();
  for (const box of boxes) {
    const { x, y } = graph.node(box.id);
    places.set(box.id, { x: x - box.width / 2, y: y - box.height / 2 });
  }
  const bends = new Map();
  for (const { v, w } of graph.edges()) {
    // Ends and the middles of gaps are left out; what stays are the passages between other boxes.
    const points = graph.edge(v, w).points.slice(1, -1).filter((_, index) => index % 2 === 1);
    if (points.length > 0) bends.set(`${v} ${w}`, points);
  }
  return { places, bends, ...Extent(boxes, places) };
}

function PlaceQuickly(boxes, edges) {
  const columns = Columns(boxes, edges);
  const tallest = Math.max(1200, Math.sqrt(boxes.length) * 130);
  const places = new Map();
  let x = 0;
  for (const column of columns) {
    for (const part of Split(column, tallest)) {
      const width = Math.max(...part.map((box) => box.width));
      let y = 0;
      for (const box of part) {
        places.set(box.id, { x: x + (width - box.width) / 2, y });
        y += box.height + kNodeGap;
      }
      x += width + kRankGap;
    }
  }
  return { places, bends: new Map(), ...Extent(boxes, places) };
}

/** What dagre has to place, in boxes: it has something in each column that an edge passes, too, which takes a third of a box's time. */
export function EffortOf(boxes, edges) {
  const { rank } = RanksOf(boxes, edges);
  return boxes.length + edges.reduce((sum, { source, target }) => sum + rank.get(target) - rank.get(source) - 1, 0) / 3;
}

/** How long the longest way to each box is: {rank, before, after}, the latter two its neighbours. */
function RanksOf(boxes, edges) {
  const before = new Map(boxes.map((box) => [box.id, []]));
  const after = new Map(boxes.map((box) => [box.id, []]));
  for (const { source, target } of edges) {
    before.get(target).push(source);
    after.get(source).push(target);
  }
  const rank = new Map();
  const missing = new Map(boxes.map((box) => [box.id, before.get(box.id).length]));
  const ready = boxes.filter((box) => missing.get(box.id) === 0).map((box) => box.id);
  for (const id of ready) rank.set(id, 0);
  for (let at = 0; at < ready.length; ++at) {
    for (const next of after.get(ready[at])) {
      rank.set(next, Math.max(rank.get(next) ?? 0, rank.get(ready[at]) + 1));
      missing.set(next, missing.get(next) - 1);
      if (missing.get(next) === 0) ready.push(next);
    }
  }
  return { rank, before, after };
}

/** Boxes by the length of the longest way to them; within a column near to what they hang on. */
function Columns(boxes, edges) {
  const { rank, before, after } = RanksOf(boxes, edges);
  const columns = [];
  for (const box of boxes) (columns[rank.get(box.id) ?? 0] ??= []).push(box);
  const height = new Map();
  const number = (column) => column.forEach((box, index) => height.set(box.id, index / column.length));
  columns.forEach(number);
  for (let sweep = 0; sweep < 4; ++sweep) {
    const neighbours = sweep % 2 === 0 ? before : after;
    for (const column of sweep % 2 === 0 ? columns : [...columns].reverse()) {
      const wish = new Map(column.map((box) => [box.id, Mean(neighbours.get(box.id), height)]));
      column.sort((a, b) => (wish.get(a.id) ?? height.get(a.id)) - (wish.get(b.id) ?? height.get(b.id)));
      number(column);
    }
  }
  return columns.filter(Boolean);
}

function Mean(ids, height) {
  return ids.length === 0 ? undefined : ids.reduce((sum, id) => sum + height.get(id), 0) / ids.length;
}

function Split(column, tallest) {
  const parts = [[]];
  let y = 0;
  for (const box of column) {
    if (y + box.height > tallest && parts.at(-1).length > 0) {
      parts.push([]);
      y = 0;
    }
    parts.at(-1).push(box);
    y += box.height + kNodeGap;
  }
  return parts;
}

function Extent(boxes, places) {
  let [width, height] = [0, 0];
  for (const box of boxes) {
    const { x, y } = places.get(box.id);
    width = Math.max(width, x + box.width);
    height = Math.max(height, y + box.height);
  }
  return { width, height };
}
