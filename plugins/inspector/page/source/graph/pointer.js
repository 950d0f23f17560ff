// Mouse, pen and touch on the graph: selecting, moving, zooming, connecting, menus.

import { Outermost } from '../model/copies.js';
import { Partners } from '../model/compatibility.js';
import { Connect } from '../state/actions.js';
import { ConnectOtherwise } from '../state/connecting.js';
import { canChange, structure } from '../state/store.js';
import { draft } from '../state/arrangement.js';
import { Choose, SetPanels, chosen, openDialog, selected } from '../state/choices.js';
import { isNarrow } from '../state/window.js';
import { BoxAt, MoveView, ToggleGroup, band, candidates, connecting, layout, shown, view } from './graph_state.js';
import { hovered } from './hover_card.js';
import { kGroupHeader } from './measure.js';
import { BeginMoving, FinishMoving, MoveTo, StopMoving } from './move_boxes.js';
import { Pinch } from './pinch.js';
import { ToGraph, ZoomAt } from './viewport.js';

const kReach = 26;     // pixels from a port at which a new edge snaps to it
const kDragFrom = 4;   // pixels before a press becomes a drag
const kBeside = 'button, output, input, .minimap'; // what lies over the graph

export function AttachPointer(host) {
  const pointer = new Pointer(host);
  const attached = new AbortController();
  const handlers = {
    pointerdown: (event) => pointer.down(event),
    pointermove: (event) => pointer.move(event),
    pointerup: (event) => pointer.up(event),
    pointercancel: (event) => pointer.cancel(event),
    pointerleave: () => { hovered.value = null; },
    contextmenu: (event) => pointer.menu(event),
    dblclick: (event) => pointer.doubleClick(event),
    wheel: (event) => pointer.wheel(event),
  };
  for (const [name, handler] of Object.entries(handlers)) {
    host.addEventListener(name, handler, { passive: false, signal: attached.signal });
  }
  return () => { attached.abort(); pointer.end(); };
}

class Pointer {
  #host;
  #pinch = new Pinch();
  #press = null; // {kind: 'pan' | 'connect', start, view}

  constructor(host) {
    this.#host = host;
  }

  down(event) {
    if (event.pointerType === 'touch' && this.#pinch.down(event.pointerId, this.#point(event))) {
      this.#host.setPointerCapture(event.pointerId); // what is under the finger may go meanwhile, and its end must be heard
      return this.end();
    }
    if (event.button > 1 || event.target.closest(kBeside)) return;
    const point = this.#point(event);
    const hit = this.#hit(event);
    this.#press = { kind: this.#kindOf(event, hit), start: point, view: view.value, hit, moved: false, adds: event.shiftKey };
    this.#host.setPointerCapture(event.pointerId);
  }

