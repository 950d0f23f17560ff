// What the user has chosen: selection, open groups, panels. Kept by the browser, by application.

import { computed, effect, signal } from '@preact/signals';
import { IsGroup, ParentOf } from '../model/structure.js';
import { hello, isConnected, revision, structure } from './store.js';

const kOpenBelow = 60; // applications with fewer modules show all of them at first

export const selected = signal(null);   // a path, the key of a connection, or nothing
/** What has been chosen besides `selected`, and with which selection: another one ends it. */
export const marked = signal({ with: null, paths: [] });
export const chosen = computed(() => {
  if (selected.value === null) return [];
  return [selected.value, ...(marked.value.with === selected.value ? marked.value.paths : [])];
});

/** Chooses several boxes; the last one is shown. */
export function Choose(paths) {
  selected.value = paths.at(-1) ?? null;
  marked.value = { with: selected.value, paths: paths.slice(0, -1) };
}

export const openGroups = signal({});   // path -> true or false, where the user has decided
export const theme = signal(Kept('theme', 'system'));
const systemIsDark = signal(false);
export const isDark = computed(() => (theme.value === 'system' ? systemIsDark.value : theme.value === 'dark'));
export const panels = signal(Kept('panels', { side: 380, dock: 220, dockOpen: false, world: 330, worldShown: true, worldLarge: false, tab: 'plots' }));
export const openDialog = signal(null); // {kind: 'create' | 'connect' | …, …}
/** Opens a dialog after an answer, unless another one has been opened or closed since `asked` was open: keys would go to the wrong one. */
export function OpenLater(dialog, asked) {
  if (openDialog.value === asked) openDialog.value = dialog;
  return openDialog.value === dialog;
}

export const announcement = signal(''); // for screen readers

/** The thread whose modules stand out, or null. */
export const selectedThread = computed(() => {
  revision.value;
  const element = selected.value ? structure.get(selected.value) : null;
  return element?.kind === 'thread' ? element.name : null;
});

const opensByItself = computed(() => {
  revision.value;
  return [...structure.ofKind('module')].length < kOpenBelow;
});

export function IsOpen(path) {
  return openGroups.value[path] ?? opensByItself.value;
}

export function SetOpen(path, open) {
  openGroups.value = { ...openGroups.value, [path]: open };
}

export function SetAllOpen(open) {
  const all = {};
  for (const element of structure.elements.values()) {
    if (IsGroup(element) && !element.is_plain) all[element.path] = open;
  }
  openGroups.value = all;
}

/** Where something new is put: into the group that is selected, or that what is selected is in. */
export function GroupForNew() {
  const element = structure.get(selected.value);
  if (!element || element.far || element.kind === 'thread') return structure.root;
  return IsGroup(element) ? element.path : ParentOf(element.owner ?? element.path);
}

/** Opens the groups around an element, so that it can be seen. */
export function Reveal(path) {
  const open = { ...openGroups.value };
  for (let at = ParentOf(path); at; at = ParentOf(at)) if (!IsOpen(at) && at !== structure.root) open[at] = true;
  openGroups.value = open;
}

export function SetPanels(change) {
  panels.value = { ...panels.value, ...change };
}

function Kept(key, value) {
  try {
    const kept = JSON.parse(localStorage.getItem(`runnel.${key}`));
    return kept === null ? value : typeof value === 'object' ? { ...value, ...kept } : kept;
  } catch {
    return value; // kept by another version, or nothing may be kept: begin afresh
  }
}

function Keep(key, value) {
  try {
    localStorage.setItem(`runnel.${key}`, JSON.stringify(value));
  } catch {
    // A browser that keeps nothing still shows everything.
  }
}

/** Keeps choices from now on, and applies the theme. */
export function StartKeeping() {
  const dark = matchMedia('(prefers-color-scheme: dark)');
  systemIsDark.value = dark.matches;
  dark.addEventListener('change', () => { systemIsDark.value = dark.matches; });
  effect(() => Keep('theme', theme.value));
  effect(() => Keep('panels', panels.value));
  effect(() => { document.documentElement.dataset.theme = isDark.value ? 'dark' : 'light'; });
  effect(() => {
    const name = hello.value?.application;
    document.title = name ? `${isConnected.value ? '' : '(away) '}${name} – Runnel` : 'Runnel inspector';
  });
  let application = null;
  effect(() => {
    const name = hello.value?.application;
    const open = openGroups.value; // in any case, or the effect would not follow it
    if (!name) return;
    if (name !== application) {
      application = name;
      openGroups.value = { ...Kept(`open.${name}`, {}), ...open }; // the address is right
    } else {
      Keep(`open.${name}`, open);
    }
  });
}
