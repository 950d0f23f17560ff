// Where the graph is on the screen: a view {x, y, scale} maps a place of the graph to
// (x + scale * place). Plain functions; the page's current view is in graph_state.js.

const kSmallest = 0.01;
const kLargest = 2.5;

export function ToGraph(view, point) {
  return { x: (point.x - view.x) / view.scale, y: (point.y - view.y) / view.scale };
}

function ToScreen(view, place) {
  return { x: view.x + view.scale * place.x, y: view.y + view.scale * place.y };
}

/** Zooms so that what is under `point` (on the screen) stays there. */
export function ZoomAt(view, point, factor) {
  const scale = Math.min(kLargest, Math.max(kSmallest, view.scale * factor));
  const place = ToGraph(view, point);
  return { scale, x: point.x - scale * place.x, y: point.y - scale * place.y };
}

/** The view in which an area fits on a screen, but not larger than life. */
export function FitView(area, size, margin = 28) {
  const width = Math.max(area.width, 1);
  const height = Math.max(area.height, 1);
  const scale = Math.min(1, Math.max(kSmallest,
    Math.min((size.width - 2 * margin) / width, (size.height - 2 * margin) / height)));
  return {
    scale,
    x: (size.width - scale * width) / 2 - scale * area.x,
    y: (size.height - scale * height) / 2 - scale * area.y,
  };
}

/** What of the graph is on the screen, and a part of it around: {left, top, right, bottom}. */
export function VisibleArea(view, size, around = 0.25) {
  const from = ToGraph(view, { x: -size.width * around, y: -size.height * around });
  const to = ToGraph(view, { x: size.width * (1 + around), y: size.height * (1 + around) });
  return { left: from.x, top: from.y, right: to.x, bottom: to.y };
}

export function Contains(outer, inner) {
  return outer.left <= inner.left && outer.top <= inner.top &&
    outer.right >= inner.right && outer.bottom >= inner.bottom;
}

/** Moves the view as little as needed to have a box on the screen. */
export function ShowBox(view, size, box, margin = 40) {
  const from = ToScreen(view, box);
  const to = ToScreen(view, { x: box.x + box.width, y: box.y + box.height });
  return {
    scale: view.scale,
    x: view.x + Shift(from.x, to.x, size.width, margin),
    y: view.y + Shift(from.y, to.y, size.height, margin),
  };
}

function Shift(from, to, length, margin) {
  if (to - from > length - 2 * margin || from < margin) return margin - from;
  return to > length - margin ? length - margin - to : 0;
}
