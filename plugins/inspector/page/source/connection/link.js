// The WebSocket to the application: made anew whenever it is lost, with requests that are answered.

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

  /** `onState` is told 'connecting', 'open' or 'lost', and why. */
  constructor(url, { onMessage, onState }) {
    this.url = url;
    this.#onMessage = onMessage;
    this.#onState = onState;
  }

  open() {
    this.#onState('connecting', '');
    const socket = new WebSocket(this.url, [kProtocol]);
    this.#socket = socket;
    socket.onopen = () => { this.#pause = kFirstPause; this.#onState('open', ''); };
    socket.onmessage = (event) => this.#receive(event.data);
    socket.onclose = (event) => this.#lost(event.reason);
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

  #lost(reason) {
    this.#socket = null;
    for (const number of [...this.#requests.keys()]) this.#answer(number, NotConnected());
    this.#onState('lost', reason);
    setTimeout(() => this.open(), this.#pause);
    this.#pause = Math.min(kLongestPause, this.#pause * 2);
  }
}

function NotConnected() {
  return { ok: false, errors: [{ message: 'the application does not answer: the connection is lost', path: '', hint: '' }] };
}
