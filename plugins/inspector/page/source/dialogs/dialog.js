// The frame of all dialogs: modal, closed by Escape or a click beside it, focus goes back after it.

import { useEffect, useRef } from 'preact/hooks';
import { html } from 'htm/preact';
import { BringStopInto } from '../stop/stop_view.js';
import { openDialog } from '../state/choices.js';

/**
 * Closes `dialog`, unless the user has closed it meanwhile: an answer that comes late must not close
 * another one, or move what is selected. Returns whether it was still open.
 */
export function CloseDialog(dialog = openDialog.value) {
  const isOpen = openDialog.value === dialog;
  if (isOpen) openDialog.value = null;
  return isOpen;
}

export function Dialog({ title, children, className = '', style }) {
  const element = useRef(null);
  const own = useRef(null); // browsers tell of its end later, when another one may be open
  own.current = openDialog.peek();
  useEffect(() => {
    const before = document.activeElement;
    element.current.showModal();
    const bringBack = BringStopInto(element.current);
    const first = (what) => element.current.querySelector(`.dialog-body :is(${what})`);
    (first('[autofocus]:not(:disabled)') ?? first('input, button:not(.remove)'))?.focus();
    return () => {
      bringBack();
      queueMicrotask(() => before?.focus?.()); // while the dialog is there nothing else takes the focus
    };
  }, []);
  const onPointerDown = ({ target, clientX: x, clientY: y }) => {
    const box = element.current.getBoundingClientRect(); // its scroll bar is within, and its backdrop beside it
    const isWithin = x >= box.left && x <= box.right && y >= box.top && y <= box.bottom;
    if (target === element.current && !isWithin) CloseDialog();
  };
  const onKeyDown = (event) => {
    event.stopPropagation();
    if ((event.ctrlKey || event.metaKey) && event.key.toLowerCase() === 's') event.preventDefault(); // browsers save their page by it
  };
  return html`<dialog ref=${element} class=${className} style=${style} aria-label=${title} onClose=${() => CloseDialog(own.current)}
      onPointerDown=${onPointerDown} onKeyDown=${onKeyDown}>
    <div class="dialog-body">${children}</div></dialog>`;
}
