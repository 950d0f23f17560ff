// Which values the server is to send: what several parts of the page look at is asked for once, at
// the highest rate that one of them wants.

import { signal } from '@preact/signals';

const kRate = 10;
const kElements = 12;

export class Watches {
  #watched = new Map(); // path -> {value: signal, users: Set of {rate, elements}, asked}
  #send;

  constructor(send) {
    this.#send = send;
  }

  /**
   * A signal of {stamp, measured, count, value, cut, drops} or null, and the function that ends it. `onValue` gets the
   * same, null when the application has begun anew. `as`: 'image' has pictures come whole, as browsers take them; for whoever else
   * looks at the port, too.
   */
  watch(path, { rate = kRate, elements = kElements, as = '', onValue } = {}) {
    if (!this.#watched.has(path)) {
      this.#watched.set(path, { value: signal(null), users: new Set(), asked: '' });
    }
    const entry = this.#watched.get(path);
    const user = { rate, elements, as, onValue };
    entry.users.add(user);
    this.#ask(path, entry);
    if (onValue && entry.value.peek()) onValue(entry.value.peek());
    const end = () => {
      if (!entry.users.delete(user)) return;
      if (entry.users.size > 0) return this.#ask(path, entry);
      this.#watched.delete(path);
      this.#send({ op: 'unwatch', path });
    };
    return { value: entry.value, end };
  }

  /** A new connection knows of no watches. */
  askAgain() {
    this.askAgainFor(this.#watched.keys());
  }

  /** A value can only be watched once its port is there. */
  askAgainFor(paths) {
    for (const path of paths) {
      const entry = this.#watched.get(path);
      if (!entry) continue;
      entry.asked = '';
      this.#ask(path, entry);
    }
  }

  /** The values are those of a run that is over: users that look at one are told that there is none. */
  forget() {
    for (const entry of this.#watched.values()) {
      if (entry.value.peek() === null) continue;
      entry.value.value = null;
      for (const user of entry.users) user.onValue?.(null);
    }
  }

  receive(message) {
    for (const item of message.items) {
      const entry = this.#watched.get(item.path);
      if (!entry) continue;
      const { service } = entry.value.peek() ?? {};
      // Of a service, how it is doing comes alone, or its value does.
      const whole = item.service && item.value === undefined ? { ...entry.value.peek(), ...item } : service ? { service, ...item } : item;
      entry.value.value = whole;
      for (const user of entry.users) user.onValue?.(whole);
    }
  }

  #ask(path, entry) {
    const users = [...entry.users];
    const rate = Math.max(...users.map((user) => user.rate));
    const elements = Math.max(...users.map((user) => user.elements));
    const as = users.some((user) => user.as === 'image') ? { as: 'image' } : {};
    const asked = `${rate} ${elements} ${as.as}`;
    if (asked === entry.asked) return;
    if (this.#send({ op: 'watch', path, rate, elements, ...as })) entry.asked = asked;
  }
}
