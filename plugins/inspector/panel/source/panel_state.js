// The panel: its widgets, whether they are being arranged, and what the server has of it.

import { computed, signal } from '@preact/signals';
import { ErrorText } from '../../page/source/state/actions.js';
import { Request, catalogue, hello, structure, structureOf } from '../../page/source/state/store.js';
import { Toast } from '../../page/source/state/toasts.js';
import { DefaultPanel } from './model/default_panel.js';
import { FreePlace, Placed, Within } from './model/grid.js';
import { FreeId, PanelText, ParsePanel, SettingsOf, kDrivesAtFirst, kKinds } from './model/kinds.js';

export const widgets = signal([]);
export const isEditing = signal(false);
export const chosen = signal(null); // id of the widget whose settings are shown
export const file = signal(null);   // where the server keeps it; null: in memory
export const isLoaded = signal(false);
const savedText = signal('');       // as the server has it; "": nothing yet
export const isChanged = computed(() => isLoaded.value && savedText.value !== '' && PanelText(widgets.value) !== savedText.value);
export const isUnsaved = computed(() => isLoaded.value && savedText.value === '');
export const chosenWidget = computed(() => widgets.value.find(({ id }) => id === chosen.value) ?? null);

let loadedFor = null; // the run whose panel is shown
let askedFor = null;  // the run whose panel is on its way
let readText = '';    // what the server had then
/** The server's panel is another one than was read here, or one that cannot be read: saving would overwrite it. */
export const isOverwriting = signal(false);

/** Asks the server for the panel, once in each run, when its structure is known; changes that are not saved yet stay. */
export async function Load() {
  const run = hello.value.run;
  if (loadedFor === run || askedFor === run || structureOf.value !== run) return;
  askedFor = run;
  const reply = await Request({ op: 'panel' });
  askedFor = null;
  // What the connection has lost is asked for by the next one.
  if (reply.lost || hello.value?.run !== run || structureOf.value !== run) return;
  loadedFor = run;
  if (!reply.ok) Toast('error', 'The panel cannot be read', (reply.errors ?? []).map(ErrorText));
  const isKept = isChanged.value;
  file.value = reply.file ?? null;
  readText = reply.ok ? reply.text : null;
  if (!isKept) widgets.value = readText ? ParsePanel(readText) : DefaultPanel(structure, catalogue.value);
  savedText.value = readText ? PanelText(ParsePanel(readText)) : '';
  isOverwriting.value = false;
  isLoaded.value = true;
}

/** Saved only over what was read here, unless that has been said and Save is pressed once more. */
export async function SavePanel() {
  const text = PanelText(widgets.value);
  const before = await Request({ op: 'panel' });
  const isOther = before.ok ? before.text !== readText : !before.lost;
  if (isOther && !isOverwriting.value) {
    isOverwriting.value = true;
    return Toast('refused', before.ok ? 'The saved panel is another one than was read here: somebody has changed it'
      : 'The panel beside the application cannot be read', ['“Overwrite” replaces it, Discard leaves it.', ...(before.errors ?? []).map(ErrorText)]);
  }
  const reply = await Request({ op: 'save_panel', value: text });
  if (!reply.ok) return Toast('error', 'Could not save the panel', (reply.errors ?? []).map(ErrorText));
  isOverwriting.value = false;
  readText = savedText.value = text;
  return Toast('done', reply.text);
}

/** Back to what the server has; without anything there, to what suits the application. */
export async function Discard() {
  if (isOverwriting.value) {
    loadedFor = null;
    savedText.value = '';
    return Load();
  }
  chosen.value = null;
  widgets.value = savedText.value ? ParsePanel(savedText.value) : DefaultPanel(structure, catalogue.value);
  return undefined;
}

export function AddWidget(kind) {
  const { w, h, drives } = kKinds[kind];
  const widget = { id: FreeId(widgets.value, kind), kind, ...FreePlace(widgets.value, { w, h }),
    ...(drives ? { target: DrivenPorts()[0] ?? '', ...kDrivesAtFirst } : {}),
    ...Object.fromEntries((drives ? [] : SettingsOf(kind)).filter(({ usual }) => usual).map(({ name, usual }) => [name, usual])) };
  widgets.value = [...widgets.value, widget];
  chosen.value = widget.id;
}

export function ChangeWidget(id, change) {
  widgets.value = widgets.value.map((each) => (each.id === id ? Without({ ...each, ...change }) : each));
}

/** What is not said is left out of the file. */
function Without(widget) {
  return Object.fromEntries(Object.entries(widget).filter(([, value]) => value !== undefined && value !== ''));
}

export function MoveWidget(from, id, place) {
  const widget = from.find((each) => each.id === id);
  widgets.value = Placed(from, Within({ ...widget, ...place }, kKinds[widget.kind].least));
}

export function RemoveWidget(id) {
  widgets.value = widgets.value.filter((each) => each.id !== id);
  if (chosen.value === id) chosen.value = null;
}

/** All that widgets of this panel drive. */
export function DrivenPorts() {
  return [...new Set(widgets.value.filter(({ kind, target }) => kKinds[kind]?.drives && target).map(({ target }) => target))];
}
