// Driving with a gamepad: its left stick, while a shoulder button is held.

import { useEffect, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { Drive, LetGo, held } from '../driving/driving.js';
import { MotionOf, TwistText, WithinCircle } from '../model/twist.js';
import { DriveOf, DrivingState } from './driving_state.js';

const kShoulders = [4, 5, 6, 7]; // of the standard layout
const kStill = { forward: 0, turn: 0 };
const kPeriod = 40; // ms, between two looks

/** {name, isHeld, stick} of the first gamepad there is, or null. */
export function ReadGamepad(pads) {
  const pad = [...pads].find((each) => each?.connected);
  if (!pad) return null;
  return { name: pad.id.replace(/\s*\(.*/, ''), isHeld: kShoulders.some((button) => pad.buttons[button]?.pressed),
    stick: WithinCircle({ x: pad.axes[0] ?? 0, y: -(pad.axes[1] ?? 0) }) };
}

export function Gamepad({ widget }) {
  const { port, axes, problem } = DriveOf(widget);
  const [pad, setPad] = useState(null);
  const path = port?.path;
  const mine = held.value[widget.target] === widget.id;
  useEffect(() => {
    // A shoulder that is still pressed when a hold has ended by itself does not begin another one.
    let [isHolding, isBlocked] = [false, false];
    const look = () => {
      const seen = ReadGamepad(navigator.getGamepads());
      setPad(seen);
      if (!seen?.isHeld) {
        [isHolding, isBlocked] = [false, false];
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
  return html`
    <div class="gamepad">
      <p class=${`gamepad-name ${pad ? '' : 'none'}`}>${pad ? pad.name : 'No gamepad: connect one and press a button'}</p>
      <p class="hint">Hold a shoulder button, and push the left stick.</p>
      <${DrivingState} widget=${widget} problem=${problem} motion=${motion} />
    </div>`;
}
