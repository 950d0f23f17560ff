// The table of all ports: of a real application, and of one that is large.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MockApplication } from '../mock/mock_application.mjs';
import { ServeMock } from '../mock/mock_server.mjs';
import { LargeStructure, kCatalogue } from '../mock/mock_structures.mjs';
import { OpenPage } from '../support/browser.mjs';
import { Cleanup } from '../support/cleanup.mjs';
import { DemoFile, RunApplication } from '../support/runnel.mjs';

const kGoal = '/bug_demo/world/sensor_output/goal';

async function Demo(t, options) {
  const { file } = await DemoFile(t);
  const application = await RunApplication(t, file, { options: ['--speed', '1'] });
  const inspector = await OpenPage(t, application.url, options);
  await inspector.page.locator('#tab-ports').click();
  await inspector.page.locator('[data-port-line]').first().waitFor();
  return inspector;
}

const Line = (page, path) => page.locator(`[data-port-line="${path}"]`);
const Names = (page) => page.locator('[data-port-line] .name').allTextContents();

test('ports are found, sorted, selected and frozen', async (t) => {
  const inspector = await Demo(t, { width: 1400, height: 860 });
  const { page } = inspector;
  await inspector.picture('ports_light');
  await page.locator('#port-filter').fill('world pose2');
  await inspector.until('one port', () => document.querySelectorAll('[data-port-line]').length === 1);
  const line = page.locator('[data-port-line]');
  await line.locator('.value', { hasText: 'heading' }).waitFor();
  await line.locator('.rate', { hasText: '20 Hz' }).waitFor();
  await line.locator('.bandwidth', { hasText: '480 B/s' }).waitFor();
  await line.locator('.age', { hasText: /\d s/ }).waitFor();

  await page.locator('#port-freeze').click();
  await page.locator('#port-freeze', { hasText: 'Frozen at' }).waitFor();
  const stood = await line.locator('.value').textContent();
  const time = await inspector.time();
  await inspector.until('a second of the application', (from) =>
    Number.parseFloat(document.querySelector('#time').textContent) > from + 1, time);
  assert.equal(await line.locator('.value').textContent(), stood, 'a frozen table stands still');
  await page.locator('#port-freeze').click();
  await inspector.until('another value', (text) =>
    document.querySelector('[data-port-line] .value').textContent !== text, stood);

  await line.click();
  await inspector.shows('/bug_demo/world/sensor_output/pose');
  await inspector.port('/bug_demo/world/sensor_output/pose').waitFor();

  await page.locator('#port-filter').fill('');
  await page.locator('.chip', { hasText: 'outputs' }).click();
  await page.locator('[data-column="bandwidth"]').click();
  await inspector.until('the scan first, or after what the planner draws', () => {
    const lines = [...document.querySelectorAll('[data-port-line]')].sort((a, b) => a.offsetTop - b.offsetTop);
    return lines.slice(0, 2).some((line) => /laser.*scan/.test(line.querySelector('.name').textContent));
  });
  await page.locator('[data-column="name"]').click();
  const names = await Names(page);
  assert.deepEqual(names, [...names].sort((a, b) => a.localeCompare(b, 'en', { numeric: true })));
});

test('a value is set by hand in its row, and released; what was not confirmed is not set', async (t) => {
  const inspector = await Demo(t);
  const { page } = inspector;
  await page.locator('#port-filter').fill('world goal');
  const line = Line(page, kGoal);
  await line.locator('.value', { hasText: 'x' }).waitFor();
  const edit = async (text) => {
    await line.hover();
    await line.locator('.edit').click();
    assert.match(await line.locator('input').inputValue(), /^\{x: .*, y: .*\}$/);
    await line.locator('input').fill(text);
  };
  await edit('{x: 1, y: 1.5}');
  await page.keyboard.press('Escape');
  await line.locator('input').waitFor({ state: 'detached' });
  await edit('{x: nowhere}');
  await page.keyboard.press('Enter');
  await page.locator('#port-table .problem').waitFor();
  await line.locator('input').fill('{x: 1, y: 1.5}');
  await page.keyboard.press('Enter');
  await line.locator('.release').waitFor();
  await line.locator('.value', { hasText: 'x 1, y 1.500' }).waitFor();
  assert.equal(await page.locator('#port-table .problem').count(), 0);
  await page.locator('.chip', { hasText: 'set by hand' }).click();
  await inspector.until('what is set by hand alone', () => document.querySelectorAll('[data-port-line]').length === 1);
  await line.locator('.release').click();
  await page.locator('#port-table .none', { hasText: 'No port suits' }).waitFor();
});

test('of thousands of ports only those that can be seen are drawn and asked for', async (t) => {
  const application = new MockApplication({ name: 'large', catalogue: kCatalogue, structure: LargeStructure(40, 25) });
  const server = await ServeMock(application, { page: process.env.RUNNEL_PAGE });
  Cleanup(t, () => server.close());
  const inspector = await OpenPage(t, server.url);
  const { page } = inspector;
  await page.locator('#tab-ports').click();
  await page.locator('.port-table .count', { hasText: '3080 ports' }).waitFor();
  const body = page.locator('.port-table .body');
  for (let at = 0; at < 8; ++at) {
    await body.evaluate((element, share) => { element.scrollTop = share * element.scrollHeight; }, at / 8);
    await inspector.drawn();
    const count = await page.locator('[data-port-line]').count();
    assert.ok(count > 0 && count < 60, `${count} rows`);
  }
  const lines = await page.locator('[data-port-line]').count();
  while (server.watched().length > lines) await inspector.drawn(); // what was seen before is given up
  await page.locator('[data-column="rate"]').click();
  await page.locator('#port-filter').fill('group_7/filter_12 smooth');
  await Line(page, '/large/group_7/filter_12/smooth').click();
  await inspector.shows('/large/group_7/filter_12/smooth');
});
