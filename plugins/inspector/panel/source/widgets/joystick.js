// A stick for mouse, touch and arrow keys: drives while it is held, and goes back to the middle when it is let go.

import { useEffect, useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { canDrive } from '../../../page/source/state/store.js';
import { Drive, LetGo, held } from '../driving/driving.js';
import { PlaceOfWays, usePointerHold, useWays } from '../driving/held_by.js';
import { MotionOf, TwistText, WithinCircle } from '../model/twist.js';
import { DriveOf, DrivingState } from './driving_state.js';

const kRange = 0.72; // of the pad's radius, as far as the stick goes
const kStill = { forward: 0, turn: 0 };

export function Joystick({ widget }) {
  const { port, axes, problem } = DriveOf(widget);
  const pad = useRef(null);
  const box = useRef(null);
  const [stick, setStick] = useState(null); // where it is held
  const mine = held.value[widget.target] === widget.id;
  // The hold has ended by itself: the stick is not held any more, whatever the finger does.
  useEffect(() => { if (!mine) setStick(null); }, [mine]);
  useEffect(() => () => LetGo(widget.target, widget.id), [widget.target, widget.id]);

  const motion = stick ? MotionOf(stick, widget) : kStill;
  const isLocked = Boolean(problem) || !canDrive.value;
  const letGo = () => { LetGo(widget.target, widget.id); setStick(null); };
  const take = (place) => {
    const isTaken = Drive(port.path, widget.id, TwistText(axes, MotionOf(place, widget)), TwistText(axes, kStill));
    if (isTaken) setStick(place);
    return isTaken;
  };
  // As it was when it was pressed: what is drawn meanwhile moves nothing.
  const placeOf = ({ clientX, clientY }) => {
    const { left, top, width, height } = box.current;
    const radius = width / 2 * kRange;
    return WithinCircle({ x: (clientX - left - width / 2) / radius, y: -(clientY - top - height / 2) / radius });
  };
  const pointer = usePointerHold({
    begin: (event) => {
      if (isLocked) return false;
      box.current = pad.current.getBoundingClientRect();
      return take(placeOf(event));
    },
    move: (event) => { if (held.peek()[widget.target] === widget.id) take(placeOf(event)); },
    end: letGo,
  });
  const keys = useWays({ mine, change: (ways) => (ways.size === 0 ? letGo() : !isLocked && take(WithinCircle(PlaceOfWays(ways)))) });
  const at = stick ?? { x: 0, y: 0 };
  return html`
    <div class="joystick">
      <div class="stick-room">
        <div class=${`stick-pad ${stick ? 'held' : ''}`} ref=${pad} data-stick=${widget.id} role="application" tabindex="0" aria-disabled=${isLocked}
            aria-label="Joystick: hold and push, or hold arrow keys, to drive; letting go stops" ...${pointer}
            onKeyDown=${(event) => keys.onKey(event)} onKeyUp=${(event) => keys.onKey(event)} onBlur=${keys.letGo}>
          <svg viewBox="-100 -100 200 200" aria-hidden="true">
            <circle class="stick-ring" r="96" /><circle class="stick-range" r="69" />
            ${[0, 90, 180, 270].map((angle) => html`<path class="stick-arrow" key=${angle} d="M-7,-80 L0,-87 L7,-80" transform=${`rotate(${angle})`} />`)}
            <line class="stick-rod" x2=${69 * at.x} y2=${-69 * at.y} />
            <circle class="stick-knob" cx=${69 * at.x} cy=${-69 * at.y} r="27" />
          </svg>
        </div>
      </div>
      <${DrivingState} widget=${widget} problem=${problem} motion=${motion} />
    </div>`;
}
