// Two pages that look at a robot, and whether what they show is so: the inspector's and the operator's panel, over a network that
// can be stuck or cut.

import { OpenPage } from '../support/browser.mjs';
import { Network, OpenPanel } from '../support/panel.mjs';

const kLook = 20; // ms
// What a page says of STOP: 'free', 'in_force'; undefined: that it does not know; null: what would say it is not on the page.
const kClaims = {
  'the button': ({ stop }) => ({ free: 'free', in_force: 'in_force', nothing: 'in_force', unreached: 'in_force' })[stop],
  'the stick': ({ chip }) => (chip === 'STOP' ? 'in_force' : chip === '' ? null : /not (confirmed|known)/.test(chip) ? undefined : 'free'),
  'the values': ({ fresh }) => (fresh ? 'heard' : undefined),
};

/** Of a robot that is away nothing is known; of one that is heard it is said how it is. */
function IsSo(claim, truth) {
  if (claim === null) return true;
  return truth === 'away' ? claim === undefined : claim === truth || claim === 'heard';
}

/** In the page: writes down what it shows whenever that changes. */
function Record() {
  window.seen = [];
  let last = '';
  let ticked = Date.now();
  setInterval(() => {
    const gap = Date.now() - ticked;
    ticked = Date.now();
    const text = (id) => document.querySelector(id)?.textContent ?? '';
    const shows = { stop: document.querySelector('#stop-button')?.dataset.stop ?? '', chip: text('[data-driving]'),
      fresh: /^connected/.test(text('#connection-state')) && !document.querySelector('.stale') };
    if (gap < 500 && JSON.stringify(shows) === last) return;
    last = JSON.stringify(shows);
    window.seen.push({ at: ticked, gap, ...shows });
  }, 20);
}

export class Pages {
  looks = 0;
  longest = 0; // ms that one said otherwise, or nothing
  right = Object.fromEntries(Object.keys(kClaims).map((what) => [what, 0]));
  #truths = []; // {at, truth}, not compared yet
  #ends = [];
  #isCut = false;
  #states = []; // of each page: {name, page, shows, truth, lies: claim -> since when}

  static async Open(robot, watcher, limit) {
    const pages = new Pages();
    pages.limit = limit;
    const t = { after: (end) => pages.#ends.push(end) };
    pages.network = await Network(t, robot.url);
    const options = { lost: true, forgive: [/./] };
    const inspector = await OpenPage(t, pages.network.url, options);
    pages.panel = await OpenPanel(t, pages.network.url, options);
    for (const [name, { page }] of [['the inspector', inspector], ['the panel', pages.panel]]) {
      await page.evaluate(Record);
      pages.#states.push({ name, page, shows: null, truth: null, lies: new Map(), gap: 0 });
    }
    const look = () => {
      const truth = robot.away.is || pages.#isCut ? 'away' : watcher.truth.in_force ? 'in_force' : 'free';
      if (pages.#truths.at(-1)?.truth !== truth) pages.#truths.push({ at: Date.now(), truth });
    };
    look();
    pages.timer = setInterval(look, kLook);
    return pages;
  }

  /** Compares what has been seen since the last time with how it was. */
  async check(found) {
    const truths = this.#truths;
    this.#truths = truths.slice(-1).map((each) => ({ ...each }));
    for (const state of this.#states) {
      const seen = await state.page.evaluate(() => window.seen.splice(0)).catch(() => []);
      this.looks += seen.length;
      const events = [...truths, ...seen].sort((a, b) => a.at - b.at);
      for (const { at, truth, ...shows } of [...events, { at: Date.now() }]) {
        for (const [what, since] of state.lies) this.#took(state, what, at - since, found);
        if (truth) state.truth = truth;
        if (shows.stop !== undefined) Object.assign(state, { shows, gap: Math.max(state.gap, shows.gap) });
        this.#compare(state, at);
      }
    }
  }

  #compare(state, at) {
    if (!state.shows || !state.truth) return;
    for (const [what, claimOf] of Object.entries(kClaims)) {
      const claim = claimOf(state.shows);
      const isSo = IsSo(claim, state.truth);
      if (isSo && claim) this.right[what] += 1;
      if (isSo) state.lies.delete(what);
      else if (!state.lies.has(what)) state.lies.set(what, at);
    }
    if (state.lies.size === 0) state.gap = 0;
  }

  #took(state, what, time, found) {
    this.longest = Math.max(this.longest, time);
    if (time <= this.limit) return;
    found(`${what} of ${state.name} says ${JSON.stringify(state.shows)} for ${Math.round(time)} ms, and it is '${state.truth}'` +
      (state.gap > 500 ? `; the browser itself had no turn for ${state.gap} ms` : ''));
    state.lies.delete(what);
  }

  async press(random) {
    const { page } = random.of(this.#states);
    if (random.below(2) === 0) return page.keyboard.press('Control+Space');
    const { x, y, width, height } = await page.locator('#stop-button').boundingBox();
    return page.mouse.click(x + width / 2, y + height / 2);
  }

  async release(random) {
    const { page } = random.of(this.#states);
    const button = page.locator('#stop-release:enabled');
    if (await button.count() === 0) return;
    await button.click({ timeout: 1000 }).catch(() => {}); // it may be gone meanwhile
    await page.waitForFunction(() => document.querySelector('.release-problem') || document.querySelector('#stop-button').dataset.stop === 'free',
      undefined, { timeout: 3000 }).catch(() => {});
  }

  async drive(time) {
    const { keyboard } = this.panel.page;
    await keyboard.down('w');
    await new Promise((done) => { setTimeout(done, time); });
    await keyboard.up('w');
  }

  /** For a short time the connections are closed; for a long one they are stuck. */
  async cut(time) {
    if (time < 1000) return this.network.drop();
    this.#isCut = true;
    this.network.stick();
    await new Promise((done) => { setTimeout(done, time); });
    this.network.loosen();
    this.#isCut = false;
    return undefined;
  }

  settled() {
    return new Promise((done) => { setTimeout(done, this.limit + 200); });
  }

  async close() {
    clearInterval(this.timer);
    for (const end of this.#ends.reverse()) await end().catch(() => {});
  }
}
