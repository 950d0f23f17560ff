// The WebSocket to the application: made anew whenever it is lost, with requests that are answered.

import { Refusal, TokenProtocols } from './token.js';

const kProtocol = 'runnel.inspector.v1';
const kFirstPause = 250;   // ms before the next attempt
const kLongestPause = 2000;

export class Link {
  #socket = null;
  #pause = kFirstPause;
  #requests = new Map(); // number -> resolve
  #next = 1;
  #onMessage;
  #onState;
  #timer = null;

  /** `onState` is told 'connecting', 'open', 'lost' or 'refused' (then it is for show() to go on), and why. */
  constructor(url, token, { onMessage, onState }) {
    this.url = url;
    this.token = token;
    this.#onMessage = onMessage;
    this.#onState = onState;
  }

  open() {
    clearTimeout(this.#timer);
    this.#onState('connecting', '');
    const socket = new WebSocket(this.url, [kProtocol, ...TokenProtocols(this.token)]);
    this.#socket = socket;
    let wasOpen = false;
    socket.onopen = () => { wasOpen = true; this.#pause = kFirstPause; this.#onState('open', ''); };
    socket.onmessage = (event) => this.#receive(event.data);
    socket.onclose = (event) => this.#lost(event.reason, wasOpen);
  }

  /** Tries again with another token. */
  show(token) {
    this.token = token;
    this.open();
  }

  /** Without waiting for an answer; false if there is no connection. */
  send(message) {
    if (this.#socket?.readyState !== WebSocket.OPEN) return false;
    this.#socket.send(JSON.stringify(message));
    return true;
  }

  /** The server's reply; if the connection breaks, one that says so. Never rejects. */
  request(message) {
    const number = this.#next++;
    return new Promise((resolve) => {
      this.#requests.set(number, resolve);
      if (!this.send({ ...message, request: number })) this.#answer(number, NotConnected());
    });
  }

  #receive(text) {
    const message = JSON.parse(text);
    if (message.op === 'reply') this.#answer(message.request, message);
    else this.#onMessage(message);
  }

  #answer(number, reply) {
    this.#requests.get(number)?.(reply);
    this.#requests.delete(number);
  }

  async #lost(reason, wasOpen) {
    this.#socket = null;
    for (const number of [...this.#requests.keys()]) this.#answer(number, NotConnected());
    // Browsers do not say why a WebSocket is refused.
    const refusal = wasOpen ? '' : await Refusal(this.token);
    if (refusal) return this.#onState('refused', refusal);
    this.#onState('lost', reason);
    this.#timer = setTimeout(() => this.open(), this.#pause);
    this.#pause = Math.min(kLongestPause, this.#pause * 2);
  }
}

function NotConnected() {
  return { ok: false, errors: [{ message: 'the application does not answer: the connection is lost', path: '', hint: '' }] };
}
