// Keys that work wherever one is, but in a field that takes text.

import { Pause, Redo, Resume, Step, Undo } from '../state/actions.js';
import { GroupForNew, openDialog } from '../state/choices.js';
import { CopyChosen, PasteCopied } from '../state/clipboard.js';
import { canChange, canDrive, hello, run, structure } from '../state/store.js';

export function AttachKeys() {
  document.addEventListener('keydown', (event) => {
    if (openDialog.value || event.altKey) return;
    const isField = event.target.closest?.('input, select, textarea') && event.target.type !== 'checkbox';
    const key = event.key.length === 1 ? event.key.toLowerCase() : event.key;
    const action = event.ctrlKey || event.metaKey ? WithControl(key, event.shiftKey, isField) : isField ? null : kPlain[key];
    if (!action) return;
    event.preventDefault();
    if (!event.repeat || key === '.') action(); // a key that is held steps, and does nothing else twice
  });
}

function WithControl(key, shift, isField) {
  if (key === 's') return () => { if (canChange.value) openDialog.value = { kind: 'difference' }; };
  if (key === 'c' && !isField && getSelection().isCollapsed) return () => { CopyChosen(); };
  if (isField || !canChange.value) return null; // fields have an undo of their own
  if (key === 'v') return () => { PasteCopied(); };
  if (key === 'z' && !shift) return () => { if (run.value.undo) Undo(); };
  if (key === 'y' || (key === 'z' && shift)) return () => { if (run.value.redo) Redo(); };
  return null;
}

const kPlain = {
  '/': () => document.getElementById('search')?.focus(),
  '?': () => { openDialog.value = { kind: 'help' }; },
  a: () => { if (canChange.value && structure.root) openDialog.value = { kind: 'create', group: GroupForNew() }; },
  g: () => document.getElementById('graph')?.focus(),
  d: () => document.getElementById('details')?.focus(),
  p: () => { if (HasPace() && canDrive.value) (run.value.paused ? Resume() : Pause()); },
  '.': () => { if (HasPace() && canChange.value) Step(1); },
};

function HasPace() {
  return hello.value?.clock === 'simulated' && !run.value.ended;
}
