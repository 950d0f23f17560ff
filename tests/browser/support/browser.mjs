// A browser for tests. What a page says to its console as an error, or throws, fails the test.

import assert from 'node:assert/strict';
import { mkdir } from 'node:fs/promises';
import { join } from 'node:path';
import { chromium } from 'playwright-core';
import { Cleanup } from './cleanup.mjs';

const kPatience = 60000; // ms that a condition may take to come true; nothing waits longer than it has to

// One browser for all tests of a file: to start one takes longer than most tests do. Each page has a context of its own,
// so that nothing that one keeps is found by another.
let launched = null;
let pages = 0;

function Browser() {
  launched ??= chromium.launch({ executablePath: process.env.RUNNEL_BROWSER, args: ['--no-sandbox', '--enable-unsafe-swiftshader'] });
  pages += 1;
  return launched;
}

/** A browser without pages ends, or it would hold this process; not at once, for the next test is about to open one. */
function PageIsGone() {
  pages -= 1;
  setTimeout(async () => {
    if (pages > 0 || !launched) return;
    const browser = launched;
    launched = null;
    await (await browser).close();
  }, 300);
}

/** Opens a page, which is closed after the test. */
export async function OpenPage(t, url, { width = 1280, height = 800, colours = 'light', lost = false, touch = false, shows = '[data-node]', forgive = [] } = {}) {
  const browser = await Browser();
  const context = await browser.newContext({ viewport: { width, height }, colorScheme: colours, reducedMotion: 'reduce', hasTouch: touch });
  const page = await context.newPage();
  page.setDefaultTimeout(kPatience);
  const complaints = [];
  const forgiven = [...forgive];
  page.on('pageerror', (error) => complaints.push(error.stack));
  page.on('console', (message) => {
    if (message.type() !== 'error' && message.type() !== 'warning') return;
    // A browser itself complains of a server that is away; `lost` says that the test takes it away.
    if (lost && /WebSocket connection to .* failed|ERR_CONNECTION_REFUSED/.test(message.text())) return;
    // Without a graphics card a browser says how it draws.
    if (/GPU stall due to ReadPixels/.test(message.text())) return;
    if (forgiven.some((each) => each.test(message.text()))) return;
    complaints.push(message.text());
  });
  Cleanup(t, async () => {
    await SayWhatIsOpen(page);
    await context.close();
    PageIsGone();
    assert.deepEqual(complaints, [], 'the page complains');
  });
  await page.goto(url);
  await page.locator('#connection-state', { hasText: 'connected' }).waitFor();
  await page.locator(shows).first().waitFor();
  return new InspectorPage(page, forgiven);
}

/** A dialog that is open at the end mostly belongs to a test that has failed: what it says tells why. */
async function SayWhatIsOpen(page) {
  for (const text of await page.locator('dialog[open]').allInnerTexts().catch(() => [])) {
    console.log(`# a dialog is open at the end:\n${text}`.replaceAll('\n', '\n#   '));
  }
}

/** What a user does with the page, in words. */
class InspectorPage {
  constructor(page, forgiven) {
    this.page = page;
    this.forgiven = forgiven;
    this.details = page.locator('#details');
  }

  /** From now on the browser may complain of this: the test means it to. */
  forgive(pattern) {
    this.forgiven.push(pattern);
  }

  node(path) {
    return this.page.locator(`[data-node="${path}"]`);
  }

  port(path) {
    return this.page.locator(`[data-port="${path}"]`);
  }

  edges() {
    return this.page.locator('path[data-edge]').evaluateAll((edges) => edges.map((edge) => edge.dataset.edge).sort());
  }

  /** The field of a parameter of what is selected. */
  parameter(name) {
    return this.details.getByLabel(name, { exact: true });
  }

  /** The same with what is said of it: bounds, problems. */
  parameterRow(name) {
    return this.details.locator('.parameter', { has: this.page.getByLabel(name, { exact: true }) });
  }

  /** Types into a field until `outcome` is seen: on a busy machine the page may have lost the application for a moment,
   *  and takes nothing then. */
  async enter(field, text, outcome) {
    for (let tries = 1; ; ++tries) {
      await field.fill(text);
      await field.press('Enter');
      try { return await outcome.waitFor({ timeout: 10000 }); } catch (error) { if (tries === 6) throw error; }
    }
  }

  /** Presses the mouse on the name of a box. */
  async click(path) {
    const name = this.node(path).locator('.name');
    await name.waitFor();
    await this.drawn();
    const { x, y, width, height } = await name.boundingBox();
    await this.page.mouse.click(x + width / 2, y + height / 2);
  }

  /** By the search, so that it does not matter where it is on the screen. */
  async select(path) {
    const words = path.split('/').filter(Boolean).join(' ');
    await this.page.locator('#search').fill(words);
    await this.page.locator('#search-found li', { has: this.page.locator(`.path:text-is("${path}")`) }).first().dispatchEvent('pointerdown');
    await this.shows(path);
  }

  /** Waits until the details are those of `path`, and keys mean it. */
  async shows(path) {
    await this.page.locator(`#details[data-element="${path}"]`).waitFor();
    await this.drawn();
  }

  /** Waits until no dialog is open: what it asked for has been answered then, and keys mean the page. */
  async closed() {
    await this.page.locator('dialog').waitFor({ state: 'detached' });
    await this.drawn();
  }

  /** Waits until what has been asked for so far is on the screen: keys go to what has the focus then. */
  drawn() {
    return this.page.evaluate(() => new Promise((done) => { requestAnimationFrame(() => requestAnimationFrame(done)); }));
  }

  /** Waits until a function of the page's document holds; `what` is told if it never does. */
  async until(what, check, argument) {
    try {
      await this.page.waitForFunction(check, argument);
    } catch (error) {
      throw new Error(`never came: ${what}`, { cause: error });
    }
  }

  /** The clock of the application, in seconds. */
  async time() {
    const text = await this.page.locator('#time').textContent();
    return text.endsWith(' s') ? Number.parseFloat(text)
      : text.split(':').reduce((seconds, part) => seconds * 60 + Number(part), 0);
  }

  async dragPort(from, to) {
    await this.port(from).waitFor();
    await this.port(to).waitFor();
    await this.drawn();
    const [a, b] = [this.port(from).locator('circle'), this.port(to).locator('circle')];
    const [start, end] = [await a.boundingBox(), await b.boundingBox()];
    const middle = ({ x, y, width, height }) => [x + width / 2, y + height / 2];
    await this.page.mouse.move(...middle(start));
    await this.page.mouse.down();
    await this.page.mouse.move(...middle(end).map((value) => value + 6), { steps: 4 });
    return { drop: () => this.page.mouse.up() };
  }

  /** A picture into the build tree. */
  async picture(name) {
    await mkdir('pictures', { recursive: true });
    await this.page.screenshot({ path: join('pictures', `${name}.png`) });
  }
}
