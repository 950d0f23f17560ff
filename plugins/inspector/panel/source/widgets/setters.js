// Slider, button, switch.

import { useEffect, useRef, useState } from 'preact/hooks';
import { html } from 'htm/preact';
import { FormatNumber } from '../../../page/source/model/value_format.js';
import { canDrive } from '../../../page/source/state/store.js';
import { Drive, LetGo, held } from '../driving/driving.js';
import { usePointerHold } from '../driving/held_by.js';
import { kOnlyHeldDrives, useTarget } from './target.js';

/** From where to where, and in which steps; what the widget does not say, the parameter's bounds do. */
export function RangeOf(widget, element) {
  const [minimum, maximum] = [widget.minimum ?? element?.minimum ?? 0, widget.maximum ?? element?.maximum ?? 1];
  const isWhole = /^u?int/.test(element?.data_type ?? '');
  const step = widget.step ?? (isWhole ? 1 : Nice((maximum - minimum) / 100));
  return { minimum, maximum: Math.max(minimum, maximum), step };
}

function Nice(width) {
  const power = 10 ** Math.floor(Math.log10(Math.max(1e-9, width)));
  return [1, 2, 5, 10].map((factor) => factor * power).find((each) => each >= width * 0.999);
}

export function Slider({ widget }) {
  const { element, isPort, value, locked, set, note } = useTarget(widget);
  const [draft, setDraft] = useState(null); // while it is dragged, and until the application says so, too
  useEffect(() => setDraft(null), [value]);
  const { minimum, maximum, step } = RangeOf(widget, element);
  const shown = draft ?? (typeof value === 'number' ? value : minimum);
  const part = maximum > minimum ? (shown - minimum) / (maximum - minimum) : 0;
  const send = async (number) => { if (!await set(String(number))) setDraft(null); };
  // What moves does so only as long as the slider is held: by a pointer or key that came down, and that no STOP has ended.
  const drives = isPort && element?.moves;
  const isMine = drives && held.value[widget.target] === widget.id;
  const hasCome = useRef(false); // a pointer or key, by which nothing has been wanted yet
  const letGo = () => { hasCome.current = false; LetGo(widget.target, widget.id); };
  useEffect(() => letGo, [widget.target, widget.id]);
  useEffect(() => { if (drives && !isMine) setDraft(null); }, [isMine]);
  const drag = ({ target }) => {
    const mayDrive = !drives || hasCome.current || held.peek()[widget.target] === widget.id;
    hasCome.current = false;
    const isTaken = mayDrive && (!drives || (canDrive.value && Drive(widget.target, widget.id, String(target.valueAsNumber), RestOf(element))));
    setDraft(isTaken ? target.valueAsNumber : null);
    if (!isTaken) target.value = String(shown);
  };
  const come = ({ repeat, button }) => { hasCome.current = !repeat && !button; };
  const holding = drives ? { onPointerDown: come, onKeyDown: come, onPointerUp: letGo, onPointerCancel: letGo, onLostPointerCapture: letGo,
    onKeyUp: letGo, onBlur: letGo } : { onChange: (event) => send(event.target.valueAsNumber), onPointerCancel: () => setDraft(null) };
  return html`
    <div class="slider">
      <output>${typeof value === 'number' || draft !== null ? FormatNumber(shown) : '–'} <small>${element?.unit ?? ''}</small></output>
      <input type="range" min=${minimum} max=${maximum} step=${step} value=${shown} disabled=${locked} aria-label=${widget.title ?? element?.name ?? 'Slider'}
        style=${{ '--part': `${Math.round(Math.min(1, Math.max(0, part)) * 1000) / 10}%` }}
        onInput=${drag} ...${holding} />
      <div class="slider-ends"><span>${FormatNumber(minimum)}</span><span>${FormatNumber(maximum)}</span></div>
      ${note}
    </div>`;
}

export function Button({ widget }) {
  const { element, isPort, locked, set, note } = useTarget(widget);
  const text = widget.pressed ?? (element?.data_type === 'bool' ? 'true' : '');
  const isHeld = held.value[widget.target] === widget.id;
  const letGo = () => LetGo(widget.target, widget.id);
  useEffect(() => letGo, [widget.target, widget.id]);
  // Held, it is sent again and again, as driving is: the server has the port rest when it is not heard of.
  const begin = () => canDrive.value && Drive(widget.target, widget.id, text, widget.off ?? RestOf(element));
  const pointer = usePointerHold({ begin, end: letGo });
  const isKey = ({ key }) => key === ' ' || key === 'Enter';
  const holding = isPort && (widget.held || element?.moves) ? { ...pointer, onBlur: letGo,
    onKeyDown: (event) => {
      if (!isKey(event)) return;
      event.preventDefault();
      if (!event.repeat) begin();
    },
    onKeyUp: (event) => { if (isKey(event)) letGo(); },
  } : { onClick: () => set(text) };
  return html`
    <div class="push"><button class=${`push-button ${isHeld ? 'down' : ''}`} disabled=${locked || text === ''} ...${holding}
        onContextMenu=${(event) => event.preventDefault()}>${widget.title ?? element?.name ?? 'Button'}</button>${note}</div>`;
}

function RestOf(element) {
  const type = element?.data_type;
  if (element?.safe !== undefined) return element.safe;
  return type === 'bool' ? 'false' : /^(double|float|u?int\w*)$/.test(type ?? '') ? '0' : '{}';
}

export function Switch({ widget }) {
  const { element, isPort, value, locked, set, note } = useTarget(widget);
  const [on, off] = [widget.on ?? 'true', widget.off ?? 'false'];
  const drives = isPort && element?.moves;
  const isOn = String(value) === on;
  return html`
    <div class="flip"><label><span>${widget.title ?? element?.name ?? 'Switch'}</span>
      <input type="checkbox" class="switch" role="switch" checked=${isOn} disabled=${locked || drives} onChange=${(event) => set(event.target.checked ? on : off)} /></label>
      ${drives && html`<p class="problem widget-problem">${kOnlyHeldDrives}</p>`}${note}</div>`;
}
