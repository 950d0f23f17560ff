// The curves of connections, as SVG path data. Data leaves boxes to the right and enters from the
// left; what flows back runs in a lane below the boxes.

/** From port to port, through the passages that the layout has left for it. */
export function ForwardPath(start, end, bends = []) {
  let path = `M${R(start.x)},${R(start.y)}`;
  let from = start;
  for (const bend of bends) {
    const enter = { x: Math.max(from.x + 12, bend.x - 40), y: bend.y };
    path += Curve(from, enter);
    from = { x: Math.max(enter.x, bend.x + 40), y: bend.y };
    path += `H${R(from.x)}`;
  }
  return path + Curve(from, end);
}

/** Against the flow, without a lane: a wide bow. */
export function BowPath(start, end) {
  const reach = Math.max(60, Math.min(220, Math.abs(start.x - end.x) / 2));
  return `M${R(start.x)},${R(start.y)}C${R(start.x + reach)},${R(start.y)} ` +
    `${R(end.x - reach)},${R(end.y)} ${R(end.x)},${R(end.y)}`;
}

/** Against the flow: right, down to the lane, left, up, in. */
export function LanePath(start, end, { right, left, lane }) {
  const corner = 8;
  const down = lane >= start.y ? 1 : -1;
  const up = end.y <= lane ? -1 : 1;
  return `M${R(start.x)},${R(start.y)}H${R(right - corner)}` +
    `q${corner},0 ${corner},${corner * down}V${R(lane - corner * down)}` +
    `q0,${corner * down} ${-corner},${corner * down}H${R(left + corner)}` +
    `q${-corner},0 ${-corner},${corner * up}V${R(end.y - corner * up)}` +
    `q0,${corner * up} ${corner},${corner * up}H${R(end.x)}`;
}

/** Straight lines along the axes, with round corners. */
export function CornerPath(points) {
  const most = 8;
  let path = `M${R(points[0].x)},${R(points[0].y)}`;
  for (let i = 1; i < points.length - 1; ++i) {
    const [before, at, after] = [points[i - 1], points[i], points[i + 1]];
    const radius = Math.min(most, Distance(before, at) / 2, Distance(at, after) / 2);
    const [enter, leave] = [Towards(at, before, radius), Towards(at, after, radius)];
    path += `L${R(enter.x)},${R(enter.y)}Q${R(at.x)},${R(at.y)} ${R(leave.x)},${R(leave.y)}`;
  }
  const end = points.at(-1);
  return `${path}L${R(end.x)},${R(end.y)}`;
}

function Distance(a, b) {
  return Math.abs(a.x - b.x) + Math.abs(a.y - b.y);
}

function Towards(at, other, distance) {
  return { x: at.x + Math.sign(other.x - at.x) * distance, y: at.y + Math.sign(other.y - at.y) * distance };
}

function Curve(from, to) {
  const distance = to.x - from.x;
  const reach = distance >= 24 ? distance / 2 : Math.max(40, Math.abs(to.y - from.y) / 3);
  return `C${R(from.x + reach)},${R(from.y)} ${R(to.x - reach)},${R(to.y)} ${R(to.x)},${R(to.y)}`;
}

function R(number) {
  return Math.round(number * 10) / 10;
}
