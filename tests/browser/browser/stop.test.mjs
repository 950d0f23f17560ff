// STOP is no widget: one button, on each page the same and always there, which says what the robot has confirmed.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { OpenMock, OpenMockPanel } from '../support/open_mock.mjs';
import { OpenPanel } from '../support/panel.mjs';

const kText = { id: 'note', kind: 'text', x: 0, y: 0, w: 3, h: 2, text: 'by hand' };
const Stops = (application) => application.asked.filter(({ op }) => op === 'stop');
const IsByOwn = (application) => new Set(Stops(application).map(({ isOwn }) => isOwn === true));
const Stands = (page, how) => page.locator(`#stop-button[data-stop="${how}"]`).waitFor();

/** Presses, and waits until the robot has confirmed it: by one message over the connection that bears nothing else. */
async function Presses(application, page, press = () => page.locator('#stop-button').click()) {
  const before = Stops(application).length;
  await press();
  await Stands(page, 'in_force');
  await page.locator('#stop-banner[data-stop="in_force"]').waitFor({ state: 'attached' }); // a dialog shows the button alone
  assert.equal(Stops(application).length, before + 1, 'one message');
  assert.equal(Stops(application).at(-1).isOwn, true, 'over a connection of its own');
}

/** A function that tells what the button has said since. */
async function Listens(page) {
  await page.evaluate(() => {
    window.said = [];
    new MutationObserver(() => window.said.push(document.querySelector('#stop-button').dataset.stop)).observe(document.querySelector('#stop-button'), { attributes: true });
  });
  return () => page.evaluate(() => window.said);
}

async function Releases(page) {
  await page.locator('#stop-release').click();
  await Stands(page, 'free');
  await page.locator('#stop-banner').waitFor({ state: 'detached' });
}

test('it looks the same over a menu and a dialog, where what deletes can be read, too', async (t) => {
  const { inspector, page } = await OpenMock(t);
  const colours = (of) => page.locator(of).evaluate((each) => {
    const { color, backgroundColor, borderBottomWidth } = getComputedStyle(each);
    return [color, backgroundColor, borderBottomWidth];
  });
  await Stands(page, 'free');
  const before = await colours('#stop-button');
  await inspector.node('/mock/laser').locator('.body').click({ button: 'right' });
  await page.locator('dialog.menu #stop-button').waitFor();
  await page.mouse.move(0, 0);
  assert.deepEqual(await colours('#stop-button'), before, 'over a menu');
  await page.getByRole('menuitem', { name: 'Delete' }).click();
  await page.locator('#confirm-yes').waitFor();
  await page.mouse.move(0, 0);
  assert.deepEqual(await colours('#stop-button'), before, 'over a dialog');
  const [word, ground] = await colours('#confirm-yes');
  assert.notEqual(word, ground);
});

test('it is on each page, in the same place, shows the same, and is released by another act', async (t) => {
  const { application, server, page } = await OpenMock(t);
  const { page: panel } = await OpenPanel(t, server.url, { shows: '[data-widget]' });
  const { page: phone } = await OpenPage(t, server.url, { width: 390, height: 844, touch: true });
  const { page: small } = await OpenPanel(t, server.url, { width: 390, height: 844, touch: true, shows: '[data-widget]' });
  const all = [page, panel, phone, small];
  const heights = () => small.locator('.column .card').evaluateAll((cards) => cards.map(({ clientHeight }) => clientHeight));
  const before = await heights();
  for (const each of all) {
    await Stands(each, 'free');
    assert.match(await each.locator('#stop-spoken').textContent(), /not in force/);
    await Presses(application, each);
    for (const other of all) {
      await Stands(other, 'in_force');
      assert.match(await other.locator('#stop-spoken[aria-live="assertive"]').textContent(), /STOP is in force/);
    }
    const box = await each.locator('#stop-button').boundingBox();
    assert.deepEqual(await heights(), before, 'what is on a phone is scrolled, and not pressed together, by the banner');
    await Releases(all[(all.indexOf(each) + 1) % all.length]);
    await Stands(each, 'free');
    assert.deepEqual(await each.locator('#stop-button').boundingBox(), box, 'it stands where it stood');
  }
  const boxes = [];
  for (const each of all) boxes.push(await each.locator('#stop-button').boundingBox());
  assert.equal(boxes[0].y, boxes[1].y);
  assert.deepEqual(boxes[2], boxes[3]);
  assert.ok(boxes[2].width > 340 && boxes[2].height >= 48 && boxes[2].y > 700 && boxes[2].y + boxes[2].height <= 844, JSON.stringify(boxes[2]));
  assert.equal(await phone.locator('#pause-all').textContent(), 'Pause');
  assert.equal(await phone.evaluate(() => document.documentElement.scrollWidth), 390);
});

