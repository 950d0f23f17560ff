// Driving with keys: W A S D or the arrows, while they are held.

import { useEffect, useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { canDrive } from '../../../page/source/state/store.js';
import { Drive, LetGo, held } from '../driving/driving.js';
import { TwistText } from '../model/twist.js';
import { isEditing } from '../panel_state.js';
import { DriveOf, DrivingState } from './driving_state.js';

const kWays = { KeyW: 'up', ArrowUp: 'up', KeyS: 'down', ArrowDown: 'down', KeyA: 'left', ArrowLeft: 'left', KeyD: 'right', ArrowRight: 'right' };
const kCaps = [['up', 'W'], ['left', 'A'], ['down', 'S'], ['right', 'D']];

/** A motion of those ways that are held: opposite ones are none. */
export function MotionOfWays(ways, { forward, turn }) {
  const axis = (plus, minus) => (ways.has(plus) ? 1 : 0) - (ways.has(minus) ? 1 : 0);
  return { forward: axis('up', 'down') * forward || 0, turn: axis('left', 'right') * turn || 0 };
}

export function Keys({ widget }) {
  const { port, axes, problem } = DriveOf(widget);
  const [ways, setWays] = useState(new Set());
  const down = useRef(new Set()); // ways that are held, also for what happens between two drawings
  const mine = held.value[widget.target] === widget.id;
  const path = port?.path;
  const rest = axes && TwistText(axes, { forward: 0, turn: 0 });

  const hold = (way, isDown) => {
    if (isDown === down.current.has(way)) return;
    down.current[isDown ? 'add' : 'delete'](way);
    const wanted = axes && TwistText(axes, MotionOfWays(down.current, widget));
    if (down.current.size === 0) LetGo(widget.target, widget.id);
    else if (!path || !Drive(path, widget.id, wanted, rest)) down.current.clear();
    setWays(new Set(down.current));
  };
  useEffect(() => {
    if (mine) return;
    down.current.clear();
    setWays(new Set());
  }, [mine]);
  useEffect(() => {
    const onKey = (event) => {
      const way = kWays[event.code];
      if (!way || event.repeat || event.ctrlKey || event.altKey || event.metaKey) return;
      if (event.type === 'keydown' && (isEditing.value || event.target.closest?.('input, select, textarea, dialog, .world-canvas'))) return;
      if (event.type === 'keydown') event.preventDefault();
      hold(way, event.type === 'keydown');
    };
    document.addEventListener('keydown', onKey);
    document.addEventListener('keyup', onKey);
    return () => {
      document.removeEventListener('keydown', onKey);
      document.removeEventListener('keyup', onKey);
    };
  }, [path, rest, widget]);
  useEffect(() => () => LetGo(widget.target, widget.id), [widget.target, widget.id]);

  return html`
    <div class="keys">
      <div class="key-caps" role="group" aria-label="Keys that drive while they are held">
        ${kCaps.map(([way, letter]) => html`<button key=${way} class=${`key-cap key-${way} ${ways.has(way) ? 'pressed' : ''}`} data-way=${way}
          disabled=${Boolean(problem) || !canDrive.value} aria-label=${way} onContextMenu=${(event) => event.preventDefault()}
          onPointerDown=${(event) => { event.currentTarget.setPointerCapture(event.pointerId); hold(way, true); }}
          onPointerUp=${() => hold(way, false)} onPointerCancel=${() => hold(way, false)}>${letter}</button>`)}
      </div>
      <${DrivingState} widget=${widget} problem=${problem} motion=${MotionOfWays(ways, widget)} />
    </div>`;
}
