// What has been copied: kept by the browser, so that another page can paste it.

import { CopyOf } from '../model/copies.js';
import { NameOf, ParentOf } from '../model/structure.js';
import { Arrange, Paste } from './actions.js';
import { PlaceEntries, places } from './arrangement.js';
import { Choose, GroupForNew, Reveal, chosen, selected } from './choices.js';
import { canChange, structure } from './store.js';
import { Toast } from './toasts.js';

const kAside = 48; // of what it is a copy of, where boxes stand by hand
const kKey = 'runnel.copied';
let inMemory = null; // where the browser keeps nothing

function Keep(text) {
  try {
    localStorage.setItem(kKey, text);
    inMemory = null;
  } catch {
    inMemory = text;
  }
}

function Kept() {
  try {
    return inMemory ?? localStorage.getItem(kKey);
  } catch {
    return null;
  }
}

export function CopyChosen() {
  const copy = CopyOf(structure, chosen.value);
  if (copy.roots.length === 0) return false;
  const placed = copy.roots.map((root) => ({ ...root, place: places.value.get(root.path) }));
  Keep(JSON.stringify({ ...copy, roots: placed }));
  Toast('done', `Copied ${copy.roots.map(({ name }) => name).join(', ')}`);
  return true;
}

/** Into the group that what is chosen is in. */
export async function PasteCopied(group) {
  const text = Kept();
  if (!text || !canChange.value) return;
  const copy = JSON.parse(text);
  const isCopied = copy.roots.some(({ path }) => path === selected.value); // beside itself, not into itself
  const paths = await Paste(copy, group ?? (isCopied ? ParentOf(selected.value) : GroupForNew()));
  if (!paths) return;
  const put = new Map(copy.roots.flatMap(({ place }, at) => (place ? [[paths[at], { x: place.x + kAside, y: place.y + kAside }]] : [])));
  if (put.size > 0) Arrange(PlaceEntries(put));
  Reveal(paths[0]);
  Choose(paths);
  Toast('done', `Pasted ${paths.map(NameOf).join(', ')}`);
}

/** A copy beside what is chosen, with its own name. */
export function DuplicateChosen(group) {
  if (CopyChosen()) PasteCopied(group);
}
