// Where widgets are on the grid: 12 columns, as many rows as there are. No browser in it.

export const kColumns = 12;

export function Overlaps(a, b) {
  return a.x < b.x + b.w && b.x < a.x + a.w && a.y < b.y + b.h && b.y < a.y + a.h;
}

/** The same with `widget` within the grid. */
export function Within(widget, least = { w: 1, h: 1 }) {
  const w = Math.min(kColumns, Math.max(least.w, widget.w));
  return { ...widget, w, h: Math.max(least.h, widget.h),
    x: Math.min(kColumns - w, Math.max(0, widget.x)), y: Math.max(0, widget.y) };
}

/**
 * The widgets with `changed` in its new place: it stays there, and what is in its way goes down, as far as it has
 * to and no further. Others stay where they are.
 */
export function Placed(widgets, changed) {
  const done = [changed];
  const others = widgets.filter(({ id }) => id !== changed.id).sort((a, b) => a.y - b.y || a.x - b.x);
  for (const widget of others) {
    let place = widget;
    for (let hit = done.find((each) => Overlaps(each, place)); hit; hit = done.find((each) => Overlaps(each, place))) {
      place = { ...place, y: hit.y + hit.h };
    }
    done.push(place);
  }
  const byId = new Map(done.map((each) => [each.id, each]));
  return widgets.some(({ id }) => id === changed.id)
    ? widgets.map(({ id }) => byId.get(id)) : [...widgets.map(({ id }) => byId.get(id)), changed];
}

/** The first place, from the top, where something so large fits. */
export function FreePlace(widgets, { w, h }) {
  for (let y = 0; ; ++y) {
    for (let x = 0; x + w <= kColumns; ++x) {
      if (!widgets.some((each) => Overlaps(each, { x, y, w, h }))) return { x, y, w, h };
    }
  }
}

/** As they are read, for one column. */
export function InOrder(widgets) {
  return [...widgets].sort((a, b) => a.y - b.y || a.x - b.x);
}

export function RowsOf(widgets) {
  return Math.max(0, ...widgets.map(({ y, h }) => y + h));
}
