// The panel: its widgets, whether they are being arranged, and what the server has of it.

import { computed, signal } from '@preact/signals';
import { ErrorText } from '../../page/source/state/actions.js';
import { Request, catalogue, hello, structure } from '../../page/source/state/store.js';
import { Toast } from '../../page/source/state/toasts.js';
import { DefaultPanel } from './model/default_panel.js';
import { FreePlace, Placed, Within } from './model/grid.js';
import { FreeId, PanelText, ParsePanel, SettingsOf, kDrivesAtFirst, kKinds } from './model/kinds.js';

export const widgets = signal([]);
export const isEditing = signal(false);
export const chosen = signal(null); // id of the widget whose settings are shown
export const file = signal(null);   // where the server keeps it; null: in memory
export const isStopSeen = signal(true); // the stop of the panel, if it has one, is on the screen
export const isLoaded = signal(false);
const savedText = signal('');       // as the server has it; "": nothing yet
export const isChanged = computed(() => isLoaded.value && savedText.value !== '' && PanelText(widgets.value) !== savedText.value);
export const isUnsaved = computed(() => isLoaded.value && savedText.value === '');
export const chosenWidget = computed(() => widgets.value.find(({ id }) => id === chosen.value) ?? null);

let loadedFor = null;

/** Asks the server for the panel, once in each run; changes that are not saved yet stay. */
export async function Load() {
  const run = hello.value.run;
  if (loadedFor === run || structure.root === null) return;
  loadedFor = run;
  const reply = await Request({ op: 'panel' });
  if (hello.value?.run !== run) return;
  if (!reply.ok) Toast('error', 'The panel cannot be read', (reply.errors ?? []).map(ErrorText));
  const isKept = isChanged.value;
  file.value = reply.file ?? null;
  const text = reply.ok ? reply.text : '';
  if (!isKept) widgets.value = text ? ParsePanel(text) : DefaultPanel(structure, catalogue.value);
  savedText.value = text ? PanelText(ParsePanel(text)) : '';
  isLoaded.value = true;
}

export async function SavePanel() {
  const text = PanelText(widgets.value);
  const reply = await Request({ op: 'save_panel', value: text });
  if (!reply.ok) return Toast('error', 'Could not save the panel', (reply.errors ?? []).map(ErrorText));
  savedText.value = text;
  Toast('done', reply.text);
}

/** Back to what the server has; without anything there, to what suits the application. */
export function Discard() {
  widgets.value = savedText.value ? ParsePanel(savedText.value) : DefaultPanel(structure, catalogue.value);
  chosen.value = null;
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
