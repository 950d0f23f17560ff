// Mouse, pen and touch on the graph: selecting, moving, zooming, connecting, menus.

import { Partners } from '../model/compatibility.js';
import { Connect } from '../state/actions.js';
import { canChange, structure } from '../state/store.js';
import { openDialog, selected } from '../state/choices.js';
import { BoxAt, MoveView, ToggleGroup, candidates, connecting, layout, shown, view } from './graph_state.js';
import { hovered } from './hover_card.js';
import { ToGraph, ZoomAt } from './viewport.js';

const kReach = 26;     // pixels from a port at which a new edge snaps to it
const kDragFrom = 4;   // pixels before a press becomes a drag

export function AttachPointer(host) {
  const pointer = new Pointer(host);
  const attached = new AbortController();
  const handlers = {
    pointerdown: (event) => pointer.down(event),
    pointermove: (event) => pointer.move(event),
    pointerup: (event) => pointer.up(event),
    pointercancel: () => pointer.end(),
    pointerleave: () => { hovered.value = null; },
    contextmenu: (event) => pointer.menu(event),
    dblclick: (event) => pointer.doubleClick(event),
    wheel: (event) => pointer.wheel(event),
  };
  for (const [name, handler] of Object.entries(handlers)) {
    host.addEventListener(name, handler, { passive: false, signal: attached.signal });
  }
  return () => attached.abort();
}

class Pointer {
  #host;
  #press = null; // {kind: 'pan' | 'connect', start, view}

  constructor(host) {
    this.#host = host;
  }

  down(event) {
    if (event.button > 1 || event.target.closest('button, output, input')) return;
    const point = this.#point(event);
    const hit = this.#hit(event);
    this.#press = { kind: 'pan', start: point, view: view.value, hit, moved: false };
    if (hit.port && event.button === 0 && canChange.value) this.#press.kind = 'connect';
    this.#host.setPointerCapture(event.pointerId);
  }

  move(event) {
    const point = this.#point(event);
    const press = this.#press;
    if (!press) {
      const path = PortAt(event.clientX, event.clientY)?.dataset.port;
      hovered.value = path ? { path, ...point } : null;
      return;
    }
    const [dx, dy] = [point.x - press.start.x, point.y - press.start.y];
    if (!press.moved && Math.hypot(dx, dy) < kDragFrom) return;
    if (!press.moved) {
      press.moved = true;
      hovered.value = null;
      if (press.kind === 'connect') BeginConnecting(press.hit.port);
    }
    if (press.kind === 'connect') DragTo(ToGraph(view.value, point));
    else MoveView({ ...press.view, x: press.view.x + dx, y: press.view.y + dy });
  }

  up() {
    const press = this.#press;
    this.#press = null;
    if (!press) return;
    if (press.moved) {
      if (press.kind === 'connect') FinishConnecting();
      return;
    }
    const { fold, port, edge, node } = press.hit;
    if (fold) ToggleGroup(fold);
    else selected.value = port ?? edge ?? node ?? null;
  }

  end() {
    this.#press = null;
    StopConnecting();
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
    const { node } = this.#hit(event);
    if (node && structure.get(node)?.kind === 'group') ToggleGroup(node);
    else if (!node && canChange.value) openDialog.value = { kind: 'create', group: structure.root };
  }

  menu(event) {
    event.preventDefault();
    const { port, edge, node } = this.#hit(event);
    const path = port ?? edge ?? node ?? structure.root;
    if (!path) return;
    if (path !== structure.root) selected.value = path;
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
    let { node, edge } = target?.dataset ?? {};
    const isFrame = node && layout.value.boxes.get(node)?.open;
    if (!edge && !port && !fold && (!node || isFrame)) {
      for (const [dx, dy] of [[0, -4], [0, 4], [-4, 0], [4, 0]]) {
        edge ??= at(x + dx, y + dy, '[data-edge]')?.dataset.edge;
      }
    }
    return { fold, port, edge, node };
  }
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

/** Lights up the ports that `port` can be connected with. */
function BeginConnecting(port) {
  candidates.value = new Map(Partners(structure, port).map(({ port: other, ends }) => [other.path, ends]));
  connecting.value = { port, pointer: null, target: null };
}

function DragTo(pointer) {
  let target = null;
  let nearest = kReach / Math.min(1, view.value.scale);
  for (const path of candidates.value.keys()) {
    const place = layout.value.ports.get(path);
    const distance = place ? Math.hypot(place.x - pointer.x, place.y - pointer.y) : Infinity;
    if (distance < nearest) [target, nearest] = [path, distance];
  }
  connecting.value = { ...connecting.value, pointer, target };
}

function FinishConnecting() {
  const ends = candidates.value?.get(connecting.value?.target);
  StopConnecting();
  if (ends) Connect(ends.from, ends.to);
}

export function StopConnecting() {
  connecting.value = null;
  candidates.value = null;
}