test('whatever is on the page: arranged, blank, broken, refused, behind a dialog', async (t) => {
  await t.test('while the panel is arranged', async (own) => {
    const { application, page } = await OpenMockPanel(own, { widgets: [kText] });
    await page.locator('#edit').click();
    await page.locator('.card.editing').first().waitFor();
    await Presses(application, page);
  });
  await t.test('in a panel without widgets', async (own) => {
    const { application, page } = await OpenMockPanel(own, { widgets: [], shows: '.empty-panel' });
    await Presses(application, page);
    await Releases(page);
  });
  await t.test('over a widget that cannot be drawn', async (own) => {
    const gauge = { id: 'gauge', kind: 'gauge', x: 0, y: 0, w: 2, h: 4, target: '/mock/world/pose', minimum: '0' };
    const { application, page } = await OpenMockPanel(own, { widgets: [gauge], shows: '.broken', forgive: [/cannot be drawn/] });
    await Presses(application, page);
  });
  await t.test('of a panel that cannot be read', async (own) => {
    const { application, page } = await OpenMockPanel(own, { shows: '.toast.error', prepare: (mock) => {
      mock.answers.panel = (reply) => reply({ ok: false, errors: [{ message: 'it is broken', path: null, hint: null }] });
    } });
    await Presses(application, page);
  });
  await t.test('behind a modal dialog, and after it', async (own) => {
    const { application, inspector, page } = await OpenMock(own);
    await page.locator('#help').click();
    await page.locator('dialog[open]').waitFor();
    await Presses(application, page);
    await page.keyboard.press('Escape');
    await inspector.closed();
    await Releases(page);
    await Presses(application, page);
  });
});

test('without a pointer: a click alone, keys wherever one is, a gamepad', async (t) => {
  const { application, page } = await OpenMock(t);
  await Presses(application, page, () => page.locator('#stop-button').evaluate((button) => button.click()));
  await Releases(page);
  await page.locator('#stop-button').focus();
  await Presses(application, page, () => page.keyboard.press('Enter'));
  await Releases(page);
  await page.locator('#search').focus();
  await Presses(application, page, () => page.keyboard.press('Control+Space'));
  await Releases(page);
  await page.keyboard.press('?');
  await page.locator('dialog[open]').waitFor();
  await Presses(application, page, () => page.keyboard.press('Pause'));
  await page.keyboard.press('Escape');
  await page.locator('dialog').waitFor({ state: 'detached' });
  await Releases(page);
  const pad = (pressed) => ({ connected: true, index: 0, id: 'Pad', mapping: 'standard', axes: [0, 0], buttons: [0, 1, 2].map((at) => ({ pressed: at === pressed })) });
  await page.evaluate((one) => { window.pads = [one]; navigator.getGamepads = () => window.pads; }, pad(-1));
  await page.waitForTimeout(150); // until it has been seen released
  await Presses(application, page, () => page.evaluate((one) => { window.pads = [one]; }, pad(1)));
});

test('who may only look presses, and cannot release', async (t) => {
  const { application, page } = await OpenMockPanel(t, { widgets: [kText], readOnly: true });
  await Presses(application, page);
  assert.equal(await page.locator('#stop-release').isDisabled(), true);
});

test('a refused STOP, and one that nobody confirms, are red, and say so', async (t) => {
  const { application, page } = await OpenMockPanel(t, { widgets: [kText] });
  application.answers.stop = (reply) => reply({ ok: false, errors: [{ message: 'not today', path: null, hint: null }] });
  await page.locator('#stop-button').click();
  await page.locator('#stop-banner[data-stop="refused"]', { hasText: 'not today' }).waitFor();
  assert.match(await page.locator('#stop-spoken').textContent(), /refused/);
  application.answers = {};
  application.isFrozen = true;
  await page.locator('#stop-button').click();
  await page.locator('#stop-banner[data-stop="unconfirmed"]', { hasText: 'has not been confirmed' }).waitFor();
  application.isFrozen = false;
  await Stands(page, 'in_force');
  await page.locator('#stop-banner[data-stop="in_force"]').waitFor();

  await t.test('one that was in force when the robot fell silent is not called confirmed', async () => {
    application.isFrozen = true;
    await page.locator('#stop-banner[data-stop="unknown"]', { hasText: 'not been confirmed since' }).waitFor();
    application.isFrozen = false;
    await Stands(page, 'in_force');
  });
  await t.test('a release that is refused says why, and it stays in force', async () => {
    application.answers.release = (reply) => reply({ ok: false, errors: [{ message: 'the button is down', path: null, hint: null }] });
    await page.locator('#stop-release').click();
    await page.locator('.release-problem', { hasText: 'the button is down' }).waitFor();
    await Stands(page, 'in_force');
    application.answers = {};
    await Releases(page);
  });
});