  /** What a drag from there does. */
  #kindOf(event, { port, node, bar }) {
    if (event.button !== 0) return 'pan';
    if (port) return canChange.value ? 'connect' : 'pan';
    const isFrame = node && layout.value.boxes.get(node)?.open;
    if (event.shiftKey && (!node || isFrame)) return 'band';
    if (!node || (isFrame && !bar) || shown.value.far) return 'pan';
    // A finger moves the view, but for a box that is chosen.
    return event.pointerType === 'touch' && !chosen.value.includes(node) ? 'pan' : 'move';
  }

  move(event) {
    const point = this.#point(event);
    const pinched = this.#pinch.move(event.pointerId, point);
    if (pinched) return MoveView(pinched(view.value));
    const press = this.#press;
    if (!press) {
      const path = PortAt(event.clientX, event.clientY)?.dataset.port;
      hovered.value = path ? { path, ...point } : null;
      return;
    }
    const [dx, dy] = [point.x - press.start.x, point.y - press.start.y];
    if (!press.moved && Math.hypot(dx, dy) < kDragFrom) return;
    if (press.moved && IsTakenBack(press)) return this.end();
    if (!press.moved) {
      press.moved = true;
      hovered.value = null;
      if (press.kind === 'connect') BeginConnecting(press.hit.port);
      if (press.kind === 'move') press.moving = BeginMoving(press.hit.node);
    }
    if (press.kind === 'connect') DragTo(ToGraph(view.value, point));
    else if (press.kind === 'move') MoveTo(press.moving, dx / view.value.scale, dy / view.value.scale);
    else if (press.kind === 'band') DrawBand(ToGraph(view.value, press.start), ToGraph(view.value, point));
    else MoveView({ ...press.view, x: press.view.x + dx, y: press.view.y + dy });
  }

  up(event) {
    this.#pinch.up(event.pointerId);
    const press = this.#press;
    this.#press = null;
    if (!press) return;
    if (press.moved) {
      if (press.kind === 'connect') FinishConnecting();
      if (press.kind === 'move') FinishMoving(press.moving);
      if (press.kind === 'band' && band.value) FinishBand();
      return;
    }
    const { fold, port, edge, node } = press.hit;
    if (fold) ToggleGroup(fold);
    else if (press.adds && node && !port && !edge) Choose(Toggled(chosen.value, node));
    else {
      selected.value = port ?? edge ?? node ?? null;
      if (selected.value && isNarrow.value) SetPanels({ sideOpen: true });
    }
  }

  cancel(event) {
    this.#pinch.up(event.pointerId);
    this.end();
  }

  end() {
    this.#press = null;
    StopConnecting();
    StopMoving();
    band.value = null;
  }

  wheel(event) {
    event.preventDefault();
    const unit = event.deltaMode === 1 ? 16 : 1;
    if (event.shiftKey && !event.ctrlKey) {
      MoveView({ ...view.value, x: view.value.x - (event.deltaX || event.deltaY) * unit });
      return;
    }
    const speed = event.ctrlKey ? 0.008 : 0.0015; // two fingers on a touchpad come with Ctrl, and in small steps
    MoveView(ZoomAt(view.value, this.#point(event), Math.exp(-event.deltaY * unit * speed)));
  }

  doubleClick(event) {
    if (event.target.closest(kBeside)) return; // two quick presses there
    const { node, edge } = this.#hit(event);
    if (node && structure.get(node)?.kind === 'group') ToggleGroup(node);
    else if (!node && !edge && canChange.value) openDialog.value = { kind: 'create', group: structure.root };
  }

  menu(event) {
    event.preventDefault();
    const { port, edge, node } = this.#hit(event);
    const path = port ?? edge ?? node ?? structure.root;
    if (!path) return;
    if (path !== structure.root && !chosen.value.includes(path)) selected.value = path;
    openDialog.value = { kind: 'menu', path, x: event.clientX, y: event.clientY };
  }

  #point(event) {
    const box = this.#host.getBoundingClientRect();
    return { x: event.clientX - box.left, y: event.clientY - box.top };
  }

  /** What is under the pointer; edges are found some pixels beside them, too. */
  #hit(event) {
    const at = (x, y, what) => document.elementFromPoint(x, y)?.closest?.(what);
    const { clientX: x, clientY: y } = event;
    const { fold, port } = PortAt(x, y)?.dataset ?? {};
    const target = at(x, y, '[data-node], [data-edge]');
    const place = ToGraph(view.value, this.#point(event));
    if (shown.value.far) return { node: BoxAt(place)?.path };
    const bar = target?.querySelector?.(':scope > .bar') && place.y < (layout.value.boxes.get(target.dataset.node)?.y ?? 0) + kGroupHeader;
    let { node, edge } = target?.dataset ?? {};
    const isFrame = node && layout.value.boxes.get(node)?.open;
    if (!edge && !port && !fold && (!node || isFrame)) {
      for (const [dx, dy] of [[0, -4], [0, 4], [-4, 0], [4, 0]]) {
        edge ??= at(x + dx, y + dy, '[data-edge]')?.dataset.edge;
      }
    }
    return { fold, port, edge, node, bar };
  }
}

/** Whether Escape has ended what is dragged. */
function IsTakenBack({ kind }) {
  return (kind === 'connect' && !connecting.value) || (kind === 'move' && !draft.value) || (kind === 'band' && !band.value);
}

/** The port, or the handle of a group, at a place of the screen, even if an edge ends on top of it. */
function PortAt(x, y) {
  for (const element of document.elementsFromPoint(x, y)) {
    const found = element.closest('[data-port], [data-fold]');
    if (found) return found;
    if (!element.closest('[data-edge]')) return null;
  }
  return null;
}

function Toggled(paths, path) {
  return paths.includes(path) ? paths.filter((each) => each !== path) : [...paths.filter((each) => structure.isNode(each)), path];
}

function DrawBand(a, b) {
  band.value = { left: Math.min(a.x, b.x), right: Math.max(a.x, b.x), top: Math.min(a.y, b.y), bottom: Math.max(a.y, b.y) };
}

/** Chooses what the band touches; groups that are open only if all of them is in it. */
function FinishBand() {
  const { left, top, right, bottom } = band.value;
  band.value = null;
  const touched = [...layout.value.boxes.values()].filter((box) => (box.open
    ? box.x >= left && box.y >= top && box.x + box.width <= right && box.y + box.height <= bottom
    : box.x <= right && box.y <= bottom && box.x + box.width >= left && box.y + box.height >= top));
  Choose(Outermost(touched.map((box) => box.path)));
}

/** Lights up the ports that `port` can be connected with. */
function BeginConnecting(port) {
  candidates.value = new Map(Partners(structure, port).map(({ port: other, ends }) => [other.path, ends]));
  connecting.value = { port, pointer: null, target: null };
}

/** The port that is meant is the nearest one, whether it suits or not: never a neighbour of it that does. */
function DragTo(pointer) {
  const { port } = connecting.value;
  let meant = null;
  let nearest = kReach / Math.min(1, view.value.scale);
  for (const [path, place] of layout.value.ports) {
    const distance = Math.hypot(place.x - pointer.x, place.y - pointer.y);
    if (path !== port && distance < nearest) [meant, nearest] = [path, distance];
  }
  const suits = candidates.value.has(meant);
  connecting.value = { port, pointer, target: suits ? meant : null, blocked: suits ? null : meant };
}

function FinishConnecting() {
  const { port, target, blocked } = connecting.value ?? {};
  const ends = candidates.value?.get(target);
  StopConnecting();
  if (ends) Connect(ends.from, ends.to);
  else if (blocked) ConnectOtherwise(port, blocked);
}

export function StopConnecting() {
  connecting.value = null;
  candidates.value = null;
}
