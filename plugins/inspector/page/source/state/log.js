// The log as the page keeps it: by number, without repetitions, the newest of them.

const kKept = 1000;

export function AddLogEntries(entries, added) {
  const newest = entries.length > 0 ? entries[entries.length - 1].number : -1;
  const fresh = added.filter((entry) => entry.number > newest);
  return fresh.length === 0 ? entries : [...entries, ...fresh].slice(-kKept);
}

/** Faults and warnings in which the path of an element, or of something in it, occurs. */
export function TroublesOf(entries, path) {
  return entries.filter(({ kind, text }) => {
    if (kind !== 'fault' && kind !== 'warning') return false;
    const at = text.indexOf(path);
    return at >= 0 && !/[A-Za-z0-9_]/.test(text[at + path.length] ?? '');
  });
}

/** Entries of the kinds wanted (all if there are none) in which the text occurs. */
export function FilterLog(entries, { text, kinds }) {
  const wanted = text.trim().toLowerCase();
  return entries.filter((entry) => (kinds.size === 0 || kinds.has(entry.kind)) &&
    (wanted === '' || `${entry.kind} ${entry.text}`.toLowerCase().includes(wanted)));
}
