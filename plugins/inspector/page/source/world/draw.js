// Draws what the layers of a world hold, on a canvas. Colours come from style.css.

import { GridStep, ToCanvas, ToWorld } from './camera.js';
import { ScanEnds, SeenFrom } from './scan_geometry.js';

/** `context` of the canvas, `colours` by name, `camera`, `size`, `radius` of the robot. */
export function DrawWorld(drawing, layers, values, trail) {
  const { context, colours, size } = drawing;
  context.clearRect(0, 0, size.width, size.height);
  context.fillStyle = colours.ground;
  context.fillRect(0, 0, size.width, size.height);
  context.lineJoin = context.lineCap = 'round';
  const map = layers.find((layer) => layer.meaning === 'world_map' && values.has(layer.port));
  if (map) DrawMap(drawing, values.get(map.port));
  DrawGrid(drawing);
  if (trail.length > 1) DrawPath(drawing, trail);
  let pose = 0;
  for (const layer of layers) {
    const value = values.get(layer.port);
    if (!value) continue;
    const from = layer.pose ? values.get(layer.pose) : null;
    if (layer.meaning === 'path') DrawPath(drawing, value.points);
    if (layer.meaning === 'hit_and_leave_points') DrawHitsAndLeaves(drawing, value);
    if (layer.meaning === 'range_scan' && from) DrawScan(drawing, value, from);
    if (layer.meaning === 'drawing') DrawItems(drawing, value, from);
    if (layer.meaning === 'point') DrawPoint(drawing, value);
    if (layer.meaning === 'pose') DrawPose(drawing, value, pose++);
    if (layer.meaning === 'contact' && from) DrawContact(drawing, value, from);
  }
  DrawScale(drawing);
}

/** Outlines in their order: a hole is in those before it, which may overlap. */
function DrawMap(drawing, map) {
  const { context, colours } = drawing;
  context.lineWidth = 1;
  context.strokeStyle = colours.wallEdge;
  for (const { points, is_hole: isHole } of map.outlines ?? []) {
    Outline(drawing, points);
    context.fillStyle = isHole ? colours.ground : colours.wall;
    context.fill();
    context.stroke();
  }
  if (map.bounds?.length > 2) {
    Outline(drawing, map.bounds);
    context.setLineDash([6, 4]);
    context.stroke();
    context.setLineDash([]);
  }
}

/** Begins a path through places of the world. */
function Trace({ context, camera, size }, places) {
  context.beginPath();
  for (const place of places) {
    const { x, y } = ToCanvas(camera, size, place);
    context.lineTo(x, y); // the first one only begins it
  }
}

function Outline(drawing, points) {
  Trace(drawing, points);
  drawing.context.closePath();
}

function DrawGrid({ context, colours, camera, size }) {
  const step = GridStep(camera.scale);
  const from = ToWorld(camera, size, { x: 0, y: size.height });
  const to = ToWorld(camera, size, { x: size.width, y: 0 });
  context.strokeStyle = colours.grid;
  context.lineWidth = 1;
  context.beginPath();
  for (let x = Math.ceil(from.x / step) * step; x <= to.x; x += step) {
    const at = Math.round(ToCanvas(camera, size, { x, y: 0 }).x) + 0.5;
    context.moveTo(at, 0);
    context.lineTo(at, size.height);
  }
  for (let y = Math.ceil(from.y / step) * step; y <= to.y; y += step) {
    const at = Math.round(ToCanvas(camera, size, { x: 0, y }).y) + 0.5;
    context.moveTo(0, at);
    context.lineTo(size.width, at);
  }
  context.stroke();
}

function DrawPath(drawing, points = []) {
  const { context, colours } = drawing;
  Trace(drawing, points);
  context.strokeStyle = colours.path;
  context.lineWidth = 2;
  context.stroke();
}

function DrawScan(drawing, scan, pose) {
  const { context, colours, camera, size } = drawing;
  const ends = ScanEnds(scan, pose);
  Outline(drawing, [pose, ...ends]);
  context.fillStyle = colours.scan;
  context.fill();
  context.fillStyle = colours.echo;
  for (const end of ends) {
    if (!end.isEcho) continue;
    const { x, y } = ToCanvas(camera, size, end);
    context.fillRect(x - 1.25, y - 1.25, 2.5, 2.5);
  }
}

