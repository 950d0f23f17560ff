// Numbers, times and values as people read them.

export const kNoText = 'has no text form'; // of values that only modules can read

/** A number with about four significant digits, without jumping between notations while it changes. */
export function FormatNumber(number) {
  if (number === null || number === undefined || Number.isNaN(number)) return 'NaN';
  if (!Number.isFinite(number)) return number > 0 ? '∞' : '−∞';
  const size = Math.abs(number);
  if (Number.isInteger(number) && size < 1e9) return Minus(String(number));
  if (size >= 1e6 || size < 1e-4) return Minus(number.toExponential(3));
  const decimals = size >= 1000 ? 1 : size >= 100 ? 2 : size >= 0.01 ? 3 : 5;
  return Minus(number.toFixed(decimals));
}

/** A rate in Hz: "20 Hz", "19.8 Hz", "0 Hz". */
export function FormatRate(rate) {
  if (!rate) return '0 Hz';
  if (rate >= 10000) return `${(rate / 1000).toFixed(0)} kHz`;
  const rounded = Math.round(rate);
  if (rate >= 100 || Math.abs(rate - rounded) < 0.05) return `${rounded} Hz`;
  return `${rate.toFixed(1)} Hz`;
}

/** Milliseconds in a unit that suits: "0.18 ms", "45 µs", "1.2 s". */
export function FormatMilliseconds(milliseconds) {
  if (milliseconds === null || milliseconds === undefined) return '–';
  const size = Math.abs(milliseconds);
  if (size >= 1000) return `${Digits(milliseconds / 1000)} s`;
  if (size >= 0.1 || size === 0) return `${Digits(milliseconds)} ms`;
  return `${Digits(milliseconds * 1000)} µs`;
}

export function FormatMicroseconds(microseconds) {
  return FormatMilliseconds(microseconds === null || microseconds === undefined ? null : microseconds / 1000);
}

/** Seconds as a clock: "12.35 s", "1:02:03.4". */
export function FormatTime(seconds) {
  if (seconds === null || seconds === undefined) return '–';
  // Rounded before it is divided, lest 119.97 s become "1:60.0".
  const tenths = Math.round(seconds * 10);
  if (tenths < 600) return `${seconds.toFixed(2)} s`;
  const rest = ((tenths % 600) / 10).toFixed(1).padStart(4, '0');
  const minutes = Math.floor(tenths / 600) % 60;
  const hours = Math.floor(tenths / 36000);
  return hours > 0 ? `${hours}:${String(minutes).padStart(2, '0')}:${rest}` : `${minutes}:${rest}`;
}

/**
 * A whole value in one line, cut at `limit` letters. With `scales`, which is kept from value to value, its
 * numbers stand where they stood before.
 */
export function FormatValue(value, limit = 60, scales = undefined) {
  const text = Short(value, (number, field) => (scales ? scales.format(number, field) : FormatNumber(number)), '');
  return text.length > limit ? `${text.slice(0, limit - 1)}…` : text;
}

/** The bounds of a parameter: "0.02 … 2 m", "≥ 0", or "". */
export function FormatBounds({ minimum, maximum, unit }) {
  const has = (bound) => Number.isFinite(bound);
  const short = (bound) => Minus(String(Number(bound.toPrecision(5))));
  const suffix = unit ? ` ${unit}` : '';
  if (has(minimum) && has(maximum)) return `${short(minimum)} … ${short(maximum)}${suffix}`;
  if (has(minimum)) return `≥ ${short(minimum)}${suffix}`;
  return has(maximum) ? `≤ ${short(maximum)}${suffix}` : '';
}

/** Times and durations come as {sec, nsec}. */
export function IsTime(value) {
  return value !== null && typeof value === 'object' && 'sec' in value && 'nsec' in value;
}

export function SecondsOf(time) {
  return time.sec + time.nsec * 1e-9;
}

function Digits(number) {
  return Math.abs(number) >= 100 ? number.toFixed(0) : number.toFixed(Math.abs(number) >= 10 ? 1 : 2);
}

function Minus(text) {
  return text.replace(/^-/, '−').replace('e-', 'e−');
}

function Short(value, format, at) {
  if (typeof value === 'number' || value === null || value === undefined) return format(value, at);
  if (typeof value === 'string') return value;
  if (typeof value === 'boolean') return value ? 'true' : 'false';
  if (Array.isArray(value)) {
    const some = value.slice(0, 4).map((element) => Short(element, format, `${at}[]`)).join(', ');
    return value.length > 4 ? `[${some}, … ${value.length}]` : `[${some}]`;
  }
  if (IsTime(value)) return `${FormatNumber(SecondsOf(value))} s`;
  return Object.entries(value).map(([name, field]) => `${name} ${Short(field, format, `${at}.${name}`)}`).join(', ');
}