test('what was said long ago and comes only now is no sign of life, and confirms nothing', async (t) => {
  const drives = { target: '/mock/world/twist', forward: 0.4, turn: 1 };
  const { application, page } = await OpenMockPanel(t, { widgets: [{ id: 'keys', kind: 'keys', x: 0, y: 0, w: 3, h: 4, ...drives },
    { id: 'speed', kind: 'gauge', x: 3, y: 0, w: 3, h: 4, target: '/mock/world/twist', field: 'forward', minimum: -1, maximum: 1 }] });
  await page.keyboard.down('w');
  await page.locator('[data-driving="mine"]').waitFor();
  application.saidAt = performance.now() / 1000;
  await page.locator('#connection-state', { hasText: 'silent' }).waitFor();
  await page.locator('#lost', { hasText: 'no sign of life' }).waitFor();
  await page.locator('[data-widget="speed"] .gauge.old').waitFor();
  await page.locator('[data-driving="unknown"]', { hasText: 'not known who drives' }).waitFor();
  await page.locator('.widget-problem', { hasText: 'this hold has ended' }).waitFor();
  await Stands(page, 'unknown');
  await page.locator('#stop-button').click();
  await page.locator('#stop-banner[data-stop="unconfirmed"]').waitFor();
  application.stop = { in_force: true, by: 'somebody, before', since: 1 }; // told at once, as of then
  await page.waitForTimeout(1500);
  await Stands(page, 'unconfirmed');
  await page.locator('[data-driving="unconfirmed"]', { hasText: 'not confirmed' }).waitFor();
  application.stop = { in_force: false, by: '', since: 0 };
  application.saidAt = null;
  await Stands(page, 'in_force');
  await page.locator('[data-driving="stopped"]', { hasText: /^STOP$/ }).waitFor();
  application.saidAt = performance.now() / 1000;
  await Stands(page, 'unknown');
  await page.locator('[data-driving="unconfirmed"]', { hasText: 'not confirmed' }).waitFor();
  await page.keyboard.up('w');
});

test('pressed without a connection it is sent as soon as there is one', async (t) => {
  const { application, server, page } = await OpenMockPanel(t, { widgets: [kText], lost: true });
  await server.away(async () => {
    await Stands(page, 'unknown');
    await page.locator('#stop-button').click();
    await page.locator('#stop-banner[data-stop="unconfirmed"]').waitFor();
  });
  await Stands(page, 'in_force');
  assert.equal(application.stop.in_force, true);
});

test('a main connection that is stuck delays it not', async (t) => {
  const { application, page } = await OpenMock(t);
  application.isHanging = true;
  await Presses(application, page);
  application.isHanging = false;
});

test('while neither connection is heard it is sent over both at once', async (t) => {
  const { application, page } = await OpenMockPanel(t, { widgets: [kText] });
  application.isOwnSilent = true;
  application.isHanging = true;
  await Stands(page, 'unknown');
  const said = await Listens(page);
  await page.locator('#stop-button').click();
  while (Stops(application).length === 0) await page.waitForTimeout(20);
  assert.ok(!(await said()).includes('unconfirmed'), 'the other connection has not been waited for');
  application.isOwnSilent = false;
  application.isHanging = false;
  await Stands(page, 'in_force');
  for (let left = 100; IsByOwn(application).size < 2 && left > 0; --left) await page.waitForTimeout(50);
  assert.deepEqual(IsByOwn(application), new Set([true, false]), 'over both');
});

test('while the own connection is not heard the other one alone confirms it', async (t) => {
  const { application, page } = await OpenMockPanel(t, { widgets: [kText] });
  application.isOwnSilent = true;
  application.isOwnDeaf = true;
  await page.waitForTimeout(2500); // until it is not heard any more
  await Stands(page, 'free');
  const said = await Listens(page);
  await page.locator('#stop-button').click();
  await Stands(page, 'in_force');
  assert.ok(!(await said()).includes('unconfirmed'), 'at once');
  assert.deepEqual(IsByOwn(application), new Set([false]));
});

test('a driving port that no STOP reaches is named in the place of what is said of a STOP in force', async (t) => {
  const path = '/mock/world/twist';
  const { application, page } = await OpenMockPanel(t, { widgets: [kText] });
  await Presses(application, page);
  application.unreached = [{ path, why: 'its cycle hangs' }]; // since then: no revision of the structure tells it
  await page.locator('#stop-banner[data-stop="unreached"]', { hasText: `does not reach ${path}: its cycle hangs. The robot may move` }).waitFor();
  assert.match(await page.locator('#stop-spoken').textContent(), /does not reach/);
  assert.equal(application.stop.in_force, true);
  await page.locator('#stop-release').click();
  await Stands(page, 'free');
});

