// The panel is laid out by mouse, and kept beside the application.

import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { OpenPanel } from '../support/panel.mjs';
import { DemoFile, RunApplication } from '../support/runnel.mjs';

async function Drag(panel, locator, dx, dy) {
  await panel.drawn();
  const { x, y, width, height } = await locator.boundingBox();
  await panel.page.mouse.move(x + width / 2, y + height / 2);
  await panel.page.mouse.down();
  await panel.page.mouse.move(x + width / 2 + dx, y + height / 2 + dy, { steps: 5 });
  await panel.page.mouse.up();
}

test('widgets are added, moved, resized and set by mouse, saved beside the application, and there again', async (t) => {
  const { file, folder } = await DemoFile(t);
  const { url } = await RunApplication(t, file, { options: ['--speed', '1'] });
  const saved = async () => JSON.parse(await readFile(join(folder, 'bug_demo.panel.json'), 'utf8')).widgets;
  const panel = await OpenPanel(t, url);
  const { page } = panel;
  await page.locator('#edit').click();
  await page.locator('#panel-state', { hasText: 'not saved' }).waitFor();
  await page.locator('[data-add="slider"]').click();
  const added = panel.widget('slider_2');
  await added.waitFor();
  await page.getByLabel('Title').fill('Lookout');
  await page.getByLabel('Title').press('Enter');
  await page.getByLabel('Sets').selectOption({ label: 'robot/planner/cruise_speed' });
  await page.getByLabel('To', { exact: true }).fill('0.5');
  await page.getByLabel('To', { exact: true }).press('Tab');
  await added.getByText('Lookout').waitFor();
  await page.locator('#save-panel').click();
  await page.locator('#panel-state', { hasText: /^saved$/ }).waitFor();
  const before = (await saved()).find(({ id }) => id === 'slider_2');
  assert.match(before.target, /cruise_speed$/);
  assert.equal(before.maximum, 0.5);

  const cell = (await page.locator('.grid').boundingBox()).width / 12;
  await Drag(panel, panel.widget('speed').locator('.card-corner'), 0, 200);
  await Drag(panel, added.locator('.card-bar'), -2 * cell, 0);
  await page.locator('#panel-state', { hasText: 'changed' }).waitFor();
  await page.locator('[data-widget="turning"] .remove').click();
  await page.locator('#save-panel').click();
  await page.locator('#panel-state', { hasText: /^saved$/ }).waitFor();
  const after = await saved();
  assert.ok(after.find(({ id }) => id === 'speed').h > 4);
  assert.equal(after.find(({ id }) => id === 'slider_2').x, Math.max(0, before.x - 2));
  assert.equal(after.find(({ id }) => id === 'turning'), undefined);
  await panel.picture('panel_arranging');

  await page.reload();
  await panel.widget('slider_2').waitFor();
  assert.equal(await panel.widget('turning').count(), 0);
  // The slider sets the parameter.
  await panel.widget('slider_2').getByRole('slider').fill('0.25');
  await panel.widget('slider').locator('output', { hasText: '0.250' }).waitFor();
});

test('a file that is no panel is told with its place, and is not overwritten by itself', async (t) => {
  const { file, folder } = await DemoFile(t);
  const place = join(folder, 'bug_demo.panel.json');
  await writeFile(place, '{"panel": 1, "widgets": [{"id": "a", "kind": "joistick", "x": 0, "y": 0, "w": 2, "h": 2}]}');
  const { url } = await RunApplication(t, file, { options: ['--speed', '1'] });
  const panel = await OpenPanel(t, url);
  await panel.page.getByText('did you mean \'joystick\'').waitFor();
  assert.match(await readFile(place, 'utf8'), /joistick/);
});

test('every kind of widget can be added and saved; of the inspector a link leads here', async (t) => {
  const { file, folder } = await DemoFile(t);
  const { url } = await RunApplication(t, file, { options: ['--speed', '1'] });
  const panel = await OpenPanel(t, url);
  await panel.page.locator('#edit').click();
  const kinds = await panel.page.locator('[data-add]').evaluateAll((all) => all.map(({ dataset }) => dataset.add));
  for (const kind of kinds) await panel.page.locator(`[data-add="${kind}"]`).click();
  await panel.page.locator('#save-panel').click();
  await panel.page.locator('#panel-state', { hasText: /^saved$/ }).waitFor();
  const widgets = JSON.parse(await readFile(join(folder, 'bug_demo.panel.json'), 'utf8')).widgets;
  for (const kind of kinds) assert.ok(widgets.some((each) => each.kind === kind), kind);
  await panel.page.goto(url);
  await panel.page.locator('#panel-link').click();
  await panel.widget('joystick').waitFor();
});

test('keys drive while they are held', async (t) => {
  const { file } = await DemoFile(t);
  const { url } = await RunApplication(t, file, { options: ['--speed', '1'] });
  const panel = await OpenPanel(t, url);
  await panel.page.locator('#edit').click();
  await panel.page.locator('[data-add="keys"]').click();
  await panel.page.locator('#edit').click();
  await panel.turns(-1.1, -0.9, { begin: () => panel.page.keyboard.down('d'), end: () => panel.page.keyboard.up('d') });
  await panel.page.keyboard.up('d');
  await panel.rests();
});
