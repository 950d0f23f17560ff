// Elements by parts of their names.

const kRank = { module: 0, group: 0, thread: 1, port: 2, parameter: 3 };

/** At most `limit` elements in whose path or type all words occur; names that begin so come first. */
export function FindElements(structure, text, limit) {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  const found = [];
  for (const element of structure.elements.values()) {
    if (element.is_plain || element.kind === 'application') continue;
    const name = element.name.toLowerCase();
    const all = `${element.path} ${element.type ?? ''} ${element.data_type ?? ''}`.toLowerCase();
    if (!words.every((word) => all.includes(word))) continue;
    const last = words[words.length - 1];
    const fit = name === last ? 0 : name.startsWith(last) ? 1 : name.includes(last) ? 2 : 3;
    found.push({ element, rank: fit * 10 + (kRank[element.kind] ?? 4) });
  }
  found.sort((a, b) => a.rank - b.rank || a.element.path.length - b.element.path.length);
  return found.slice(0, limit).map((entry) => entry.element);
}
