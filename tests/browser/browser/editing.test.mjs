// Changing an application: create, connect, undo, move, delete, save, and run what was saved.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { DemoFile, Replaced, RunApplication } from '../support/runnel.mjs';

const kSlow = (text) => Replaced(Replaced(text, 'speed="10"', 'speed="0.2"'),
  '<thread name="control" period="50ms"/>', '<thread name="control" period="50ms"/> <thread name="slow" period="100ms"/>');

async function Demo(t, options) {
  const { file, folder } = await DemoFile(t, kSlow);
  const application = await RunApplication(t, file);
  const inspector = await OpenPage(t, application.url, { width: 1920, height: 1080, ...options });
  return { file, folder, application, inspector, page: inspector.page };
}

async function Create(inspector, type, name) {
  await inspector.page.locator('#add').click();
  await inspector.page.locator('.choice-search').fill(type);
  await inspector.page.locator(`[data-choice="${type}"]`).hover();
  await inspector.page.locator('#new-name').fill(name);
  await inspector.page.locator('#create').click();
  await inspector.closed();
  await inspector.shows(`/bug_demo/${name}`);
}

test('a module is made, connected by dragging, undone, made again, saved, and is there after a restart', async (t) => {
  const { folder, application, inspector, page } = await Demo(t, { lost: true });
  await Create(inspector, 'simulation/localisation', 'second');
  await inspector.node('/bug_demo/second').waitFor();
  const [from, to] = ['/bug_demo/world/sensor_output/pose', '/bug_demo/second/input/truth'];
  const key = `${from} → ${to}`;
  const edge = page.locator(`[data-edge="${key}"]`);

  await t.test('only ports that suit light up while one drags, and the drop connects', async () => {
    const { drop } = await inspector.dragPort(from, to);
    await page.locator(`[data-port="${to}"].target`).waitFor();
    const lit = await page.locator('.port.candidate, .port.target').evaluateAll((ports) => ports.map((port) => port.dataset.port));
    assert.ok(lit.includes('/bug_demo/robot/pose'), 'an input of the same type, although it has a source');
    assert.ok(!lit.includes('/bug_demo/laser/input/scene'), 'of another type');
    assert.ok(!lit.includes('/bug_demo/localisation/output/pose'), 'an output');
    await drop();
    await edge.waitFor({ state: 'attached' });
    assert.equal(await page.locator('.port.candidate').count(), 0);
  });

  await t.test('undo takes it back, by the keyboard, and redo makes it again', async () => {
    await page.locator('#graph').focus();
    await page.keyboard.press('Control+z');
    await edge.waitFor({ state: 'detached' });
    await page.locator('#redo:not([disabled])').waitFor();
    await page.keyboard.press('Control+Shift+Z');
    await edge.waitFor({ state: 'attached' });
  });

  await t.test('another thread runs it', async () => {
    await inspector.select('/bug_demo/second');
    await page.locator('#move').click();
    await page.locator('[data-choice="slow"]').click();
    await inspector.closed();
    await inspector.details.locator('.thread-name', { hasText: 'slow' }).waitFor();
  });

  await t.test('saved under another name, and run from there, it is the same', async () => {
    await page.locator('#save-as').click();
    await page.locator('#save-file').fill(join(folder, 'changed.xml'));
    await page.locator('#save-now').click();
    await inspector.until('an answer', () => !document.querySelector('dialog') || document.querySelector('dialog .problem'));
    assert.deepEqual(await page.locator('dialog .problem').allTextContents(), []);
    const text = await readFile(join(folder, 'changed.xml'), 'utf8');
    assert.match(text, /name="second" type="simulation\/localisation"/);
    await application.stop();
    const again = await RunApplication(t, join(folder, 'changed.xml'));
    const other = await OpenPage(t, again.url, { width: 1920, height: 1080 });
    await other.page.locator(`[data-edge="${key}"]`).waitFor({ state: 'attached' });
    await other.select('/bug_demo/second');
    await other.details.locator('.thread-name', { hasText: 'slow' }).waitFor();
  });
}, { timeout: 400000 });

