// An application that ends and begins anew, and one that must only be watched.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { OpenMock } from '../support/open_mock.mjs';
import { DemoFile, Replaced, RunApplication } from '../support/runnel.mjs';

const kSlow = (text) => Replaced(text, 'speed="10"', 'speed="1"');

test('a page lives on when its application begins anew: selection, folded groups and plots stay', async (t) => {
  const { file } = await DemoFile(t, kSlow);
  const first = await RunApplication(t, file);
  const inspector = await OpenPage(t, first.url, { lost: true });
  const { page } = inspector;
  await page.locator('[data-fold="/bug_demo/robot"]').click();
  await inspector.node('/bug_demo/robot/planner').waitFor({ state: 'detached' });
  await inspector.select('/bug_demo/world/sensor_output/pose');
  await page.locator('[data-field="x"] .plot-this').click();
  await page.locator('.legend output', { hasText: /\d/ }).waitFor();

  await first.stop();
  await page.locator('#connection-state', { hasText: 'disconnected' }).waitFor();
  await page.locator('#lost').waitFor();
  assert.equal(await page.locator('#pause').isDisabled(), true);
  assert.equal(await inspector.node('/bug_demo/world').count(), 1, 'what was last seen stays');

  await RunApplication(t, file, { port: first.port });
  await page.locator('#connection-state', { hasText: /^connected/ }).waitFor();
  await page.locator('#lost').waitFor({ state: 'detached' });
  assert.equal(await inspector.node('/bug_demo/robot/planner').count(), 0, 'still folded');
  assert.equal(await page.locator('#details h2').textContent(), 'pose');
  const value = page.locator('#value [data-field="x"] td').first();
  const before = await value.textContent();
  await inspector.until('values from the new one', (text) =>
    document.querySelector('#value [data-field="x"] td').textContent !== text, before);
  assert.equal(await page.locator('.plot').count(), 1);
});

test('an application that must only be watched shows everything and offers no change', async (t) => {
  const { file } = await DemoFile(t, kSlow);
  const application = await RunApplication(t, file, { options: ['--inspect-read-only'] });
  const inspector = await OpenPage(t, application.url);
  const { page } = inspector;
  await page.locator('.state.read-only').waitFor();
  for (const id of ['pause', 'step', 'speed', 'add', 'undo', 'save']) {
    assert.equal(await page.locator(`#${id}`).isDisabled(), true, id);
  }
  await inspector.select('/bug_demo/robot/planner');
  for (const id of ['swap', 'move', 'delete']) assert.equal(await page.locator(`#${id}`).isDisabled(), true, id);
  assert.equal(await inspector.parameter('cruise_speed').isDisabled(), true);
  await inspector.until('values all the same', () =>
    /forward/.test(document.querySelector('[data-port-row$="/twist"] .value')?.textContent));
  await page.locator('#graph').focus();
  await page.keyboard.press('Delete');
  await page.keyboard.press('s');
  assert.equal(await page.locator('dialog').count(), 0);
  assert.equal(await inspector.node('/bug_demo/robot/planner').count(), 1);
});

test('a module that throws is marked, counted, and told with its reason', async (t) => {
  const { file } = await DemoFile(t, (text) => Replaced(Replaced(kSlow(text), '<parameter name="seed" value="1" command_line="seed"/>',
    '<parameter name="fails_at" value="1"/> <parameter name="fails_loudly" value="true"/>'), '<on_fault of="." action="quit"/>', ''));
  const application = await RunApplication(t, file);
  const inspector = await OpenPage(t, application.url);
  const { page } = inspector;
  await inspector.node('/bug_demo/laser').locator('.fault').waitFor();
  await page.locator('#faults', { hasText: '1 fault' }).click();
  await page.locator('#log li.fault', { hasText: '/bug_demo/laser' }).waitFor();
  await inspector.select('/bug_demo/laser');
  await page.locator('.trouble', { hasText: 'Fault:' }).waitFor();
  await page.locator('#troubles li.fault').waitFor();
});

