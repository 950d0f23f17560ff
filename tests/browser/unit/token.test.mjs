import assert from 'node:assert/strict';
import { test } from 'node:test';
import { CurrentToken, OwnStorage, TakeToken, TokenProtocols } from '../../../plugins/inspector/page/source/connection/token.js';

class Storage {
  #items = new Map();
  getItem(key) { return this.#items.get(key) ?? null; }
  setItem(key, value) { this.#items.set(key, value); }
}

/** What a page at this address takes, and what is left of the address. */
function Take(search, hash, storage = new Storage()) {
  let address = null;
  const history = { state: null, replaceState: (state, title, to) => { address = to; } };
  const token = TakeToken({ pathname: '/', search, hash }, history, storage);
  return { token, address, storage };
}

test('a token is taken out of the address, and the rest of it stays', () => {
  assert.deepEqual([Take('', '#token=abc').token, Take('', '#token=abc').address], ['abc', '/']);
  assert.equal(Take('?a=1', '#select=/robot&token=abc').address, '/?a=1#select=/robot');
  const old = Take('?token=abc&a=1', '#x');
  assert.deepEqual([old.token, old.address], ['abc', '/?a=1#x']);
  assert.equal(Take('?mytoken=abc', '#').address, null);
});

test('a token is kept, and another one takes its place', () => {
  const { storage } = Take('', '#token=abc');
  assert.equal(Take('', '', storage).token, 'abc');
  assert.equal(Take('', '#token=def', storage).token, 'def');
  assert.equal(Take('', '', storage).token, 'def');
});

test('only what fits into a header is offered', () => {
  assert.deepEqual(TokenProtocols('Ab-9._~'), ['runnel.token.Ab-9._~']);
  for (const none of ['', 'a b', 'a,b', 'ä']) assert.deepEqual(TokenProtocols(none), []);
});

test('a page begins in a browser that may not even be asked for what it keeps', () => {
  Object.defineProperty(globalThis, 'localStorage', { configurable: true, get() { throw new Error('it is refused'); } });
  assert.equal(typeof CurrentToken(), 'string');
  assert.equal(Take('', '#token=ghi', OwnStorage()).token, 'ghi');
  assert.equal(CurrentToken(), 'ghi', 'for this page');
  delete globalThis.localStorage;
});
