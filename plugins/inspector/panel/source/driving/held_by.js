// What holds a control: one pointer, or keys. A hold ends with its cause.

import { useEffect, useRef, useState } from 'preact/hooks';

/**
 * Handlers of a control that one pointer holds. `begin(event)` says false if it cannot be had. A second finger on it ends the
 * hold, for nobody can say which of the two is meant; so does a pointer that the browser cancels.
 */
export function usePointerHold({ begin, move, end }) {
  const holder = useRef(null); // the pointer that holds it
  const finish = () => { holder.current = null; end(); };
  const ofHolder = (then) => (event) => { if (event.pointerId === holder.current) then(event); };
  return {
    onPointerDown: (event) => {
      if (holder.current !== null && holder.current !== event.pointerId) return finish();
      if (event.button !== 0) return undefined;
      event.currentTarget.setPointerCapture(event.pointerId);
      if (begin(event) !== false) holder.current = event.pointerId;
      return undefined;
    },
    // Of several buttons of a mouse only the last one that comes up is told as up.
    onPointerMove: ofHolder((event) => (event.pointerType === 'mouse' && !(event.buttons & 1) ? finish() : move?.(event))),
    onPointerUp: ofHolder(finish), onPointerCancel: ofHolder(finish), onLostPointerCapture: ofHolder(finish),
    onContextMenu: (event) => event.preventDefault(),
  };
}

const kModifiers = ['Control', 'Alt', 'AltGraph', 'Meta'];
const kArrows = { ArrowUp: 'up', ArrowDown: 'down', ArrowLeft: 'left', ArrowRight: 'right' };
const kLetters = { KeyW: 'up', KeyS: 'down', KeyA: 'left', KeyD: 'right' };

/**
 * The ways up, down, left, right that are held, by keys or otherwise. `change(ways)` is told all that are held now, and says
 * false if they cannot be had; `mine`: the hold is there. A key that comes up lets go of its way whatever else is down; a
 * modifier that comes down lets go of all, since some systems keep the letter's coming up to themselves then.
 */
export function useWays({ mine, change, letters = false }) {
  const down = useRef(new Set()); // also for what happens between two drawings
  const [ways, setWays] = useState(new Set());
  const tell = () => {
    if (change(down.current) === false) down.current.clear();
    setWays(new Set(down.current));
  };
  const hold = (way, isDown) => {
    if (isDown === down.current.has(way)) return;
    down.current[isDown ? 'add' : 'delete'](way);
    tell();
  };
  const letGo = () => {
    if (down.current.size === 0) return;
    down.current.clear();
    tell();
  };
  /** Takes a key's event, unless `mayBegin` says that one which comes down is meant for something else. */
  const onKey = (event, mayBegin = () => true) => {
    const isDown = event.type === 'keydown';
    if (isDown && kModifiers.includes(event.key)) return letGo();
    const way = kArrows[event.code] ?? (letters ? kLetters[event.code] : undefined);
    if (!way) return undefined;
    if (!isDown) return hold(way, false);
    if (event.ctrlKey || event.altKey || event.metaKey || !mayBegin(event)) return undefined;
    event.preventDefault();
    event.stopPropagation();
    return event.repeat ? undefined : hold(way, true);
  };
  useEffect(() => {
    if (mine) return;
    down.current.clear(); // it has ended by itself
    setWays(new Set());
  }, [mine]);
  return { ways, hold, letGo, onKey };
}

/** {x, y} of ways that are held: opposite ones are none. */
export function PlaceOfWays(ways) {
  const axis = (plus, minus) => (ways.has(plus) ? 1 : 0) - (ways.has(minus) ? 1 : 0);
  return { x: axis('right', 'left'), y: axis('up', 'down') };
}
