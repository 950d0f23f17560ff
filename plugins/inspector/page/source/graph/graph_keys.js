// The graph by keyboard. What is selected is where the keys are.

import { DeleteCarefully, DisconnectCarefully } from '../state/careful.js';
import { draft } from '../state/arrangement.js';
import { announcement, chosen, openDialog, selected } from '../state/choices.js';
import { canChange, structure } from '../state/store.js';
import { CanBeDeleted, IsGroup, ParentOf } from '../model/structure.js';
import { DescribeBox } from './box_view.js';
import { Fit, ShowElement, ToggleGroup, Zoom, band, connecting, layout, view } from './graph_state.js';
import { StopMoving } from './move_boxes.js';
import { StopConnecting } from './pointer.js';
import { DescribePort } from './port_view.js';

const kDirections = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1], ArrowDown: [0, 1] };

export function OnGraphKey(event) {
  // A dialog that has been asked for takes the focus only when it is drawn: keys are meant for it already.
  if (openDialog.value || event.ctrlKey || event.altKey || event.metaKey || event.target.closest('button')) return;
  const action = event.key in kDirections ? () => Go(event.key, event.shiftKey) : kKeys[event.key];
  if (!action) return;
  event.preventDefault();
  event.stopPropagation();
  // A key that is held walks and zooms, and does nothing else twice: after a deletion the group around is selected.
  if (!event.repeat || event.key in kDirections || kZoom.includes(event.key)) action();
}

const kZoom = ['+', '-'];

const kKeys = {
  Enter: () => { if (IsSelectedGroup()) ToggleGroup(selected.value); },
  ' ': () => { if (IsSelectedGroup()) ToggleGroup(selected.value); },
  Escape: () => { if (draft.value) StopMoving(); else if (connecting.value) StopConnecting(); else if (band.value) band.value = null; else selected.value = null; },
  Delete: DeleteSelected,
  Backspace: DeleteSelected,
  f: Fit,
  '+': () => Zoom(1.25),
  '-': () => Zoom(0.8),
  c: () => OpenFor('connect', (element) => element.kind === 'port'),
  s: () => OpenFor('swap', (element) => element.kind === 'module'),
  F2: () => OpenFor('rename', (element) => structure.isNode(element.path) && element.path !== structure.root),
  n: () => OpenFor('note', (element) => structure.isNode(element.path)),
  m: () => OpenFor('move', (element) => element.kind === 'module' || element.kind === 'group'),
  ContextMenu: OpenMenu,
  F10: OpenMenu,
};

function IsSelectedGroup() {
  const element = structure.get(selected.value);
  return element !== undefined && IsGroup(element);
}

function OpenFor(kind, suits) {
  const element = structure.get(selected.value);
  if (element && suits(element) && canChange.value) openDialog.value = { kind, path: element.path };
}

function OpenMenu() {
  const box = layout.value.boxes.get(structure.get(selected.value)?.owner ?? selected.value);
  const host = document.getElementById('graph').getBoundingClientRect();
  const { x, y, scale } = view.value;
  openDialog.value = { kind: 'menu', path: selected.value ?? structure.root,
    x: host.left + (box ? x + scale * (box.x + 30) : host.width / 2),
    y: host.top + (box ? y + scale * (box.y + 20) : host.height / 2) };
}

function DeleteSelected() {
  if (!canChange.value || !selected.value) return;
  if (chosen.value.length > 1) return DeleteCarefully(chosen.value);
  const connection = structure.connections.get(selected.value);
  const element = structure.get(selected.value);
  if (connection) DisconnectCarefully(connection.from, connection.to);
  else if (element && CanBeDeleted(element)) DeleteCarefully([element.path]);
  return undefined;
}

function Go(key, alongPorts) {
  const next = alongPorts ? NextPort(key) : NextBox(kDirections[key]);
  if (next) Select(next);
}

/** Selects what keys or a search have found, shows it, and says what it is. */
export function Select(path) {
  selected.value = path;
  const element = structure.get(path);
  const box = layout.value.boxes.get(element?.owner ?? path);
  ShowElement(element?.owner ?? path);
  if (element?.kind === 'port') announcement.value = DescribePort(element);
  else if (box) announcement.value = DescribeBox(box, element.thread);
}

/** The nearest box in a direction; those straight ahead count as nearer. Up and left out of a group leads to it. */
function NextBox([dx, dy]) {
  const boxes = [...layout.value.boxes.values()];
  const path = structure.get(selected.value)?.owner ?? selected.value;
  const here = layout.value.boxes.get(path) ?? layout.value.boxes.get(ParentOf(path ?? ''));
  if (!here) return boxes.find((box) => !box.open)?.path;
  const from = Middle(here);
  let best = null;
  let least = Infinity;
  for (const box of boxes) {
    if (box.path === here.path || here.path.startsWith(`${box.path}/`)) continue;
    const to = Middle(box);
    const ahead = (to.x - from.x) * dx + (to.y - from.y) * dy;
    const aside = Math.abs((to.x - from.x) * dy) + Math.abs((to.y - from.y) * dx);
    if (ahead <= 1 || aside > ahead * 4) continue;
    const cost = ahead + 2 * aside;
    if (cost < least) [best, least] = [box.path, cost];
  }
  const group = ParentOf(here.path);
  const leaves = dx < 0 || dy < 0;
  return leaves && layout.value.boxes.has(group) && !best?.startsWith(`${group}/`) ? group : best;
}

function Middle(box) {
  // Of an open group its bar is meant, not the middle of what it holds.
  return { x: box.x + box.width / 2, y: box.open ? box.y + 15 : box.y + box.height / 2 };
}

function NextPort(key) {
  const owner = structure.get(selected.value)?.owner ?? selected.value;
  const ports = structure.portsOf(owner).map((port) => port.path);
  if (ports.length === 0) return null;
  const at = ports.indexOf(selected.value);
  const step = key === 'ArrowUp' || key === 'ArrowLeft' ? -1 : 1;
  return ports[at < 0 ? 0 : (at + step + ports.length) % ports.length];
}
