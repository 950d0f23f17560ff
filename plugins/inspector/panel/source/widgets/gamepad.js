// Driving with a gamepad: its left stick, while a shoulder button is held.

import { useEffect, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { Drive, LetGo, held } from '../driving/driving.js';
import { MotionOf, TwistText, WithinCircle } from '../model/twist.js';
import { DriveOf, DrivingState } from './driving_state.js';

const kShoulders = [4, 5, 6, 7]; // of the standard layout
const kStill = { forward: 0, turn: 0 };
const kPeriod = 40; // ms, between two looks

/**
 * {id, name, isHeld, stick, isStandard} of the first gamepad there is, those of the standard layout before others, or null. Which
 * buttons another one has at the places of the shoulders nobody knows: they may be switches that stay on.
 */
export function ReadGamepad(pads) {
  const there = [...pads].filter((each) => each?.connected);
  const pad = there.find(({ mapping }) => mapping === 'standard') ?? there[0];
  if (!pad) return null;
  const isStandard = pad.mapping === 'standard';
  return { id: `${pad.index} ${pad.id}`, name: pad.id.replace(/\s*\(.*/, ''), isStandard,
    isHeld: isStandard && kShoulders.some((button) => pad.buttons[button]?.pressed),
    stick: WithinCircle({ x: pad.axes[0] ?? 0, y: -(pad.axes[1] ?? 0) }) };
}

export function Gamepad({ widget }) {
  const { port, axes, problem } = DriveOf(widget);
  const [pad, setPad] = useState(null);
  const path = port?.path;
  const mine = held.value[widget.target] === widget.id;
  useEffect(() => {
    // A shoulder begins a hold by being pressed: it must have been seen released. One that is still pressed when a hold has
    // ended by itself, or that was pressed before this page looked, begins none.
    let [isHolding, isBlocked, before] = [false, true, null];
    const look = () => {
      const seen = ReadGamepad(navigator.getGamepads());
      setPad(seen);
      const isOther = seen?.id !== before;
      before = seen?.id;
      if (!seen?.isHeld || isOther) {
        [isHolding, isBlocked] = [false, seen?.isHeld ?? true];
        return LetGo(widget.target, widget.id);
      }
      isBlocked ||= isHolding && held.peek()[path] !== widget.id;
      if (isBlocked || !path || !axes) return;
      isHolding = Drive(path, widget.id, TwistText(axes, MotionOf(seen.stick, widget)), TwistText(axes, kStill));
      isBlocked = !isHolding;
    };
    const timer = setInterval(look, kPeriod);
    return () => { clearInterval(timer); LetGo(widget.target, widget.id); };
  }, [path, widget]);
  const motion = mine && pad ? MotionOf(pad.stick, widget) : kStill;
  const name = !pad ? 'No gamepad: connect one and press a button'
    : pad.isStandard ? pad.name : `${pad.name} has no standard layout: it cannot drive here`;
  return html`
    <div class="gamepad">
      <p class=${`gamepad-name ${pad?.isStandard ? '' : 'none'}`}>${name}</p>
      <p class="hint">Hold a shoulder button, and push the left stick.</p>
      <${DrivingState} widget=${widget} problem=${problem} motion=${motion} />
    </div>`;
}
