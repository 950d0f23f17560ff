// The graph as it is shown now: its layout, the part on the screen, and what is being connected.

import { computed, effect, signal } from '@preact/signals';
import { IsOpen, SetOpen, openGroups } from '../state/choices.js';
import { draft, notes, places } from '../state/arrangement.js';
import { BehaviourOf } from '../state/behaviours.js';
import { IsPictured } from '../state/pictured.js';
import { shapeRevision, structure } from '../state/store.js';
import { GraphLayout } from './layout.js';
import { Contains, FitView, ShowBox, VisibleArea, ZoomAt } from './viewport.js';

const kDetailed = 160; // boxes on the screen; with more of them ports and texts cannot be read anyway

const kStep = 120;     // pixels: the layout does not follow each pixel of a window that is changed
const kMargin = 28;

export const size = signal({ width: 0, height: 0 });
const layouter = new GraphLayout();
const area = signal(null); // that the layout is made for: what it was when all was shown last
export const layout = computed(() => {
  shapeRevision.value;
  openGroups.value;
  const put = places.value;
  const moving = draft.value;
  const written = notes.value;
  return layouter.compute(structure, IsOpen, { area: area.value, isPictured: IsPictured, hasBars: (path) => BehaviourOf(path) !== undefined,
    placeOf: (path) => moving?.get(path) ?? put.get(path), noteOf: (path) => written.get(path) });
});
export const view = signal({ x: 0, y: 0, scale: 1 });
export const connecting = signal(null);           // {port, pointer, target, blocked} while an edge is drawn
export const candidates = signal(null);           // ports that it may go to: Map path -> ends
export const band = signal(null);                 // what is drawn around boxes to choose them: {left, top, right, bottom}
let fits = true; // until the user has moved the view, it follows the layout

// The area that is drawn: larger than the screen, so that it changes seldom while one pans.
let drawnArea = null;
const drawn = computed(() => {
  const needed = VisibleArea(view.value, size.value, 0);
  const wanted = VisibleArea(view.value, size.value);
  const isClose = drawnArea && Contains(drawnArea, needed) &&
    drawnArea.right - drawnArea.left < 2 * (wanted.right - wanted.left);
  if (!isClose) drawnArea = wanted;
  return drawnArea;
});

/** What of the layout is drawn: {groups, boxes, edges, far}; far: too many boxes for details. */
export const shown = computed(() => {
  const area = drawn.value;
  const groups = [];
  const boxes = [];
  for (const box of layout.value.boxes.values()) {
    if (!Overlaps(area, box.x, box.y, box.x + box.width, box.y + box.height)) continue;
    (box.open ? groups : boxes).push(box);
  }
  const edges = layout.value.edges.filter((edge) =>
    Overlaps(area, edge.left, edge.top, edge.right, edge.bottom));
  return { groups, boxes, edges, far: boxes.length > kDetailed };
});

function Overlaps(area, left, top, right, bottom) {
  return left <= area.right && right >= area.left && top <= area.bottom && bottom >= area.top;
}

export function MoveView(next) {
  fits = false;
  view.value = next;
}

/** About the middle of the screen. */
export function Zoom(factor) {
  MoveView(ZoomAt(view.value, { x: size.value.width / 2, y: size.value.height / 2 }, factor));
}

export function Fit() {
  fits = true;
  FollowSize();
  const { left: x, top: y, width, height } = layout.peek();
  if (size.peek().width > 0) view.value = FitView({ x, y, width, height }, size.peek());
}

/** Brings a box onto the screen, if it is not there yet, and large enough to be read. */
export function ShowElement(path) {
  const box = layout.peek().boxes.get(path);
  if (!box || size.peek().width === 0) return;
  let next = view.peek();
  if (next.scale < 0.45) {
    next = { ...FitView(box, size.peek()), scale: 0.8 };
    next.x = size.peek().width / 2 - next.scale * (box.x + box.width / 2);
    next.y = size.peek().height / 2 - next.scale * (box.y + box.height / 2);
  }
  next = ShowBox(next, size.peek(), box);
  const now = view.peek();
  if (next.x !== now.x || next.y !== now.y || next.scale !== now.scale) MoveView(next);
}

/** Opens or folds a group; its corner stays where it is on the screen. */
export function ToggleGroup(path) {
  const before = layout.peek().boxes.get(path);
  SetOpen(path, !IsOpen(path));
  const after = layout.peek().boxes.get(path);
  if (fits || !before || !after) return;
  const { x, y, scale } = view.peek();
  view.value = { scale, x: x + scale * (before.x - after.x), y: y + scale * (before.y - after.y) };
}

function FollowSize() {
  const { width, height } = size.peek();
  if (width === 0) return;
  const rounded = (length) => Math.max(kStep, Math.round((length - 2 * kMargin) / kStep) * kStep);
  const next = { width: rounded(width), height: rounded(height) };
  const now = area.peek();
  if (next.width !== now?.width || next.height !== now?.height) area.value = next;
}

/** While the user has not chosen a view, all of the graph is shown. */
export function StartFitting() {
  return effect(() => {
    layout.value;
    size.value;
    if (fits) Fit();
  });
}

/** The box at a place of the graph: the innermost one. */
export function BoxAt(place) {
  let found = null;
  for (const box of layout.peek().boxes.values()) {
    const isIn = place.x >= box.x && place.x <= box.x + box.width &&
      place.y >= box.y && place.y <= box.y + box.height;
    if (isIn && (!found || box.depth >= found.depth)) found = box;
  }
  return found;
}
