// Which outputs have published steadily and do so no more. What is published now and then is not silent.
// All times are of the application's clock, in seconds.

const kSteady = 3;   // for so long it must have published
const kPatience = 1.5; // for so long nothing may come: rates are counted in windows, of which one may be empty

export class Silence {
  #begun = new Map();  // port path -> when it began to publish
  #quiet = new Map();  // port path -> since when nothing has come
  silent = new Map();  // port path -> since when; another object after each change

  /** Rates as they have been told: {port path: rate}, only those that have changed. */
  note(rates, time) {
    for (const [path, rate] of Object.entries(rates)) {
      if (rate > 0) {
        if (!this.#begun.has(path)) this.#begun.set(path, time);
        this.#quiet.delete(path);
        if (this.silent.has(path)) this.#change((next) => next.delete(path));
      } else if (this.#begun.has(path) && !this.#quiet.has(path)) {
        this.#quiet.set(path, time);
      }
    }
    for (const [path, since] of this.#quiet) {
      if (time - since < kPatience) continue;
      if (since - this.#begun.get(path) >= kSteady) this.#change((next) => next.set(path, since));
      this.#begun.delete(path);
      this.#quiet.delete(path);
    }
  }

  forget() {
    this.#begun.clear();
    this.#quiet.clear();
    this.silent = new Map();
  }

  #change(change) {
    const next = new Map(this.silent);
    change(next);
    this.silent = next;
  }
}
