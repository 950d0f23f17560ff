// Where the world is on the canvas: x to the right, y up, metres. {x, y} is the place of the world in
// the middle of the canvas, scale is pixels per metre.

export function ToCanvas(camera, size, place) {
  return {
    x: size.width / 2 + (place.x - camera.x) * camera.scale,
    y: size.height / 2 - (place.y - camera.y) * camera.scale,
  };
}

export function ToWorld(camera, size, point) {
  return {
    x: camera.x + (point.x - size.width / 2) / camera.scale,
    y: camera.y - (point.y - size.height / 2) / camera.scale,
  };
}

export function ZoomCamera(camera, size, point, factor) {
  const scale = Math.min(2000, Math.max(2, camera.scale * factor));
  const before = ToWorld(camera, size, point);
  const after = ToWorld({ ...camera, scale }, size, point);
  return { scale, x: camera.x + before.x - after.x, y: camera.y + before.y - after.y };
}

/** Shows an area {left, right, bottom, top} whole. */
export function FitCamera(area, size, margin = 14) {
  const width = Math.max(0.5, area.right - area.left);
  const height = Math.max(0.5, area.top - area.bottom);
  return {
    x: (area.left + area.right) / 2,
    y: (area.bottom + area.top) / 2,
    scale: Math.max(2, Math.min((size.width - 2 * margin) / width, (size.height - 2 * margin) / height)),
  };
}

/** The area that all points are in, or null without points. */
export function AreaOf(points) {
  let area = null;
  for (const { x, y } of points) {
    if (!Number.isFinite(x) || !Number.isFinite(y)) continue;
    area ??= { left: x, right: x, bottom: y, top: y };
    area.left = Math.min(area.left, x);
    area.right = Math.max(area.right, x);
    area.bottom = Math.min(area.bottom, y);
    area.top = Math.max(area.top, y);
  }
  return area;
}

/** A distance that a grid can have: 1, 2 or 5 times a power of ten, at least `least` pixels wide. */
export function GridStep(scale, least = 28) {
  const wanted = least / scale;
  const power = 10 ** Math.floor(Math.log10(wanted));
  return [1, 2, 5, 10].map((factor) => factor * power).find((step) => step >= wanted);
}
