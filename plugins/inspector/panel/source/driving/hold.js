// One hold of a port by hand: as long as somebody holds it, what he wants is sent many times a second. The server
// stops the robot when it has not heard of the hold for a while, whatever has become of this page; the hold has ended
// then, and another one begins by letting go and taking hold anew.

export const kPeriod = 50;     // ms, between two values
export const kDeadline = 0.25; // s, without a value, after which the server has the robot rest
const kRate = 20;              // Hz of the application's time: what looks at the age of commands has a fresh one
const kUnanswered = 4;         // values on their way: more would come late, all at once, when a network is back
export const kPatience = 20;   // periods, answers included that are older: nobody says any more that the robot does what is wanted

export class Hold {
  #port;
  #request;
  #onEnd;
  #text;
  #rest;
  #lease;
  #timer = 0;
  #unanswered = 0;
  #heard = performance.now(); // when that was sent of which the answer came last

  /** `rest` is the last value, which stays until the port is released; `onEnd` is told why the hold has ended by itself. */
  constructor(port, text, { rest, request, onEnd }) {
    this.#port = port;
    this.#text = text;
    this.#rest = rest;
    this.#request = request;
    this.#onEnd = onEnd;
    this.#lease = crypto.getRandomValues(new Uint32Array(3)).join('-');
    this.#timer = setInterval(() => this.#turn(), kPeriod);
    this.#send();
  }

  /** What is wanted from now on. */
  set(text) {
    this.#text = text;
  }

  /** Lets go. */
  end() {
    if (this.#timer === 0) return;
    this.#stop();
    this.#request({ op: 'publish', path: this.#port, value: this.#rest, lease: this.#lease });
  }

  #stop() {
    clearInterval(this.#timer);
    this.#timer = 0;
  }

  #turn() {
    if (this.#timer === 0) return undefined;
    if (performance.now() - this.#heard <= kPatience * kPeriod) return this.#send();
    this.end();
    this.#onEnd([{ message: `the application has not answered for ${kPatience * kPeriod / 1000} s: this hold has ended` }]);
    return undefined;
  }

  async #send() {
    if (this.#unanswered >= kUnanswered) return;
    this.#unanswered += 1;
    const sent = performance.now();
    const reply = await this.#request({ op: 'publish', path: this.#port, value: this.#text, rate: kRate,
      deadline: kDeadline, lease: this.#lease });
    this.#unanswered -= 1;
    this.#heard = sent;
    if (reply.ok || this.#timer === 0) return;
    this.#stop();
    this.#onEnd(reply.errors ?? []);
  }
}
