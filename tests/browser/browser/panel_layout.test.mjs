// The panel is laid out by mouse, and kept beside the application.

import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { OpenPanel } from '../support/panel.mjs';
import { DemoFile, Replaced, RunApplication } from '../support/runnel.mjs';

async function Drag(panel, locator, dx, dy) {
  await locator.scrollIntoViewIfNeeded();
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

test('what a camera sees is shown from the beginning, at its size, and fetched again after another choice', async (t) => {
  const { file } = await DemoFile(t, (text) => Replaced(text, '<module name="localisation"',
    '<module name="camera" type="simulation/camera"/>\n  <module name="localisation"')
    .replace('<connect from="world/scene" to="laser/scene', '<connect from="world/scene" to="camera/scene laser/scene')
    .replace('<connect from="world/pose" to="laser/pose', '<connect from="world/pose" to="camera/pose laser/pose'));
  const { url } = await RunApplication(t, file, { options: ['--speed', '1'] });
  const panel = await OpenPanel(t, url);
  const image = panel.widget('image');
  await image.locator('.note', { hasText: '160 × 120 rgb8' }).waitFor();
  const pictures = () => panel.until('other pictures', (from) => Number(document.querySelector('[data-widget="image"] canvas').dataset.count) > from + 2, 0);
  await pictures();
  const colours = await image.locator('canvas').evaluate((canvas) => {
    const { data } = canvas.getContext('2d').getImageData(0, 0, canvas.width, canvas.height);
    return new Set(Array.from({ length: data.length / 4 }, (_, at) => data.slice(4 * at, 4 * at + 3).join())).size;
  });
  assert.ok(colours > 3, `${colours} colours`);
  const [card, canvas] = [await image.boundingBox(), await image.locator('canvas').boundingBox()];
  assert.ok(canvas.x >= card.x && canvas.y + canvas.height <= card.y + card.height + 1, 'the picture is within its card');
  await panel.picture('panel_image');

  await panel.page.locator('#edit').click();
  await image.locator('.card-bar').click();
  const choice = panel.page.getByLabel('Port');
  assert.deepEqual(await choice.locator('option').allTextContents(), ['–', 'camera/image'], 'pictures only');
  await choice.selectOption({ label: '–' });
  await image.getByText('no port has been chosen').waitFor();
  await choice.selectOption({ label: 'camera/image' });
  await pictures();
});