test('connecting and disconnecting by the keyboard', async (t) => {
  const { inspector, page } = await Demo(t);
  await Create(inspector, 'motion/differential_drive', 'spare');
  await inspector.node('/bug_demo/spare').waitFor();
  const edge = page.locator('[data-edge="/bug_demo/robot/planner/output/twist → /bug_demo/spare/input/twist"]');
  await inspector.select('/bug_demo/spare/input/twist');
  await page.locator('#graph').focus();
  await page.keyboard.press('c');
  await page.locator('.choice-search').fill('planner twist');
  await page.keyboard.press('Enter');
  await edge.waitFor({ state: 'attached' });
  await page.locator('#details .connections .remove').click();
  await page.locator('dialog.confirm .lost-inputs', { hasText: 'spare/twist' }).waitFor();
  await page.locator('#confirm-yes').click();
  await edge.waitFor({ state: 'detached' });
});

test('a module is deleted by a key, and an undo brings it back with its connections', async (t) => {
  const { inspector, page } = await Demo(t);
  const before = await inspector.edges();
  await inspector.select('/bug_demo/referee');
  await page.locator('#graph').focus();
  await page.keyboard.press('Delete');
  await inspector.node('/bug_demo/referee').waitFor({ state: 'detached' });
  await page.locator('#undo').click();
  await inspector.node('/bug_demo/referee').waitFor();
  await inspector.until('all connections', (count) => document.querySelectorAll('path[data-edge]').length === count, before.length);
  assert.deepEqual(await inspector.edges(), before);
});