/** What a module draws: in the world, or, as its frame says, as seen from the robot's pose. */
export function DrawItems(drawing, { frame, items = [] }, pose) {
  if (frame && !pose) return;
  const { context, camera, size } = drawing;
  for (const item of items) {
    const places = frame ? item.points.map((point) => SeenFrom(pose, point)) : item.points;
    if (places.length === 0) continue;
    const { red, green, blue, alpha } = item.colour;
    const colour = `rgba(${[red, green, blue].map((part) => Math.round(255 * part)).join(',')},${alpha})`;
    context.fillStyle = context.strokeStyle = colour;
    const extent = Math.max(1, item.size * camera.scale);
    if (item.kind === 'points') {
      for (const place of places) {
        const { x, y } = ToCanvas(camera, size, place);
        context.beginPath();
        context.arc(x, y, Math.max(1.5, extent / 2), 0, 2 * Math.PI);
        context.fill();
      }
    } else if (item.kind === 'text') {
      const { x, y } = ToCanvas(camera, size, places[0]);
      context.font = `${Math.max(9, extent)}px system-ui, sans-serif`;
      context.textAlign = 'left';
      context.fillText(item.text, x, y);
    } else {
      Trace(drawing, places);
      if (item.kind === 'closed_line') context.closePath();
      context.lineWidth = extent;
      context.stroke();
    }
  }
}

function DrawHitsAndLeaves({ context, colours, camera, size }, { hits = [], leaves = [] }) {
  const mark = (points, colour, letter, down) => points.forEach((point, index) => {
    const { x, y } = ToCanvas(camera, size, point);
    context.fillStyle = colour;
    context.strokeStyle = colours.ground;
    context.lineWidth = 1.5;
    context.beginPath();
    context.moveTo(x, y + (down ? 5 : -5));
    context.lineTo(x - 5, y - (down ? 4 : -4));
    context.lineTo(x + 5, y - (down ? 4 : -4));
    context.closePath();
    context.stroke();
    context.fill();
    context.font = '600 10px system-ui, sans-serif';
    context.textAlign = 'center';
    context.lineWidth = 3;
    context.strokeText(`${letter}${index + 1}`, x, y + (down ? -8 : 15));
    context.fillText(`${letter}${index + 1}`, x, y + (down ? -8 : 15));
  });
  mark(hits, colours.hit, 'H', true);
  mark(leaves, colours.leave, 'L', false);
}

function DrawPoint({ context, colours, camera, size }, point) {
  if (!Number.isFinite(point.x) || !Number.isFinite(point.y)) return;
  const { x, y } = ToCanvas(camera, size, point);
  context.strokeStyle = colours.goal;
  context.lineWidth = 2;
  context.beginPath();
  context.arc(x, y, 7, 0, 2 * Math.PI);
  context.moveTo(x + 2.5, y);
  context.arc(x, y, 2.5, 0, 2 * Math.PI);
  context.stroke();
}

/** The first pose is the robot; others (where it believes to be) are outlines. */
function DrawPose({ context, colours, camera, size, radius }, pose, number) {
  const { x, y } = ToCanvas(camera, size, pose);
  const r = Math.max(5, radius * camera.scale) + (number > 0 ? 2.5 : 0);
  context.save();
  context.translate(x, y);
  context.rotate(-pose.heading);
  context.beginPath();
  context.arc(0, 0, r, 0, 2 * Math.PI);
  if (number === 0) {
    context.fillStyle = colours.robot;
    context.fill();
    context.beginPath();
    context.moveTo(r * 0.72, 0);
    context.lineTo(-r * 0.35, r * 0.5);
    context.lineTo(-r * 0.1, 0);
    context.lineTo(-r * 0.35, -r * 0.5);
    context.closePath();
    context.fillStyle = colours.ground;
    context.fill();
  } else {
    context.setLineDash([3, 3]);
    context.strokeStyle = colours.robot;
    context.lineWidth = 1.25;
    context.stroke();
  }
  context.restore();
}

function DrawContact({ context, colours, camera, size, radius }, contact, pose) {
  if (!Object.values(contact).includes(true)) return;
  const { x, y } = ToCanvas(camera, size, pose);
  context.beginPath();
  context.arc(x, y, Math.max(5, radius * camera.scale) + 5, 0, 2 * Math.PI);
  context.strokeStyle = colours.hit;
  context.lineWidth = 3;
  context.stroke();
}

function DrawScale({ context, colours, camera, size }) {
  const step = GridStep(camera.scale, 48);
  const length = step * camera.scale;
  const [x, y] = [12, size.height - 12];
  context.strokeStyle = context.fillStyle = colours.text;
  context.lineWidth = 1.5;
  context.beginPath();
  context.moveTo(x, y - 4);
  context.lineTo(x, y);
  context.lineTo(x + length, y);
  context.lineTo(x + length, y - 4);
  context.stroke();
  context.font = '11px system-ui, sans-serif';
  context.textAlign = 'left';
  context.fillText(`${Number(step.toPrecision(2))} m`, x + length + 6, y + 1);
}
