// Two fingers on the graph: what is between them moves and grows with them.

import { ZoomAt } from './viewport.js';

export class Pinch {
  #fingers = new Map(); // pointer id -> place on the screen

  /** Returns whether there are two fingers now. */
  down(id, point) {
    this.#fingers.set(id, point);
    return this.#fingers.size === 2;
  }

  /** The function from the view before to the one after, or null if it is no pinch. */
  move(id, point) {
    const before = this.#fingers.get(id);
    if (!before) return null;
    const other = [...this.#fingers].find(([each]) => each !== id)?.[1];
    this.#fingers.set(id, point);
    if (!other || this.#fingers.size !== 2) return null;
    const factor = Distance(point, other) / Math.max(1, Distance(before, other));
    const middle = { x: (point.x + other.x) / 2, y: (point.y + other.y) / 2 };
    const [dx, dy] = [(point.x - before.x) / 2, (point.y - before.y) / 2];
    return (view) => ZoomAt({ ...view, x: view.x + dx, y: view.y + dy }, middle, factor);
  }

  up(id) {
    this.#fingers.delete(id);
  }
}

function Distance(a, b) {
  return Math.hypot(a.x - b.x, a.y - b.y);
}
