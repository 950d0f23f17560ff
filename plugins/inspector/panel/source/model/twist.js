// A motion of the body, as a value of whatever type means one: a speed ahead and a turn, found by their units.

/** {forward, turn}: names of fields; null if the type has none. */
export function AxesOf(catalogue, typeName) {
  const fields = catalogue.type(typeName)?.fields ?? [];
  const forward = fields.find((field) => field.unit === 'm/s');
  const turn = fields.find((field) => field.unit === 'rad/s');
  return forward && turn ? { forward: forward.name, turn: turn.name } : null;
}

export function TwistText(axes, { forward, turn }) {
  return `{${axes.forward}: ${Round(forward)}, ${axes.turn}: ${Round(turn)}}`;
}

/**
 * Where a stick is ({x, y} within a circle of 1, x to the right, y up) as a motion: up is ahead, left turns left. Near the
 * middle nothing moves, and from there on it begins slowly.
 */
export function MotionOf({ x, y }, { forward, turn }) {
  const [ahead, left] = [Shaped(y), Shaped(-x)];
  return { forward: ahead * forward, turn: left * turn };
}

/** A place within the circle of 1. */
export function WithinCircle({ x, y }) {
  const far = Math.hypot(x, y);
  return far > 1 ? { x: x / far, y: y / far } : { x, y };
}

const kDead = 0.08;

function Shaped(axis) {
  const size = Math.abs(axis);
  if (size <= kDead) return 0;
  const way = (Math.min(1, size) - kDead) / (1 - kDead);
  return Math.sign(axis) * way * (0.4 + 0.6 * way);
}

function Round(number) {
  return Math.round(number * 1000) / 1000 || 0; // no -0
}
