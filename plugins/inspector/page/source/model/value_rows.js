// A value as rows of a table, with its fields' units, and the numbers in it that can be plotted.

import { IsTime, SecondsOf } from './value_format.js';

const kDepth = 6;

/**
 * Rows of a value: {field: ['ranges', 3], name, depth, value, unit, type, leaf}. `open` says which
 * long lists are shown; of others a row tells their length.
 */
export function ValueRows(catalogue, typeName, value, open = () => true) {
  const rows = [];
  Walk(catalogue, typeName, value, { field: [], name: '', unit: '', description: '' }, rows, open);
  return rows;
}

function Walk(catalogue, typeName, value, at, rows, open) {
  const type = catalogue.type(typeName);
  const depth = at.field.length;
  const compound = value !== null && typeof value === 'object' && !IsTime(value) && depth < kDepth;
  const row = { ...at, depth, type: typeName, value, leaf: !compound };
  if (!compound || depth > 0) rows.push(row);
  if (!compound) return;
  if (Array.isArray(value)) {
    row.length = value.length;
    row.open = depth === 0 || open(at.field);
    if (!row.open) return;
    value.forEach((element, index) => Walk(catalogue, type?.element, element,
      { field: [...at.field, index], name: `[${index}]`, unit: at.unit, description: '' }, rows, open));
    return;
  }
  const fields = new Map((type?.fields ?? []).map((field) => [field.name, field]));
  for (const [name, element] of Object.entries(value)) {
    const field = fields.get(name);
    Walk(catalogue, field?.type, element,
      { field: [...at.field, name], name, unit: field?.unit ?? '', description: field?.description ?? '' },
      rows, open);
  }
}

/** The number at a place in a value; true and false are 1 and 0; null if there is none. */
export function NumberAt(value, field) {
  let at = value;
  for (const step of field) {
    if (at === null || typeof at !== 'object') return null;
    at = at[step];
  }
  if (typeof at === 'boolean') return at ? 1 : 0;
  if (IsTime(at)) return SecondsOf(at);
  return typeof at === 'number' && Number.isFinite(at) ? at : null;
}

/** Whether a row can be plotted. */
export function IsPlottable(row) {
  return row.leaf && (typeof row.value === 'number' || typeof row.value === 'boolean' ||
    row.value === null || IsTime(row.value));
}

/** "ranges[3]", "position.x", or "" for a value that is a number itself. */
export function FieldText(field) {
  return field.map((step, index) =>
    (typeof step === 'number' ? `[${step}]` : index === 0 ? step : `.${step}`)).join('');
}
