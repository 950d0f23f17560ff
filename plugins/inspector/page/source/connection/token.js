// The secret that a server may want: it comes behind '#' in the address, which browsers send to nobody, and is kept for
// this server alone (another port of the same machine is another place to a browser's storage, and not to cookies).

const kKey = 'runnel.token';

/** Takes the token out of the address, so that it is neither shared nor remembered with it; else the kept one; '' if none. */
export function TakeToken(location, history, storage) {
  for (const part of ['hash', 'search']) {
    const rest = location[part].slice(1).split('&').filter((each) => each !== '');
    const found = rest.find((each) => each.startsWith('token='));
    if (!found) continue;
    Keep(found.slice('token='.length), storage);
    const start = part === 'hash' ? '#' : '?';
    const left = rest.filter((each) => each !== found).join('&');
    const parts = { search: location.search, hash: location.hash, [part]: left ? start + left : '' };
    history.replaceState(history.state, '', location.pathname + parts.search + parts.hash);
    break;
  }
  return Kept(storage);
}

export function Keep(token, storage) {
  try { storage.setItem(kKey, token); } catch { /* a browser that keeps nothing: for this page only */ }
  inMemory = token;
}

/** What the browser keeps for pages; undefined: nothing, where even to ask for it is an error. */
export function OwnStorage() {
  try { return globalThis.localStorage; } catch { return undefined; }
}

/** The one that is kept, or ''. */
export const CurrentToken = () => Kept(OwnStorage());

/** What a WebSocket offers to show the token: headers of its own it cannot have, and an address is written down. */
export const TokenProtocols = (token) => (/^[\w.~-]+$/.test(token) ? [`runnel.token.${token}`] : []);

// A network that is just coming back may answer nothing for minutes, and the page must try again.
const kAnswer = 2000;

/** Why the server lets nobody talk with this token, in its words; '' if it would, or does not answer. */
export async function Refusal(token) {
  try {
    const reply = await fetch('/access', { headers: token ? { Authorization: `Bearer ${token}` } : {}, cache: 'no-store', signal: AbortSignal.timeout(kAnswer) });
    return reply.status === 401 || reply.status === 403 ? (await reply.text()).trim() : '';
  } catch {
    return '';
  }
}

let inMemory = '';
function Kept(storage) {
  try { return storage.getItem(kKey) ?? inMemory; } catch { return inMemory; }
}
