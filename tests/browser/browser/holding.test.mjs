// A hold ends with its cause, and begins only by an act in a page that somebody looks at.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { ModuleElements } from '../mock/mock_application.mjs';
import { kCatalogue } from '../mock/mock_structures.mjs';
import { OpenMockPanel } from '../support/open_mock.mjs';
import { OpenPanel } from '../support/panel.mjs';
import { DemoFile, RunApplication } from '../support/runnel.mjs';

const kTarget = '/mock/world/twist';
const kDrives = { target: kTarget, forward: 0.4, turn: 1 };
const kWidgets = [
  { id: 'joystick', kind: 'joystick', x: 0, y: 0, w: 4, h: 6, ...kDrives }, { id: 'keys', kind: 'keys', x: 4, y: 0, w: 3, h: 4, ...kDrives },
  { id: 'gamepad', kind: 'gamepad', x: 7, y: 0, w: 3, h: 4, ...kDrives },
  { id: 'button', kind: 'button', x: 10, y: 0, w: 2, h: 4, target: kTarget, pressed: '{forward: 0.4}', held: true },
];

/** A panel at an application that takes all. `holds(widget)` waits until it holds the port, `ends()` until nobody does. */
async function Open(t, options) {
  const opened = await OpenMockPanel(t, { widgets: kWidgets, shows: '[data-widget="gamepad"]', ...options });
  const { application, page, panel } = opened;
  const chip = (id) => page.locator(`[data-widget="${id}"] [data-driving="mine"], [data-widget="${id}"] .push-button.down`);
  return { ...opened,
    holds: (id) => chip(id).waitFor(),
    /** Let go, and the application has been told: the last value has no deadline. */
    ends: async (id) => {
      await chip(id).waitFor({ state: 'detached' });
      await panel.drawn();
      const deadline = () => application.asked.findLast(({ op }) => op === 'publish').deadline;
      for (let tries = 0; deadline() !== undefined && tries < 100; ++tries) await page.waitForTimeout(50); // what is sent takes its time
      assert.equal(deadline(), undefined, 'the last value is a rest');
    },
    isFree: async (id) => { await panel.drawn(); assert.equal(await chip(id).count(), 0); } };
}

const Dispatch = (page, type, init) => page.evaluate(([name, how]) => document.body.dispatchEvent(
  new KeyboardEvent(name, { bubbles: true, cancelable: true, ...how })), [type, init]);

test('keys: up is up, whatever else is down, and a modifier lets go', async (t) => {
  const { page, holds, ends, isFree } = await Open(t);
  await page.keyboard.down('w');
  await holds('keys');
  await page.keyboard.down('Control');
  await ends('keys');
  await page.keyboard.up('w');
  await page.keyboard.up('Control');
  await isFree('keys');
  // As where the coming down of the modifier went to another window.
  await page.keyboard.down('w');
  await holds('keys');
  await Dispatch(page, 'keyup', { code: 'KeyW', key: 'w', ctrlKey: true });
  await ends('keys');
  await page.keyboard.up('w');
  await page.keyboard.down('Alt');
  await page.keyboard.down('w');
  await isFree('keys');
  await page.keyboard.up('w');
  await page.keyboard.up('Alt');
});

test('a page that loses the focus, or is hidden, lets go, and takes no hold until it has the focus again', async (t) => {
  const { page, holds, ends, isFree } = await Open(t);
  for (const leave of [() => window.dispatchEvent(new Event('blur')), () => {
    Object.defineProperty(document, 'hidden', { value: true, configurable: true });
    document.dispatchEvent(new Event('visibilitychange'));
    delete document.hidden;
  }]) {
    await page.keyboard.down('w');
    await holds('keys');
    await page.evaluate(leave);
    await ends('keys');
    await page.keyboard.up('w');
  }
  await page.evaluate(() => { document.hasFocus = () => false; });
  await Dispatch(page, 'keydown', { code: 'KeyW', key: 'w' });
  await isFree('keys');
  await page.evaluate(() => { delete document.hasFocus; });
  await Dispatch(page, 'keyup', { code: 'KeyW', key: 'w' });
  await page.keyboard.down('w');
  await holds('keys');
  await page.keyboard.up('w');
  await ends('keys');
});

test('the stick: a cancelled pointer and a second finger let go', async (t) => {
  const { page, panel, holds, ends, isFree } = await Open(t, { touch: true });
  const debug = await page.context().newCDPSession(page);
  await panel.drawn();
  const { x, y, width, height } = await page.locator('[data-stick]').boundingBox();
  const finger = (id, dx, dy) => ({ id, x: x + width / 2 + dx, y: y + height / 2 + dy });
  const touch = (type, ...touchPoints) => debug.send('Input.dispatchTouchEvent', { type, touchPoints });
  await touch('touchStart', finger(0, 0, -30));
  await holds('joystick');
  await touch('touchCancel');
  await ends('joystick');
  await touch('touchStart', finger(0, 0, -30));
  await holds('joystick');
  await touch('touchStart', finger(0, 0, -30), finger(1, 20, 20));
  await ends('joystick');
  await touch('touchMove', finger(0, 0, -40), finger(1, 30, 20));
  await isFree('joystick');
  await touch('touchEnd');
  await touch('touchStart', finger(0, 0, -30));
  await holds('joystick');
  await touch('touchEnd');
  await ends('joystick');
});

