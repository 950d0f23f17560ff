// The ports of an application as rows of a table: which of them suit a filter, and in which order.

import { FormatValue } from './value_format.js';

/** {path, name, owner, direction, type, byHand} of all ports. */
export function PortRows(structure) {
  const root = structure.root ?? '';
  const rows = [];
  for (const port of structure.ofKind('port')) {
    const owner = port.owner.startsWith(`${root}/`) ? port.owner.slice(root.length + 1) : '';
    rows.push({ path: port.path, name: port.name, owner, direction: port.direction, type: port.data_type ?? '',
      byHand: port.by_hand ?? false, words: `${port.path} ${port.data_type}`.toLowerCase() });
  }
  return rows;
}

/** Those in whose path or type all words occur, of the direction, if one is meant. */
export function FilterPorts(rows, { text, direction, byHand }) {
  const words = text.toLowerCase().split(/\s+/).filter(Boolean);
  return rows.filter((row) => (!direction || row.direction === direction) && (!byHand || row.byHand) &&
    words.every((word) => row.words.includes(word)));
}

/**
 * In the order of a column. `measured(row)` gives what is known of a row now: {rate, bandwidth, age, value}; rows of
 * which nothing is known come last, whatever the order.
 */
export function SortPorts(rows, { column, isDown }, measured) {
  const key = kKeys[column] ?? kKeys.name;
  const keyed = rows.map((row) => ({ row, key: key(row, measured) }));
  const sign = isDown ? -1 : 1;
  keyed.sort((a, b) => Compare(a.key, b.key, sign) || kOrder.compare(a.row.path, b.row.path));
  return keyed.map(({ row }) => row);
}

const kOrder = new Intl.Collator('en', { numeric: true });
const kKeys = {
  name: (row) => `${row.owner}/${row.name}`,
  direction: (row) => row.direction,
  type: (row) => row.type,
  rate: (row, measured) => measured(row).rate,
  bandwidth: (row, measured) => measured(row).bandwidth,
  age: (row, measured) => measured(row).age,
  value: (row, measured) => measured(row).value,
};

function Compare(a, b, sign) {
  const [hasA, hasB] = [a !== null && a !== undefined, b !== null && b !== undefined];
  if (!hasA || !hasB) return hasA === hasB ? 0 : hasA ? -1 : 1;
  return sign * (typeof a === 'number' && typeof b === 'number' ? a - b : kOrder.compare(String(a), String(b)));
}

/** Which rows of equal height are to be drawn: from `first` to before `last`. */
export function VisibleRows({ top, height }, rowHeight, count, spare = 6) {
  const first = Math.max(0, Math.min(count, Math.floor(top / rowHeight) - spare));
  const last = Math.max(first, Math.min(count, Math.ceil((top + height) / rowHeight) + spare));
  return { first, last };
}

/** A value in the text format of the application, which a person can change and send: "{x: 1, y: 2}". */
export function EditableText(value) {
  if (value === null || value === undefined) return '';
  return Written(value, false);
}

/** Whether the text of a value is that value: whole numbers above 2^53 have been rounded on their way into this page. */
export function IsExact(catalogue, type, value) {
  if (typeof value === 'number') return !/^(u?int64(_t)?|size_t)$/.test(type) || Number.isSafeInteger(value);
  if (value === null || typeof value !== 'object') return true;
  const known = catalogue.type(type);
  if (Array.isArray(value)) return value.every((each) => IsExact(catalogue, known?.element ?? '', each));
  return (known?.fields ?? []).every((field) => IsExact(catalogue, field.type, value[field.name]));
}

function Written(value, isInside) {
  if (typeof value === 'string') return isInside && !/^[A-Za-z_][A-Za-z0-9_]*$/.test(value) ? JSON.stringify(value) : value;
  if (value === null || typeof value !== 'object') return value === null ? 'nan' : String(value).replace('Infinity', 'inf');
  if (Array.isArray(value)) return `[${value.map((each) => Written(each, true)).join(', ')}]`;
  if ('sec' in value && 'nsec' in value) return `${value.sec * 1e9 + value.nsec}ns`;
  return `{${Object.entries(value).map(([name, field]) => `${name}: ${Written(field, true)}`).join(', ')}}`;
}

/** A value in a cell: pictures are told, not shown. */
export function FormatPortValue(meaning, value, { limit = 160, scales } = {}) {
  if (meaning === 'image' && value !== null) return `${value.width} × ${value.height} ${value.encoding}`;
  return FormatValue(value, limit, scales);
}

/** "640 B/s", "1.2 kB/s". */
export function FormatBandwidth(bytes) {
  if (bytes === null || bytes === undefined) return '';
  const [size, unit] = bytes >= 1e9 ? [bytes / 1e9, 'GB/s'] : bytes >= 1e6 ? [bytes / 1e6, 'MB/s']
    : bytes >= 1000 ? [bytes / 1000, 'kB/s'] : [bytes, 'B/s'];
  return `${size >= 100 || unit === 'B/s' ? size.toFixed(0) : size.toFixed(1)} ${unit}`;
}

/** How long ago: "0.2 s", "3 min". */
export function FormatAge(seconds) {
  if (seconds === null || seconds === undefined) return '';
  if (seconds < 99.95) return `${seconds.toFixed(1)} s`;
  return seconds < 5400 ? `${Math.round(seconds / 60)} min` : `${(seconds / 3600).toFixed(1)} h`;
}
