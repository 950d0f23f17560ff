// The numbers of one curve: times and values, the newest `capacity` of them.

export class Series {
  constructor(capacity = 20000) {
    this.capacity = capacity;
    this.times = [];
    this.values = [];
  }

  /** A clock that goes back (the application began anew) begins a new curve. */
  add(time, value) {
    const last = this.times.length > 0 ? this.times[this.times.length - 1] : -Infinity;
    if (time === last) return;
    if (time < last) this.clear();
    this.times.push(time);
    this.values.push(value);
    if (this.times.length > this.capacity * 1.25) {
      this.times.splice(0, this.times.length - this.capacity);
      this.values.splice(0, this.values.length - this.capacity);
    }
  }

  clear() {
    this.times = [];
    this.values = [];
  }

  get lastTime() {
    return this.times.length > 0 ? this.times[this.times.length - 1] : null;
  }

  /**
   * The part from `from` to `to` (s), with one point beyond each end, as [times, values]; of more than
   * `most` points only the least and the greatest of each stretch, so that no peak is lost.
   */
  window(from, to, most = 1500) {
    const begin = Math.max(0, FirstNotBelow(this.times, from) - 1);
    const end = Math.min(this.times.length, FirstNotBelow(this.times, to) + 1);
    const times = this.times.slice(begin, end);
    const values = this.values.slice(begin, end);
    return times.length > most ? Thin(times, values, most) : [times, values];
  }
}

function FirstNotBelow(times, time) {
  let [low, high] = [0, times.length];
  while (low < high) {
    const middle = (low + high) >> 1;
    if (times[middle] < time) low = middle + 1;
    else high = middle;
  }
  return low;
}

function Thin(times, values, most) {
  const stretch = Math.ceil(times.length / (most / 2));
  const thin = [[], []];
  for (let at = 0; at < times.length; at += stretch) {
    let [least, greatest] = [at, at];
    for (let i = at; i < Math.min(at + stretch, times.length); ++i) {
      if (values[i] < values[least]) least = i;
      if (values[i] > values[greatest]) greatest = i;
    }
    for (const i of least === greatest ? [least] : [Math.min(least, greatest), Math.max(least, greatest)]) {
      thin[0].push(times[i]);
      thin[1].push(values[i]);
    }
  }
  return thin;
}
