// Breaks what flows from left to right into rows, as a text is broken into lines, so that it fits a window.

const kBetweenRows = 34;   // without lanes
const kUsualLanes = 30;    // what lanes between two rows may take, before they are known
const kLoose = 1.5;        // times as high as its tallest column: a row that is put together
const kStackGap = 26;
const kMostRows = 60;
const kWorthIt = 1.08;     // by how much larger all must become for another row

/**
 * The columns of `ranks` (PlaceInRanks) in rows: a list of lists of columns {left, right, boxes}. `area`:
 * {width, height, isWhole}; whole: all of it is to be as large as possible in there, else only not wider.
 */
export function ChooseRows(ranks, boxes, area) {
  const columns = ColumnsOf(ranks, boxes);
  if (!area || columns.length < 2) return [columns];
  let best = null;
  for (let count = 1; count <= Math.min(columns.length, kMostRows); ++count) {
    const rows = Partition(columns, count);
    if (rows.length < count) continue;
    const width = Math.max(...rows.map(WidthOf));
    if (!area.isWhole) {
      best = { rows };
      if (width <= area.width) break;
      continue;
    }
    const height = rows.reduce((sum, row) => sum + HeightOf(row, ranks), 0) + (count - 1) * (kBetweenRows + kUsualLanes);
    const scale = Math.min(1, area.width / width, area.height / height);
    if (!best || scale > best.scale * kWorthIt) best = { rows, scale };
    if (scale === 1) break;
  }
  return best.rows;
}

/** Places of boxes in their rows, below each other: {places, bends, rowOf: Map id -> row, bottoms, width, height}. */
export function PlaceRows(ranks, rows, gaps, left) {
  const places = new Map();
  const rowOf = new Map();
  const bottoms = [];
  const shifts = [];
  let y = 0;
  let width = 0;
  rows.forEach((row, number) => {
    const isLoose = rows.length > 1 && SpreadOf(row, ranks) > kLoose * TallestOf(row);
    const shift = { x: rows.length > 1 ? left - row[0].left : 0, y: rows.length > 1 ? y - TopOf(row, ranks) : 0, isLoose };
    for (const column of row) {
      let stacked = y + (TallestOf(row) - StackOf(column)) / 2;
      for (const box of InOrder(column, ranks)) {
        const place = ranks.places.get(box.id);
        places.set(box.id, { x: place.x + shift.x, y: isLoose ? stacked : place.y + shift.y });
        stacked += box.height + kStackGap;
        rowOf.set(box.id, number);
        width = Math.max(width, place.x + shift.x + box.width);
      }
    }
    shifts.push(shift);
    const height = rows.length > 1 ? HeightOf(row, ranks) : ranks.height;
    bottoms.push(y + height);
    y += height + (number < rows.length - 1 ? kBetweenRows + gaps[number] : 0);
  });
  return { places, rowOf, bottoms, shifts, width, height: y };
}

function ColumnsOf(ranks, boxes) {
  const columns = new Map();
  for (const box of boxes) {
    const { x } = ranks.places.get(box.id);
    const middle = Math.round(x + box.width / 2);
    if (!columns.has(middle)) columns.set(middle, { left: Infinity, right: -Infinity, boxes: [] });
    const column = columns.get(middle);
    column.left = Math.min(column.left, x);
    column.right = Math.max(column.right, x + box.width);
    column.boxes.push(box);
  }
  return [...columns].sort(([a], [b]) => a - b).map(([, column]) => column);
}

/** At most `count` rows, of which the widest is as narrow as can be. */
function Partition(columns, count) {
  let [low, high] = [0, columns.at(-1).right - columns[0].left];
  let rows = [columns];
  for (let step = 0; step < 24 && high - low > 4; ++step) {
    const width = (low + high) / 2;
    const tried = Fill(columns, width);
    if (tried.length <= count && Math.max(...tried.map(WidthOf)) <= width) [high, rows] = [width, tried];
    else low = width;
  }
  return rows;
}

function Fill(columns, width) {
  const rows = [];
  for (const column of columns) {
    const row = rows.at(-1);
    if (row && column.right - row[0].left <= width) row.push(column);
    else rows.push([column]);
  }
  return rows;
}

function WidthOf(row) {
  return row.at(-1).right - row[0].left;
}

function TopOf(row, ranks) {
  return Math.min(...row.flatMap((column) => column.boxes.map((box) => ranks.places.get(box.id).y)));
}

/** What was apart only because of boxes in other rows is put together. */
function HeightOf(row, ranks) {
  const spread = SpreadOf(row, ranks);
  const tallest = TallestOf(row);
  return spread > kLoose * tallest ? tallest : spread;
}

function TallestOf(row) {
  return Math.max(...row.map(StackOf));
}

function StackOf(column) {
  return column.boxes.reduce((sum, box) => sum + box.height + kStackGap, -kStackGap);
}

function InOrder(column, ranks) {
  return [...column.boxes].sort((a, b) => ranks.places.get(a.id).y - ranks.places.get(b.id).y);
}

function SpreadOf(row, ranks) {
  const bottom = Math.max(...row.flatMap((column) => column.boxes.map((box) => ranks.places.get(box.id).y + box.height)));
  return bottom - TopOf(row, ranks);
}
