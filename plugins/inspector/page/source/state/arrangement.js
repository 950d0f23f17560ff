// Where viewers have put boxes, and their notes: kept by the server for all viewers, beside the application's file.

import { signal } from '@preact/signals';

const kPlace = 'place ';
const kNote = 'note ';

export const places = signal(new Map()); // path -> {x, y}, in its group
export const notes = signal(new Map());  // path, or key of a connection -> text
export const draft = signal(null);       // places of boxes that are being moved

/** Takes in what the server tells. */
export function TakeArrangement(entries) {
  const [nextPlaces, nextNotes] = [new Map(places.value), new Map(notes.value)];
  for (const [name, text] of Object.entries(entries)) {
    if (name.startsWith(kPlace)) Put(nextPlaces, name.slice(kPlace.length), ReadPlace(text));
    else if (name.startsWith(kNote)) Put(nextNotes, name.slice(kNote.length), text || null);
  }
  places.value = nextPlaces;
  notes.value = nextNotes;
}

/** A new connection is told all of it. */
export function ForgetArrangement() {
  places.value = new Map();
  notes.value = new Map();
}

/** Entries for the server: `moved`: Map path -> {x, y} or null. */
export function PlaceEntries(moved) {
  return Object.fromEntries([...moved].map(([path, place]) =>
    [kPlace + path, place ? `${Math.round(place.x)} ${Math.round(place.y)}` : '']));
}

export function NoteEntries(path, text) {
  return { [kNote + path]: text.trim() };
}

/** `path`, or the end of a connection, as it is called once `from` is called `to`. */
export function Renamed(path, from, to) {
  return path.split(' → ').map((end) => (end === from || end.startsWith(`${from}/`) ? to + end.slice(from.length) : end)).join(' → ');
}

/** What is known of an element and of all in it under its new name, and no more under the old one. */
export function RenamedEntries(from, to) {
  const entries = {};
  const move = (prefix, map, text) => {
    for (const [path, value] of map) {
      const next = Renamed(path, from, to);
      if (next === path) continue;
      entries[prefix + path] = '';
      entries[prefix + next] = text(value);
    }
  };
  move(kPlace, places.value, ({ x, y }) => `${x} ${y}`);
  move(kNote, notes.value, (text) => text);
  return entries;
}

function Put(map, key, value) {
  if (value === null) map.delete(key);
  else map.set(key, value);
}

function ReadPlace(text) {
  const [x, y] = text.split(' ').map(Number);
  return text !== '' && Number.isFinite(x) && Number.isFinite(y) ? { x, y } : null;
}
