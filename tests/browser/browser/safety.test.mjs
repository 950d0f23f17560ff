// Nothing that moves a robot loses its source by one key press, and what is wrong cannot be overlooked.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenMock } from '../support/open_mock.mjs';
import { OpenPage } from '../support/browser.mjs';
import { DemoFile, Replaced, RunApplication } from '../support/runnel.mjs';

test('deleting what feeds a required input asks first, and says what will be without a source', async (t) => {
  const { inspector, page } = await OpenMock(t);
  await inspector.select('/mock/robot');
  await page.locator('#graph').focus();
  await page.keyboard.press('Delete');
  const dialog = page.locator('dialog.confirm');
  await dialog.locator('.lost-inputs li', { hasText: 'world/twist' }).filter({ hasText: 'required' }).waitFor();
  assert.equal(await page.evaluate(() => document.activeElement.id), 'confirm-no', 'Enter would not delete');
  await page.keyboard.press('Enter');
  await inspector.closed();
  assert.equal(await inspector.node('/mock/robot').count(), 1);
  await page.locator('#graph').focus();
  await page.keyboard.press('Delete');
  await page.locator('#confirm-yes').click();
  await inspector.node('/mock/robot').waitFor({ state: 'detached' });

  await t.test('what is missing then stands in the header, the graph, the lists and the details', async () => {
    await page.locator('#alarms', { hasText: '1 alarm' }).waitFor();
    await inspector.node('/mock/world').locator('.fault').waitFor();
    await page.locator('[data-port="/mock/world/twist"].alarmed').waitFor();
    await page.locator('#alarms').click();
    await inspector.shows('/mock/world/twist');
    await page.locator('#alarm-list', { hasText: 'twist is required and has no source' }).waitFor();
    await inspector.select('/mock/world');
    await page.locator('[data-port-row="/mock/world/twist"] .badge', { hasText: 'without a source' }).waitFor();
  });

  await t.test('undo brings it back, and says what and whose', async () => {
    await page.locator('#undo').click();
    const toast = page.locator('.toast.done', { hasText: 'undone: delete /mock/robot' });
    await toast.filter({ hasText: 'your change' }).waitFor();
    await page.locator('#alarms').waitFor({ state: 'detached' });
  });
});

test('cutting and swapping ask, too, if something loses its only source, and not otherwise', async (t) => {
  const { application, inspector, page } = await OpenMock(t);
  await inspector.select('/mock/laser/pose');
  await page.locator('#details .connections .remove').click();
  await page.locator('dialog.confirm .lost-inputs', { hasText: 'laser/pose' }).waitFor();
  await page.keyboard.press('Escape');
  await inspector.closed();
  application.lost = ['twist'];
  await inspector.select('/mock/robot/planner');
  await page.locator('#swap').click();
  await page.locator('[data-choice="mock/other_planner"]').click();
  await page.locator('dialog.confirm .lost-inputs', { hasText: 'world/twist' }).waitFor();
  await page.locator('#confirm-no').click();
  await inspector.closed();
  assert.equal(application.elements.get('/mock/robot/planner').type, 'mock/planner');
  application.lost = [];
  await page.locator('#swap').click();
  await page.locator('[data-choice="mock/other_planner"]').click();
  await inspector.details.locator('.kind', { hasText: 'mock/other_planner' }).waitFor();
});

test('a wire that is dropped on a port that does not suit connects nothing, and says why', async (t) => {
  const { inspector, page } = await OpenMock(t);
  const before = await inspector.edges();
  const { drop } = await inspector.dragPort('/mock/laser/scan', '/mock/robot/goal');
  await page.locator('[data-port="/mock/robot/goal"].blocked').waitFor();
  await drop();
  await page.locator('.toast.refused', { hasText: 'laser/scan gives RangeScan, robot/goal takes Point2' }).waitFor();
  assert.deepEqual(await inspector.edges(), before);
});

test('an output that has fallen silent is an alarm until it publishes again', async (t) => {
  const { application, inspector, page } = await OpenMock(t);
  application.speed = 20; // seconds of the application pass at once
  await inspector.until('rates', () => [...document.querySelectorAll('.rate')].some((rate) => /Hz/.test(rate.textContent)));
  await inspector.until('steadily', (time) => parseFloat(document.querySelector('#time').textContent) > time || /:/.test(document.querySelector('#time').textContent), 8);
  application.silent = new Set(['/mock/world/pose']);
  await page.locator('#alarms', { hasText: '1 alarm' }).waitFor();
  await inspector.port('/mock/world/pose').locator('.rate', { hasText: 'silent' }).waitFor();
  application.silent = new Set();
  await page.locator('#alarms').waitFor({ state: 'detached' });
});

test('undo says that a change was of another viewer, or of the terminal', async (t) => {
  const { application, server, inspector, page } = await OpenMock(t);
  const other = await OpenPage(t, server.url);
  await other.select('/mock/robot/planner');
  await other.parameter('speed').fill('2');
  await other.parameter('speed').press('Enter');
  await page.locator('#undo:not([disabled])').click();
  await page.locator('.toast.done', { hasText: 'undone: set /mock/robot/planner/speed 2' }).filter({ hasText: 'another viewer' }).waitFor();
  application.change([{ change: 'set', path: '/mock/robot/planner/speed', value: '3' }]);
  await inspector.until('it', () => /a change of a terminal/.test(document.querySelector('#undo').title));
  await page.locator('#undo').click();
  await page.locator('.toast.done', { hasText: 'a change of a terminal' }).waitFor();
  assert.equal(await page.locator('.toast.done').count(), 1, 'what was said before is gone');
});

test('saving over another application has to be meant', async (t) => {
  const { page } = await OpenMock(t);
  await page.locator('#save-as').click();
  await page.locator('#save-file').fill('other.xml');
  await page.locator('#save-now').click();
  await page.locator('dialog .problem', { hasText: 'another application' }).waitFor();
  await page.locator('#save-overwrite').click();
  await page.locator('dialog').waitFor({ state: 'detached' });
  await page.locator('.toast.done', { hasText: 'Saved' }).waitFor();
});

test('at a real application: the words of a change, of its log entry and of its undo are the same', async (t) => {
  const { file } = await DemoFile(t, (text) => Replaced(text, 'speed="10"', 'speed="0.2"'));
  const application = await RunApplication(t, file);
  const inspector = await OpenPage(t, application.url);
  const { page } = inspector;
  await inspector.select('/bug_demo/robot/planner');
  await page.locator('#delete').click();
  await page.locator('.lost-inputs li', { hasText: 'gate/wanted' }).waitFor();
  await page.locator('#confirm-yes').click();
  await page.locator('#alarms').waitFor();
  await page.locator('#tab-log').click();
  await page.locator('#log li', { hasText: /^.*change *delete \/bug_demo\/robot\/planner$/ }).waitFor();
  await page.locator('#undo:not([disabled])').click();
  await page.locator('.toast.done', { hasText: 'undone: delete /bug_demo/robot/planner' }).filter({ hasText: 'your change' }).waitFor();
  await page.locator('#log li', { hasText: 'undone: delete /bug_demo/robot/planner' }).waitFor();
});
