// Where what is seen from a pose is in the world.

/** Where the rays of a scan end; isEcho: at something. */
export function ScanEnds(scan, pose) {
  return scan.ranges.map((range, index) => {
    const isEcho = Number.isFinite(range) && range >= scan.range_minimum && range < scan.range_maximum;
    const reach = isEcho ? range : scan.range_maximum;
    const angle = pose.heading + scan.start_angle + index * scan.angle_step;
    return { x: pose.x + reach * Math.cos(angle), y: pose.y + reach * Math.sin(angle), isEcho };
  });
}

/** A place that is told as seen from a pose, x ahead and y to the left, in the world. */
export function SeenFrom(pose, { x, y }) {
  const [cos, sin] = [Math.cos(pose.heading), Math.sin(pose.heading)];
  return { x: pose.x + cos * x - sin * y, y: pose.y + sin * x + cos * y };
}