test('without a pointer: arrow keys at the stick, and keys at a button that is held', async (t) => {
  const { application, page, holds, ends } = await Open(t);
  await page.locator('[data-stick]').focus();
  await page.keyboard.down('ArrowUp');
  await holds('joystick');
  assert.match(application.asked.findLast(({ op }) => op === 'publish').value, /forward: 0.4, turn: 0/);
  await page.keyboard.up('ArrowUp');
  await ends('joystick');
  await page.keyboard.down('ArrowUp');
  await holds('joystick');
  await page.locator('#edit').focus();
  await ends('joystick');
  await page.keyboard.up('ArrowUp');
  const button = page.locator('[data-widget="button"] button');
  await button.focus();
  await page.keyboard.down(' ');
  await holds('button');
  await page.keyboard.up(' ');
  await ends('button');
  await page.keyboard.down('Enter');
  await holds('button');
  await page.locator('#edit').focus();
  await ends('button');
  await page.keyboard.up('Enter');
});

test('a slider and a plain button at what moves drive only as long as they are held', async (t) => {
  const kNumber = '/mock/smooth/offset';
  const { application, page, panel } = await OpenMockPanel(t, { shows: '[data-widget="slider"]', widgets: [
    { id: 'slider', kind: 'slider', x: 0, y: 0, w: 4, h: 4, target: kNumber, minimum: 0, maximum: 1 },
    { id: 'plain', kind: 'button', x: 4, y: 0, w: 2, h: 4, target: kTarget, pressed: '{forward: 0.4}' }],
  prepare: (mock) => {
    for (const element of ModuleElements(kCatalogue, 'mock/filter', '/mock/smooth')) {
      mock.elements.set(element.path, element.path === kNumber ? { ...element, driving: true, moves: true, safe: '0' } : element);
    }
  } });
  const last = () => application.asked.findLast(({ op }) => op === 'publish');
  const until = async (what) => {
    for (let tries = 0; !what() && tries < 200; ++tries) await page.waitForTimeout(50);
    assert.ok(what(), JSON.stringify(last()));
  };
  const box = await page.getByRole('slider').boundingBox();
  await page.mouse.move(box.x + box.width * 0.1, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + box.height / 2, { steps: 3 });
  await until(() => last()?.path === kNumber && last().deadline > 0 && last().lease);
  await page.mouse.up();
  await until(() => last().deadline === undefined && last().value === '0');
  await page.getByRole('slider').focus();
  await page.keyboard.down('ArrowRight');
  await until(() => last().deadline > 0);
  await page.locator('#edit').focus();
  await until(() => last().deadline === undefined);
  await page.keyboard.up('ArrowRight');
  await panel.drawn();
  // STOP ends it for good: a key that repeats, or a pointer that goes on, takes no hold.
  const afterStop = async (goOn) => {
    await until(() => last().deadline > 0);
    await page.evaluate(() => document.querySelector('#stop-button').dispatchEvent(new PointerEvent('pointerdown', { bubbles: true, button: 0 })));
    await until(() => last().deadline === undefined);
    await page.locator('#stop-release').waitFor();
    await page.evaluate(() => document.querySelector('#stop-release').click());
    await page.locator('#stop-release').waitFor({ state: 'detached' });
    const count = () => application.asked.filter(({ op }) => op === 'publish').length;
    const before = count();
    await goOn();
    await page.waitForTimeout(300);
    assert.equal(count(), before);
  };
  await page.getByRole('slider').focus();
  await page.keyboard.down('ArrowRight');
  await afterStop(() => page.keyboard.down('ArrowRight'));
  await page.keyboard.up('ArrowRight');
  await page.mouse.move(box.x + box.width * 0.1, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width * 0.6, box.y + box.height / 2, { steps: 3 });
  await afterStop(() => page.mouse.move(box.x + box.width * 0.7, box.y + box.height / 2, { steps: 3 }));
  await page.mouse.up();
  // As a screen reader sets it.
  await page.getByRole('slider').evaluate((slider) => { slider.value = '0.9'; slider.dispatchEvent(new Event('input', { bubbles: true })); });
  await panel.drawn();
  assert.equal(last().deadline, undefined);
  await page.locator('[data-widget="plain"] button').hover();
  await page.mouse.down();
  await until(() => last().path === kTarget && last().deadline > 0);
  await page.mouse.up();
  await until(() => last().path === kTarget && last().deadline === undefined);
});

