// All of the graph, small, with a frame around what is on the screen: there while not all is on it.

import { html } from 'htm/preact';
import { AlarmCount } from '../state/alarms.js';
import { MoveView, layout, size, view } from './graph_state.js';
import { VisibleArea } from './viewport.js';

const kMost = { width: 190, height: 130 };
const kAround = 30; // of the graph, around it

export function Minimap() {
  const { boxes, left: x, top: y, width, height } = layout.value;
  const seen = VisibleArea(view.value, size.value, 0);
  const isWhole = seen.left <= x && seen.top <= y && seen.right >= x + width && seen.bottom >= y + height;
  if (isWhole || boxes.size === 0 || size.value.width < 500) return null;
  const whole = { width: width + 2 * kAround, height: height + 2 * kAround };
  const scale = Math.min(kMost.width / whole.width, kMost.height / whole.height);
  const go = (event) => {
    const { left, top } = event.currentTarget.getBoundingClientRect();
    const place = { x: (event.clientX - left) / scale - kAround + x, y: (event.clientY - top) / scale - kAround + y };
    const { scale: zoom } = view.value;
    MoveView({ scale: zoom, x: size.value.width / 2 - zoom * place.x, y: size.value.height / 2 - zoom * place.y });
  };
  const down = (event) => { event.stopPropagation(); event.currentTarget.setPointerCapture(event.pointerId); go(event); };
  const paths = { group: '', box: '', alarmed: '' };
  for (const box of boxes.values()) {
    paths[box.open ? 'group' : AlarmCount(box.path) > 0 ? 'alarmed' : 'box'] +=
      `M${Math.round(box.x)},${Math.round(box.y)}h${Math.round(box.width)}v${Math.round(box.height)}h${-Math.round(box.width)}z`;
  }
  const [left, top] = [Math.max(seen.left, x - kAround), Math.max(seen.top, y - kAround)];
  const [right, bottom] = [Math.min(seen.right, x + width + kAround), Math.min(seen.bottom, y + height + kAround)];
  return html`<svg class="minimap" id="minimap" role="img" aria-label="All of the graph, and the part that is shown"
      width=${whole.width * scale} height=${whole.height * scale} viewBox=${`${x - kAround} ${y - kAround} ${whole.width} ${whole.height}`}
      onPointerDown=${down} onPointerMove=${(event) => { if (event.buttons & 1) { event.stopPropagation(); go(event); } }}>
    ${Object.entries(paths).map(([kind, path]) => html`<path key=${kind} class=${kind} d=${path} />`)}
    <rect class="seen" x=${left} y=${top} width=${Math.max(0, right - left)} height=${Math.max(0, bottom - top)}
      stroke-width=${1.5 / scale} />
  </svg>`;
}
