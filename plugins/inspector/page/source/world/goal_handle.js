// A point of the world that can be moved: by dragging it, or by arrow keys.

import { useEffect, useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { Change } from '../model/changes.js';
import { FormatNumber } from '../model/value_format.js';
import { Apply } from '../state/actions.js';
import { canChange } from '../state/store.js';
import { ToCanvas, ToWorld } from './camera.js';

const kStep = 0.1;     // m, of an arrow key
const kPatience = 400; // ms without a key before a move by keys is sent

export function GoalHandle({ layer, place, point, scene }) {
  const [moved, setMoved] = useState(null); // where it has been put, until the application says so, too
  const timer = useRef(0);
  const cancel = useRef(null); // ends the drag that is under way, without a word to the application
  useEffect(() => { setMoved(null); }, [place.x, place.y]);
  useEffect(() => () => clearTimeout(timer.current), []);

  const send = async (to) => {
    const { goal } = layer;
    const text = (number) => String(Math.round(number * 1000) / 1000);
    const reply = await Apply([Change.set(goal.x, text(to.x)), Change.set(goal.y, text(to.y))],
      `move ${goal.name} to (${text(to.x)}, ${text(to.y)})`);
    if (!reply.ok) setMoved(null);
  };
  const onPointerDown = (event) => {
    if (!canChange.value || event.button !== 0) return;
    const button = event.currentTarget;
    const box = scene.host.getBoundingClientRect();
    let to = null;
    button.setPointerCapture(event.pointerId);
    const end = () => { button.onpointermove = button.onpointerup = button.onpointercancel = cancel.current = null; };
    button.onpointermove = (move) => {
      to = ToWorld(scene.camera.value, scene.size.value, { x: move.clientX - box.left, y: move.clientY - box.top });
      setMoved(to);
    };
    button.onpointerup = () => { end(); if (to) send(to); };
    // By the browser (a gesture of the system, a palm), or by Escape: nothing has been said.
    button.onpointercancel = cancel.current = () => { end(); setMoved(null); };
  };
  const takeBack = () => {
    clearTimeout(timer.current);
    cancel.current?.();
    setMoved(null);
  };
  useEffect(() => {
    if (!moved) return undefined;
    const onEscape = (event) => { if (event.key === 'Escape') takeBack(); };
    window.addEventListener('keydown', onEscape, true);
    return () => window.removeEventListener('keydown', onEscape, true);
  }, [moved === null]);
  const onKey = (event) => {
    const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [];
    if (dx === undefined || !canChange.value) return;
    event.preventDefault();
    event.stopPropagation();
    const from = moved ?? place;
    const to = { x: from.x + dx * kStep, y: from.y + dy * kStep };
    setMoved(to);
    clearTimeout(timer.current);
    timer.current = setTimeout(() => send(to), kPatience);
  };
  const at = moved ? ToCanvas(scene.camera.value, scene.size.value, moved) : point;
  const shown = moved ?? place;
  const { width, height } = scene.size.value;
  const isOutside = at.x < 0 || at.y < 0 || at.x > width || at.y > height;
  return html`<button class=${`goal ${moved ? 'moved' : ''}`} id=${`goal:${layer.port}`} disabled=${!canChange.value}
    style=${{ left: `${at.x}px`, top: `${at.y}px`, display: isOutside ? 'none' : undefined }}
    onPointerDown=${onPointerDown} onKeyDown=${onKey} title=${`Drag: ${layer.goal.name}`}
    aria-label=${`${layer.goal.name} at x ${FormatNumber(shown.x)} m, y ${FormatNumber(shown.y)} m; arrow keys move it`}></button>`;
}