test('a token stands behind # in the address, is taken out of it, and is asked for where it is missing', async (t) => {
  const { file } = await DemoFile(t, kSlow);
  const application = await RunApplication(t, file, { options: ['--inspect-token', 'open_sesame_42 look:only_look_42'] });
  assert.doesNotMatch(application.url, /sesame/);
  const inspector = await OpenPage(t, `${application.url}#token=open_sesame_42`);
  await inspector.node('/bug_demo/world').waitFor();
  assert.equal(inspector.page.url(), application.url);
  assert.equal(await inspector.page.locator('#save').isDisabled(), false);
  await inspector.page.reload();
  await inspector.node('/bug_demo/world').waitFor();
  const access = (token) => fetch(new URL('/access', application.url), { headers: { Authorization: `Bearer ${token}` } });
  assert.equal((await fetch(new URL('/access', application.url))).status, 401);
  assert.equal((await access('open_sesame_43')).status, 401);
  assert.equal(await (await access('only_look_42')).text(), 'look');

  await inspector.page.evaluate(() => localStorage.clear());
  inspector.forgive(/401|WebSocket/);
  await inspector.page.reload();
  await inspector.page.locator('#token-field').fill('only_look_42');
  await inspector.page.locator('#token button').click();
  await inspector.page.locator('.state.read-only').waitFor();
  assert.equal(await inspector.page.locator('#save').isDisabled(), true);

  await inspector.page.evaluate(() => localStorage.clear());
  await inspector.page.goto(new URL('/panel', application.url).href);
  await inspector.page.locator('#token-field').fill('only_look_42');
  await inspector.page.locator('#token button').click();
  await inspector.page.locator('.state.read-only').waitFor();
});

test('who drives may pause and set values by hand, and change nothing else', async (t) => {
  const { file } = await DemoFile(t, kSlow);
  const application = await RunApplication(t, file, { options: ['--inspect-token', 'drive:green_car_7'] });
  const inspector = await OpenPage(t, `${application.url}#token=green_car_7`);
  const { page } = inspector;
  await page.locator('.state.read-only', { hasText: 'drive' }).waitFor();
  for (const id of ['step', 'speed', 'add', 'undo', 'save']) {
    assert.equal(await page.locator(`#${id}`).isDisabled(), true, id);
  }
  await page.locator('#pause').click();
  await page.locator('#pause[aria-pressed="true"]').waitFor();
});

test('of a request whose answer is lost with the connection it is said that it may have been carried out', async (t) => {
  const { application, inspector, page } = await OpenMock(t, { lost: true });
  const shows = (value) => inspector.until(value, (wanted) => [...document.querySelectorAll('#details .parameter input')].some((input) => input.value === wanted), value);
  await inspector.select('/mock/robot/planner');
  await inspector.parameter('speed').fill('2');
  await inspector.parameter('speed').press('Enter');
  await page.locator('#undo:not([disabled])').waitFor();
  application.answers.undo = (reply, message, socket) => {
    application.travel(application.past, application.future);
    socket.terminate();
  };
  await page.locator('#undo').click();
  await page.locator('.toast.error', { hasText: 'the connection was lost before the answer came: it may have been carried out' }).waitFor();
  await page.locator('#connection-state', { hasText: /^connected/ }).waitFor();
  await shows('0.4');
});

test('on a real clock Pause and Go on work again and again', async (t) => {
  const { file } = await DemoFile(t, (text) => Replaced(text, '<clock type="simulated" speed="10"/>', ''));
  const application = await RunApplication(t, file);
  const { page } = await OpenPage(t, application.url, { width: 390, height: 844 });
  for (const then of ['Go on', 'Pause', 'Go on', 'Pause']) {
    await page.locator('#pause-all').click();
    await page.locator('#pause-all', { hasText: then }).waitFor();
  }
});

test('overruns of a thread are counted, and stand out', async (t) => {
  const { page } = await OpenMock(t, { prepare: (mock) => { mock.overruns['/mock/threads/control'] = 3; } });
  await page.locator('#tab-threads').click();
  await page.locator('[data-thread="control"] td.bad', { hasText: /^3$/ }).waitFor();
  assert.equal(await page.locator('td.bad').count(), 1);
});
