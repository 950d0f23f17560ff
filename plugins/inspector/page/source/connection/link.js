// The WebSocket to the application: made anew whenever it is lost, with requests that are answered.

import { Refusal, TokenProtocols } from './token.js';

const kViewer = 'runnel.inspector.v1';
const kFirstPause = 250;   // ms before the next attempt
const kLongestPause = 2000;
const kSilent = 2000;      // ms since the server has given the newest sign of life, of which it gives one each second
const kGivenUp = 10000;    // ms of it after which another connection is tried
const kDrift = 5e-4;       // two clocks do not run apart faster
const kLook = 250;

export class Link {
  #socket = null;
  #pause = kFirstPause;
  #requests = new Map(); // number -> resolve
  #next = 1;
  #onMessage;
  #onState;
  #timer = null;
  #given = 0; // when the newest sign of life was given, by this page's clock
  #offset = Infinity; // of the server's clock to this page's, as of the sign of life that was quickest on its way
  #isSilent = false;
  /** When the newest sign of life of this connection was said, in seconds of the server's machine; 0: there was none yet. */
  at = 0;
  static #all = [];

  /**
   * `onState` is told 'connecting', 'open', 'silent' (there is no fresh sign of life; 'open' again when there is one), 'lost' or
   * 'refused' (then it is for show() to go on), and why. Of signs of life `onMessage` gets those that are fresh, with `given`.
   */
  constructor(url, token, { protocol = kViewer, onMessage, onState }) {
    this.protocol = protocol;
    this.url = url;
    this.token = token;
    this.#onMessage = onMessage;
    this.#onState = onState;
    Link.#all.push(this);
    setInterval(() => this.#listen(), kLook);
  }

  open() {
    clearTimeout(this.#timer);
    this.#onState('connecting', '');
    const socket = new WebSocket(this.url, [this.protocol, ...TokenProtocols(this.token)]);
    this.#socket = socket;
    this.#given = performance.now();
    this.#offset = Infinity;
    this.#isSilent = false;
    this.at = 0;
    let wasOpen = false;
    socket.onopen = () => { wasOpen = true; this.#pause = kFirstPause; this.#hear(performance.now(), 'open'); };
    socket.onmessage = (event) => this.#receive(event.data);
    socket.onclose = (event) => { if (this.#socket === socket) this.#lost(event.reason, wasOpen); };
  }

  #hear(given, state = this.#isSilent ? 'open' : '') {
    this.#given = given;
    this.#isSilent = false;
    if (state) this.#onState(state, '');
  }

  /** What was said long ago and comes only now says nothing of how the server is. */
  #takeLife(message) {
    const now = performance.now();
    this.#offset = Math.min(this.#offset + kDrift * (now - this.#given), now - message.at * 1000);
    const given = message.at * 1000 + this.#offset;
    if (!(now - given <= kSilent)) return; // nor what does not say when it was
    this.#hear(given);
    this.at = message.at;
    this.#onMessage({ ...message, given });
  }

  #listen() {
    if (this.#socket === null) return;
    const silence = performance.now() - this.#given;
    if (silence > kGivenUp) {
      const socket = this.#socket;
      this.#lost('no sign of life', true);
      socket.close();
    } else if (silence > kSilent && !this.#isSilent && this.#socket.readyState === WebSocket.OPEN) {
      this.#isSilent = true;
      this.#onState('silent', '');
    }
  }

  /** Tries again with another token. */
  show(token) {
    this.token = token;
    this.open();
  }

  /**
   * Now by the server's clock, or somewhat earlier; undefined: it is not known. What one of the page's connections has told was
   * before this, whichever is asked.
   */
  asked() {
    const offset = Math.min(...Link.#all.map((link) => link.#offset));
    return offset < Infinity ? (performance.now() - offset) / 1000 : undefined;
  }

  /** Without waiting for an answer; false if there is no connection. */
  send(message) {
    if (this.#socket?.readyState !== WebSocket.OPEN) return false;
    this.#socket.send(JSON.stringify(message));
    return true;
  }

  /**
   * The server's reply; if the connection breaks, one that says so. Never rejects. It says when the person asked: what has been
   * stopped since is not moved by it.
   */
  request(message) {
    const number = this.#next++;
    return new Promise((resolve) => {
      this.#requests.set(number, resolve);
      if (!this.send({ at: this.asked(), ...message, request: number })) this.#answer(number, Lost('there is no connection to the application: nothing has been sent'));
    });
  }

  #receive(text) {
    const message = JSON.parse(text);
    if (message.op === 'alive') this.send({ op: 'alive', at: message.at }); // by which an operator is heard, as of then
    if (message.op === 'reply') this.#answer(message.request, message);
    else if (message.op === 'alive') this.#takeLife(message);
    else this.#onMessage(message);
  }

  #answer(number, reply) {
    this.#requests.get(number)?.(reply);
    this.#requests.delete(number);
  }

  async #lost(reason, wasOpen) {
    this.#socket = null;
    this.#offset = Infinity;
    for (const number of [...this.#requests.keys()]) this.#answer(number, Lost('the connection was lost before the answer came: it may have been carried out'));
    // Browsers do not say why a WebSocket is refused.
    const refusal = wasOpen ? '' : await Refusal(this.token);
    if (this.#socket) return undefined; // opened anew meanwhile
    if (refusal) return this.#onState('refused', refusal);
    this.#onState('lost', reason);
    this.#timer = setTimeout(() => this.open(), this.#pause);
    this.#pause = Math.min(kLongestPause, this.#pause * 2);
  }
}

function Lost(message) {
  return { ok: false, lost: true, errors: [{ message, path: '', hint: '' }] };
}
