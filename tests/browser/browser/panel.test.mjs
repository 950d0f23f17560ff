// Driving by hand: what the robot does, as another page sees it, whatever becomes of the page that drives.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { Network, OpenPanel } from '../support/panel.mjs';
import { DemoFile, Replaced, RunApplication } from '../support/runnel.mjs';

async function Demo(t) {
  const { file } = await DemoFile(t, (text) => Replaced(text, '</application>', '  <driving port="robot/drive/twist"/>\n</application>'));
  return RunApplication(t, file, { options: ['--speed', '1'] });
}

function Pushing(panel, x, y) {
  return { begin: () => panel.push(x, y), end: () => panel.letGo() };
}

/** A page that drives, turning on the spot, and another one that looks on. */
async function Driven(t, through = (url) => url) {
  const application = await Demo(t);
  const observer = await OpenPanel(t, application.url);
  const driver = await OpenPanel(t, await through(application.url));
  await observer.turns(0.9, 1.1, Pushing(driver, -1, 0));
  return { application, observer, driver };
}

/** What has become of the driver is said, the robot stands, and the planner does not begin to drive by itself. */
async function IsLost(observer) {
  await observer.page.locator('#hand-banner.lost').waitFor();
  await observer.rests();
  await observer.drives('lost');
}

test('the joystick drives while it is held, and the robot rests when it is let go', async (t) => {
  const { observer, driver } = await Driven(t);
  await observer.shows('speed', -0.05, 0.05); // on the spot
  await driver.letGo();
  await observer.rests();
  await observer.turns(-1.1, -0.9, Pushing(driver, 1, 0));
  await driver.picture('panel_driving');
  await driver.letGo();
  await observer.rests();
  await observer.widget('joystick').getByRole('button', { name: 'Give back' }).click();
  await driver.drives('free');
  await observer.shows('speed', 0.1, 0.5);
});

test('a page that dies leaves a robot that rests', async (t) => {
  const { observer, driver } = await Driven(t);
  await driver.page.goto('chrome://crash').catch(() => {}); // at once, without a word
  await IsLost(observer);
  await observer.page.locator('#release').click();
  await observer.drives('free');
  await observer.shows('speed', 0.1, 0.5);
});

test('a page that sleeps leaves a robot that rests, and does not drive on when it wakes', async (t) => {
  const { observer, driver } = await Driven(t);
  const debug = await driver.page.context().newCDPSession(driver.page);
  await debug.send('Debugger.enable');
  await debug.send('Debugger.pause'); // its event loop stands still
  await IsLost(observer);
  await debug.send('Debugger.resume');
  await driver.page.getByText('this hold has ended').waitFor();
  await driver.drives('lost');
  await observer.rests();
  await driver.letGo();
  await observer.turns(-1.1, -0.9, Pushing(driver, 1, 0));
  await driver.letGo();
  await observer.rests();
});

test('a network that is stuck leaves a robot that rests, and old commands are not driven later', async (t) => {
  let network = null;
  const { observer, driver } = await Driven(t, async (url) => {
    network = await Network(t, url);
    return network.url;
  });
  network.stick();
  await IsLost(observer);
  network.loosen();
  await driver.page.getByText('this hold has ended').waitFor();
  await observer.rests();
  await observer.drives('lost');
});

test('STOP holds the robot until it is released, whoever drives', async (t) => {
  const { observer, driver } = await Driven(t);
  await observer.page.locator('#stop-button').click();
  await observer.page.locator('#stop-banner[data-stop="in_force"]').waitFor();
  await observer.rests();
  await driver.drives('stopped');
  await driver.letGo();
  await driver.push(0, 1);
  await driver.letGo();
  await driver.drives('stopped');
  await observer.rests();
  await observer.picture('panel_stopped');
  await driver.page.locator('#stop-release').click();
  await driver.drives('set', 'lost'); // let go, or lost by a page without a turn; given back by nobody
  await observer.rests();
  await driver.widget('joystick').getByRole('button', { name: 'Give back' }).click();
  await observer.shows('speed', 0.1, 0.5);
});

test('on a phone the joystick and STOP are under the thumb', async (t) => {
  const application = await Demo(t);
  const panel = await OpenPanel(t, application.url, { width: 390, height: 844, touch: true, colours: 'dark' });
  const stick = await panel.page.locator('[data-stick]').boundingBox();
  const stop = await panel.page.locator('#stop-button').boundingBox();
  for (const box of [stick, stop]) {
    assert.ok(box.y > 844 / 2 && box.y + box.height <= 844, JSON.stringify(box));
    assert.ok(box.x >= 0 && box.x + box.width <= 390, JSON.stringify(box));
    assert.ok(box.width >= 90, JSON.stringify(box));
  }
  assert.equal(await panel.page.evaluate(() => document.documentElement.scrollWidth), 390);
  await panel.turns(0.9, 1.1, Pushing(panel, -1, 0));
  await panel.picture('panel_phone');
  await panel.page.locator('#stop-button').dispatchEvent('pointerdown', { button: 0 });
  await panel.page.locator('#stop-banner[data-stop="in_force"]').waitFor();
  await panel.rests();
});