test('what it holds and reaches is said to be old, or not known, while the robot does not tell it', async (t) => {
  const { application, page } = await OpenMockPanel(t, { widgets: [kText] });
  const says = (hasText) => page.locator('#stop-banner[data-stop="in_force"]', { hasText }).waitFor();
  await Presses(application, page);
  await says('whatever moves has its safe value');
  application.unreached = null;
  await says('whether it is still so is not known');
  await Releases(page);
  await page.locator('#stop-button').click();
  await says('whether it reaches all of that, is not known');
  application.unreached = [];
  application.isBraking = true;
  await says('the robot is braking: whatever moves comes to its safe value');
  application.isBraking = false;
  await says('in force: whatever moves has its safe value');
});

test('the details of a port say that no STOP reaches it, in force or not', async (t) => {
  const path = '/mock/world/twist';
  const { application, inspector, page } = await OpenMock(t);
  await inspector.select(path);
  await page.locator('#details', { hasText: 'something moves by it' }).waitFor();
  assert.equal(await page.locator('#details', { hasText: 'CANNOT BE REACHED' }).count(), 0);
  application.unreached = [{ path, why: 'its cycle hangs' }];
  await page.locator('#details', { hasText: 'no STOP counts there: its cycle hangs' }).waitFor();
});

test('nothing is said of the STOP before the robot has said anything, although there is a connection', async (t) => {
  const { application, page } = await OpenMockPanel(t, { widgets: [kText], prepare: (mock) => { mock.isUnheard = true; } });
  await Stands(page, 'unknown');
  assert.match(await page.locator('#stop-spoken').textContent(), /not known/);
  const said = await Listens(page);
  application.isUnheard = false;
  await Stands(page, 'free');
  assert.deepEqual([...new Set(await said())], ['free']);
});

test('a release says which sign of life it answers, and one from before another press is refused, and shown', async (t) => {
  const { application, page } = await OpenMockPanel(t, { widgets: [kText] });
  await Presses(application, page);
  application.isOwnDeaf = true; // a slow way there
  await page.locator('#stop-release').click();
  await page.waitForTimeout(3500);
  application.pressedAt = performance.now() / 1000; // by a colleague, while it is in force
  application.isOwnDeaf = false;
  await page.locator('.release-problem', { hasText: 'after this was asked for' }).waitFor();
  await page.waitForTimeout(1500); // a sign of life from after that press
  await Stands(page, 'in_force');
  await Releases(page);
  const [late, good] = application.asked.filter(({ op }) => op === 'release');
  assert.ok(good.at - late.at > 2.5, `${late.at} and ${good.at}`);
});

test('of an application in which nothing is marked it is said that it stops nothing', async (t) => {
  const { page } = await OpenMockPanel(t, { widgets: [kText], prepare: (application) => {
    const path = '/mock/world/twist';
    application.elements.set(path, { ...application.elements.get(path), driving: false });
  } });
  await page.locator('#stop-button').click();
  await page.locator('#stop-banner[data-stop="nothing"]', { hasText: 'stops nothing' }).waitFor();
});

test('where only the network drives, the banner names what the STOP holds', async (t) => {
  const { page } = await OpenMockPanel(t, { widgets: [kText], prepare: (application) => {
    const path = '/mock/world/twist';
    application.elements.set(path, { ...application.elements.get(path), driving: false });
    application.drivesBeside = ['/cmd_vel (in the network)'];
  } });
  await page.locator('#stop-button').click();
  await page.locator('#stop-banner[data-stop="in_force"]', { hasText: 'It holds /cmd_vel (in the network).' }).waitFor();
});

test('while it is in force nothing is driven, and a hold that is under way has ended', async (t) => {
  const drives = { target: '/mock/world/twist', forward: 0.4, turn: 1 };
  const { application, page } = await OpenMockPanel(t, { widgets: [{ id: 'keys', kind: 'keys', x: 0, y: 0, w: 3, h: 4, ...drives }] });
  await page.keyboard.down('w');
  await page.locator('[data-driving="mine"]').waitFor();
  application.stop = { in_force: true, by: 'a terminal', since: 1 };
  await page.locator('[data-driving="stopped"]').waitFor();
  assert.equal(application.asked.findLast(({ op }) => op === 'publish').deadline, undefined, 'let go');
  await page.keyboard.up('w');
  const before = application.asked.length;
  await page.keyboard.down('w');
  await page.keyboard.up('w');
  assert.equal(application.asked.slice(before).filter(({ op }) => op === 'publish').length, 0);
});