test('a switch sets nothing at what moves, and says why', async (t) => {
  const kMoves = '/mock/smooth/offset';
  const kStill = '/mock/smooth/raw';
  const { application, page, panel } = await OpenMockPanel(t, { shows: '[data-widget="moves"]', widgets: [
    { id: 'moves', kind: 'switch', x: 0, y: 0, w: 4, h: 3, target: kMoves, on: '0.4', off: '0' },
    { id: 'still', kind: 'switch', x: 4, y: 0, w: 4, h: 3, target: kStill, on: '1', off: '0' }],
  prepare: (mock) => {
    for (const element of ModuleElements(kCatalogue, 'mock/filter', '/mock/smooth')) {
      mock.elements.set(element.path, element.path === kMoves ? { ...element, driving: true, moves: true, safe: '0' } : element);
    }
  } });
  const published = (path) => application.asked.filter((each) => each.op === 'publish' && each.path === path);
  await page.locator('[data-widget="moves"] .problem', { hasText: 'only what is held drives' }).waitFor();
  const moves = page.locator('[data-widget="moves"] input');
  assert.ok(await moves.isDisabled());
  // As what does not ask whether it is disabled.
  await moves.evaluate((flip) => { flip.checked = true; flip.dispatchEvent(new Event('change', { bubbles: true })); });
  await page.locator('[data-widget="still"] input').dispatchEvent('click');
  for (let tries = 0; published(kStill).length === 0 && tries < 200; ++tries) await page.waitForTimeout(50);
  assert.equal(published(kStill).length, 1, 'what does not move is set');
  assert.equal(published(kMoves).length, 0);
  await panel.drawn();
});

test('a gamepad begins by a shoulder that has been seen released, of the standard layout, in a page that has the focus', async (t) => {
  const pad = (pressed, mapping = 'standard') => ({ connected: true, index: 0, id: 'Pad', mapping, axes: [0, -1, 0, 0],
    buttons: Array.from({ length: 17 }, (_, at) => ({ pressed: at === pressed })) });
  const { page, panel, holds, ends, isFree } = await Open(t);
  const set = (pads) => page.evaluate((all) => { window.pads = all; }, pads);
  const seen = async (text) => { await page.locator('.gamepad-name', { hasText: text }).waitFor(); await panel.drawn(); };
  await page.addInitScript((first) => {
    Object.assign(window, { pads: first, looks: 0 });
    navigator.getGamepads = () => { ++window.looks; return window.pads; };
  }, [pad(6)]);
  const looked = () => page.evaluate(() => window.looks).then((before) => page.waitForFunction((so_far) => window.looks > so_far + 2, before));
  await page.reload();
  await seen('Pad');
  await looked(); // what must not happen has no sign
  await isFree('gamepad');
  const pressAnew = async () => {
    await set([pad(-1)]);
    await looked();
    await set([pad(6)]);
  };
  /** However it ends, nothing takes hold while its cause goes on. */
  const endsBy = async (cause) => {
    await pressAnew();
    await holds('gamepad');
    await cause();
    await ends('gamepad');
    await pressAnew();
    await looked();
    await isFree('gamepad');
  };
  await pressAnew();
  await holds('gamepad');

  await t.test('unplugged', async () => {
    await set([null]);
    await ends('gamepad');
    await set([pad(6)]);
    await seen('Pad');
    await looked();
    await isFree('gamepad');
  });
  await t.test('without the focus, and pressed again', async () => {
    await endsBy(() => page.evaluate(() => { document.hasFocus = () => false; window.dispatchEvent(new Event('blur')); }));
    await page.evaluate(() => { delete document.hasFocus; });
  });
  await t.test('of another layout', async () => {
    await set([pad(-1, '')]);
    await seen('no standard layout');
    await set([pad(6, '')]);
    await looked();
    await isFree('gamepad');
  });
  await t.test('while the panel is arranged', () => endsBy(() => page.locator('#edit').click()));
});

test('answers that come later and later end the hold', async (t) => {
  const { application, page, holds, isFree } = await Open(t);
  let delay = 0;
  application.answers.publish = (reply) => { setTimeout(() => reply({ ok: true, text: '' }), delay); delay += 50; };
  await page.keyboard.down('w');
  await holds('keys');
  await page.locator('[data-widget="keys"] .widget-problem', { hasText: 'this hold has ended' }).waitFor();
  assert.ok(delay < 2500, `answers came ${delay} ms late before it ended`);
  await page.keyboard.up('w');
  await isFree('keys');
});

test('a process that hangs: all that is shown is old, and the hold has ended', async (t) => {
  const { file } = await DemoFile(t);
  const application = await RunApplication(t, file, { options: ['--speed', '1'] });
  const panel = await OpenPanel(t, application.url);
  const { page } = panel;
  await panel.turns(0.9, 1.1, { begin: () => panel.push(-1, 0), end: () => panel.letGo() });
  application.freeze();
  await panel.widget('joystick').getByText('this hold has ended').waitFor();
  await page.locator('#lost', { hasText: 'no sign of life' }).waitFor();
  await page.locator('#connection-state', { hasText: 'silent' }).waitFor();
  await page.locator('[data-widget="speed"] .gauge.old').waitFor();
  assert.equal(await page.locator('[data-driving="mine"]').count(), 0);
  application.thaw();
  await page.locator('#connection-state', { hasText: 'connected' }).waitFor();
  await panel.rests();
  await panel.drives('lost');
  await panel.letGo();
});
