// What of a text has become other: a unified difference, line by line (Myers' algorithm).

const kAround = 3; // lines that are told before and after a change
const kMost = 1000; // changed lines that are looked for one by one; beyond it all between is another one

/** [{kind: 'same' | 'gone' | 'new' | 'skipped', text, before, after}]: lines with their numbers, from 1. */
export function TextDifference(before, after) {
  const lines = Compared(Lines(before), Lines(after));
  const isNear = new Array(lines.length).fill(false);
  lines.forEach((line, index) => {
    if (line.kind === 'same') return;
    for (let at = Math.max(0, index - kAround); at <= Math.min(lines.length - 1, index + kAround); ++at) isNear[at] = true;
  });
  const told = [];
  lines.forEach((line, index) => {
    if (isNear[index]) told.push(line);
    else if (told.at(-1)?.kind === 'skipped') told.at(-1).count += 1;
    else told.push({ kind: 'skipped', count: 1, text: '' });
  });
  return told;
}

/** How many lines have come and gone: {added, removed}. */
export function CountChanges(lines) {
  const count = (kind) => lines.filter((line) => line.kind === kind).length;
  return { added: count('new'), removed: count('gone') };
}

function Lines(text) {
  const lines = text.split('\n');
  if (lines.at(-1) === '') lines.pop();
  return lines;
}

function Compared(before, after) {
  let start = 0;
  while (start < before.length && start < after.length && before[start] === after[start]) ++start;
  let end = 0;
  while (end < before.length - start && end < after.length - start &&
    before[before.length - 1 - end] === after[after.length - 1 - end]) ++end;
  const middle = Middle(before.slice(start, before.length - end), after.slice(start, after.length - end));
  const kinds = [...Array(start).fill('same'), ...middle, ...Array(end).fill('same')];
  let [from, to] = [0, 0];
  return kinds.map((kind) => {
    const line = { kind, text: kind === 'new' ? after[to] : before[from], before: null, after: null };
    if (kind !== 'new') line.before = ++from;
    if (kind !== 'gone') line.after = ++to;
    return line;
  });
}

/** The fewest steps from one list of lines to the other. */
function Middle(a, b) {
  const [n, m] = [a.length, b.length];
  const all = () => [...Array(n).fill('gone'), ...Array(m).fill('new')];
  if (n === 0 || m === 0) return all();
  const reach = [0]; // by diagonal k: how far in a; index k + offset
  const trace = [];
  const offset = Math.min(n + m, kMost) + 1;
  for (let d = 0; d <= Math.min(n + m, kMost); ++d) {
    trace.push(reach.slice());
    for (let k = -d; k <= d; k += 2) {
      const isDown = k === -d || (k !== d && (reach[k - 1 + offset] ?? -1) < (reach[k + 1 + offset] ?? -1));
      let x = d === 0 ? 0 : isDown ? reach[k + 1 + offset] : reach[k - 1 + offset] + 1;
      let y = x - k;
      while (x < n && y < m && a[x] === b[y]) { ++x; ++y; }
      reach[k + offset] = x;
      if (x >= n && y >= m) return Back(trace, n, m, offset);
    }
  }
  return all();
}

function Back(trace, n, m, offset) {
  const steps = [];
  let [x, y] = [n, m];
  for (let d = trace.length - 1; d > 0; --d) {
    const reach = trace[d];
    const k = x - y;
    const isDown = k === -d || (k !== d && (reach[k - 1 + offset] ?? -1) < (reach[k + 1 + offset] ?? -1));
    const previous = isDown ? k + 1 : k - 1;
    const fromX = reach[previous + offset];
    const fromY = fromX - previous;
    while (x > fromX && y > fromY) { steps.push('same'); --x; --y; }
    steps.push(isDown ? 'new' : 'gone');
    [x, y] = [fromX, fromY];
  }
  while (x > 0 && y > 0) { steps.push('same'); --x; --y; }
  return steps.reverse();
}