test('a key saves into the file that was loaded, which keeps its comments', async (t) => {
  const { file, inspector, page } = await Demo(t);
  await inspector.select('/bug_demo/robot/planner');
  await inspector.parameter('cruise_speed').fill('0.33');
  await inspector.parameter('cruise_speed').press('Enter');
  await page.locator('#undo:not([disabled])').waitFor();
  await page.locator('#graph').focus();
  await page.keyboard.press('Control+s');
  await page.locator('.difference .new', { hasText: '0.33' }).waitFor();
  assert.equal(await page.locator('.difference .gone').count(), 0, 'a line has come, none has gone');
  assert.doesNotMatch(await readFile(file, 'utf8'), /0\.33/, 'it is only shown what would be');
  await inspector.picture('save_difference');
  await page.locator('#save-now').click();
  await page.locator('.toast.done, .toast.error').first().waitFor();
  await inspector.closed();
  const text = await readFile(file, 'utf8');
  assert.match(text, /cruise_speed" value="0.33"/);
  assert.match(text, /Another planner is one word away/);
  await page.locator('#save').click();
  await page.locator('dialog h2', { hasText: 'Nothing to save' }).waitFor();
});

test('a group is made, given ports, filled, and connected through its border', async (t) => {
  const { inspector, page } = await Demo(t);
  await page.locator('#graph').click({ button: 'right', position: { x: 10, y: 10 } });
  await page.locator('[role="menuitem"]', { hasText: 'New group' }).click();
  await inspector.node('/bug_demo/group').waitFor();
  await inspector.select('/bug_demo/group');
  await page.locator('#add-port').click();
  await page.locator('#port-name').fill('place');
  await page.locator('#port-type').selectOption('Pose2');
  await page.locator('#create-port').click();
  await inspector.port('/bug_demo/group/place').waitFor();
  await inspector.closed();
  await page.keyboard.press('a');
  await page.locator('.choice-search').fill('simulation/localisation');
  await page.locator('#new-name').fill('inner');
  await page.locator('#create').click();
  await inspector.node('/bug_demo/group/inner').waitFor();
  await inspector.closed();
  await inspector.shows('/bug_demo/group/inner');
  for (const [from, to] of [['/bug_demo/world/sensor_output/pose', '/bug_demo/group/place'], ['/bug_demo/group/place', '/bug_demo/group/inner/input/truth']]) {
    await page.keyboard.press('Escape');
    await page.keyboard.press('f');
    await inspector.drawn();
    const { drop } = await inspector.dragPort(from, to);
    await drop();
    await page.locator(`[data-edge="${from} → ${to}"]`).waitFor({ state: 'attached' });
  }
  await inspector.select('/bug_demo/group/inner/output/pose');
  await page.locator('#value [data-field="heading"]').waitFor();
});

test('ports of different types are connected by a part of the values, and a module gets tags', async (t) => {
  const { file } = await DemoFile(t, (text) => Replaced(kSlow(text), '<load plugin="motion"/>', '<load plugin="motion"/> <load plugin="signal"/>'));
  const inspector = await OpenPage(t, (await RunApplication(t, file)).url, { width: 1920, height: 1080, lost: true });
  const { page } = inspector;
  await Create(inspector, 'signal/low_pass', 'calm');
  const { drop } = await inspector.dragPort('/bug_demo/localisation/output/pose', '/bug_demo/calm/input/in');
  await drop();
  await page.locator('.choice-search').fill('heading');
  await page.keyboard.press('Enter');
  await inspector.closed();
  const edge = '/bug_demo/localisation/output/pose → /bug_demo/calm/input/in';
  await page.locator(`[data-edge="${edge}"]`).waitFor({ state: 'attached' });
  await inspector.select('/bug_demo/calm/input/in');
  await inspector.details.getByTitle('How it passes values on').click();
  await inspector.details.locator('.facts', { hasText: 'heading' }).waitFor();
  await page.locator('#convert').click();
  await page.locator('.choice-search').fill('y');
  await page.keyboard.press('Enter');
  await inspector.closed();
  await inspector.details.locator('.facts dd', { hasText: /\.?y\b/ }).first().waitFor();
  await inspector.select('/bug_demo/calm');
  await page.locator('#tags').fill('new slow');
  await page.keyboard.press('Enter');
  await inspector.until('the tags', () => document.querySelector('#tags').value === 'new slow');
  await page.reload();
  await inspector.select('/bug_demo/calm');
  await inspector.until('the tags again', () => document.querySelector('#tags').value === 'new slow');
});

test('from which level on a module logs is chosen, and stays after a reload', async (t) => {
  const { inspector, page } = await Demo(t);
  await inspector.select('/bug_demo/robot/planner');
  await page.locator('#log-level').selectOption('debug');
  await inspector.until('the level', () => document.querySelector('#log-level').value === 'debug');
  await page.reload();
  await inspector.select('/bug_demo/robot/planner');
  await inspector.until('the level again', () => document.querySelector('#log-level').value === 'debug');
});

test('what begins the cycles of a thread is chosen', async (t) => {
  const { inspector, page } = await Demo(t);
  await inspector.select('/bug_demo/threads/control');
  await inspector.until('the activation', () => document.querySelector('#thread-activation')?.value === 'period');
  await page.locator('#thread-activation').selectOption('free_running');
  await inspector.until('no period', () => document.querySelector('#thread-period') === null);
  await page.locator('#thread-activation').selectOption('period');
  await inspector.until('a period', () => document.querySelector('#thread-period')?.value === '50');
});

test('what a full queue loses is counted', async (t) => {
  const { file } = await DemoFile(t, (text) => Replaced(kSlow(text), '<connect from="world/pose" to="laser/pose localisation/truth referee/pose"/>',
    '<connect from="world/pose" to="laser/pose referee/pose"/> <connect from="world/pose" to="localisation/truth" queue="2"/>'));
  const application = await RunApplication(t, file);
  const inspector = await OpenPage(t, application.url);
  await inspector.select('/bug_demo/localisation/input/truth');
  await inspector.details.locator('.facts dt', { hasText: 'lost from its queue' }).waitFor();
  await inspector.details.locator('.connections', { hasText: 'queue of 2' }).waitFor();
});

test('a plugin is loaded anew while its modules run', async (t) => {
  const { inspector, page } = await Demo(t);
  await inspector.select('/bug_demo/robot/planner');
  await page.locator('#reload').click();
  await page.locator('.toast.done', { hasText: 'planning' }).waitFor();
  assert.equal((await inspector.edges()).length, 24);
});

test('what the application refuses comes up with its reason, and changes nothing', async (t) => {
  const { inspector, page } = await Demo(t);
  await page.locator('#add').click();
  await page.locator('.choice-search').fill('simulation/laser');
  await page.locator('#new-name').fill('laser');
  await page.locator('#create').click();
  await page.locator('dialog .problem', { hasText: "there is a 'laser'" }).waitFor();
  await page.keyboard.press('Escape');
  await inspector.closed();
  await page.locator('#save-as').click();
  await page.locator('#save-file').fill('/nowhere/at/all.xml');
  await page.locator('#save-now').click();
  await page.locator('dialog .problem', { hasText: '/nowhere' }).waitFor();
  await page.keyboard.press('Escape');
  await inspector.closed();
  assert.equal((await inspector.edges()).length, 24);
});
