// How long modules take, and how old what comes of a measurement is.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { DemoFile, RunApplication } from '../support/runnel.mjs';

test('modules are measured, told in their boxes, and a chain of two that were selected', async (t) => {
  const { file } = await DemoFile(t);
  const application = await RunApplication(t, file, { options: ['--speed', '1'] });
  const inspector = await OpenPage(t, application.url, { width: 1400, height: 860 });
  const { page } = inspector;
  await page.locator('#tab-profile').click();
  assert.equal(await page.locator('.time-taken').count(), 0, 'nothing is measured that nobody wants to know');
  await page.locator('#profile').click();
  await page.locator('[data-task="/bug_demo/robot/planner"]').waitFor();
  await inspector.node('/bug_demo/robot/planner').locator('.time-taken', { hasText: /[µm]s/ }).waitFor();

  await inspector.click('/bug_demo/laser');
  await inspector.shows('/bug_demo/laser');
  await inspector.click('/bug_demo/robot/planner');
  await inspector.shows('/bug_demo/robot/planner');
  await page.locator('.chain .way', { hasText: 'laser→eyes→planner' }).waitFor();
  await page.locator('#measure-chain').click();
  const latency = page.locator('.latency', { hasText: 'scan' });
  await latency.filter({ hasText: /of [1-9]\d* measurements/ }).waitFor();
  await inspector.picture('profile');
  await latency.locator('.remove').click();
  await latency.waitFor({ state: 'detached' });
  await page.locator('#profile').click();
  await inspector.until('boxes without times', () => document.querySelectorAll('.time-taken').length === 0);
});
