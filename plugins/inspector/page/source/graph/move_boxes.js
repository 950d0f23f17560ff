// Boxes that are moved by hand: with the first one all others of its group stay where they are.

import { Arrange } from '../state/actions.js';
import { PlaceEntries, draft, places } from '../state/arrangement.js';
import { chosen } from '../state/choices.js';
import { structure } from '../state/store.js';
import { Outermost } from '../model/copies.js';
import { ParentOf } from '../model/structure.js';
import { MoveView, layout, view } from './graph_state.js';

const kGrid = 4;

/** The boxes that a drag of `path` moves: all that are chosen, if it is among them. */
export function BeginMoving(path) {
  const moved = chosen.value.includes(path) ? Outermost(chosen.value.filter((each) => layout.value.boxes.has(each))) : [path];
  MoveView(view.value); // which does not follow the layout meanwhile
  const before = new Map();
  for (const group of new Set(moved.map(ParentOf))) {
    const { x, y } = layout.value.boxes.get(group) ?? { x: 0, y: 0 };
    for (const member of structure.membersOf(group)) {
      const box = layout.value.boxes.get(member);
      if (box) before.set(member, { x: box.x - x, y: box.y - y });
    }
  }
  return { moved: new Set(moved), before, put: places.value };
}

export function MoveTo({ moved, before }, dx, dy) {
  const [x, y] = [dx, dy].map((by) => Math.round(by / kGrid) * kGrid);
  draft.value = new Map([...before].map(([path, place]) =>
    [path, moved.has(path) ? { x: place.x + x, y: place.y + y } : place]));
}

/** What another viewer has moved meanwhile stays there. */
export function FinishMoving({ moved, put }) {
  const next = [...draft.value ?? []].filter(([path]) => moved.has(path) || places.value.get(path) === put.get(path));
  if (next.length > 0) Arrange(PlaceEntries(next));
  draft.value = null;
}

export function StopMoving() {
  draft.value = null;
}

/** Whether boxes of a group have been moved. */
export function IsArranged(group) {
  return structure.membersOf(group).some((path) => places.value.has(path));
}

/** The boxes of a group go back to where the data flow puts them. */
export function ArrangeAutomatically(group) {
  Arrange(PlaceEntries(new Map(structure.membersOf(group).map((path) => [path, null]))));
}
