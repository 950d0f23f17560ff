// Driving with keys: W A S D or the arrows, while they are held.

import { useEffect } from 'preact/hooks';
import { html } from 'htm/preact';
import { canDrive } from '../../../page/source/state/store.js';
import { Drive, LetGo, held } from '../driving/driving.js';
import { PlaceOfWays, usePointerHold, useWays } from '../driving/held_by.js';
import { TwistText } from '../model/twist.js';
import { DriveOf, DrivingState } from './driving_state.js';

const kCaps = [['up', 'W'], ['left', 'A'], ['down', 'S'], ['right', 'D']];

/** A motion of those ways that are held. */
export function MotionOfWays(ways, { forward, turn }) {
  const { x, y } = PlaceOfWays(ways);
  return { forward: y * forward || 0, turn: -x * turn || 0 };
}

export function Keys({ widget }) {
  const { port, axes, problem } = DriveOf(widget);
  const path = port?.path;
  const rest = axes && TwistText(axes, { forward: 0, turn: 0 });
  const { ways, hold, onKey } = useWays({
    mine: held.value[widget.target] === widget.id, letters: true,
    change: (wanted) => {
      if (wanted.size === 0) return LetGo(widget.target, widget.id);
      return Boolean(path && axes) && Drive(path, widget.id, TwistText(axes, MotionOfWays(wanted, widget)), rest);
    },
  });
  useEffect(() => {
    const isForPanel = (event) => !event.target.closest?.('input, select, textarea, dialog, .world-canvas');
    const listen = (event) => onKey(event, isForPanel);
    document.addEventListener('keydown', listen);
    document.addEventListener('keyup', listen);
    return () => {
      document.removeEventListener('keydown', listen);
      document.removeEventListener('keyup', listen);
    };
  }, [path, rest, widget]);
  useEffect(() => () => LetGo(widget.target, widget.id), [widget.target, widget.id]);

  const isLocked = Boolean(problem) || !canDrive.value;
  return html`
    <div class="keys">
      <div class="key-caps" role="group" aria-label="Keys that drive while they are held">
        ${kCaps.map(([way, letter]) => html`<${KeyCap} key=${way} way=${way} letter=${letter} hold=${hold} isDown=${ways.has(way)} isLocked=${isLocked} />`)}
      </div>
      <${DrivingState} widget=${widget} problem=${problem} motion=${MotionOfWays(ways, widget)} />
    </div>`;
}

function KeyCap({ way, letter, hold, isDown, isLocked }) {
  const pointer = usePointerHold({ begin: () => hold(way, true), end: () => hold(way, false) });
  return html`<button class=${`key-cap key-${way} ${isDown ? 'pressed' : ''}`} data-way=${way} disabled=${isLocked} aria-label=${way} ...${pointer}>${letter}</button>`;
}
