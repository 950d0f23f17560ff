// The demonstration, as a visitor sees it: from the graph to the robot at its goal.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { DemoFile, Replaced, RunApplication } from '../support/runnel.mjs';

const kPlanner = '/bug_demo/robot/planner';

test('the graph is seen, a value changes, a parameter is set, the planner is swapped, the robot arrives', async (t) => {
  const { file } = await DemoFile(t, (text) => Replaced(text, 'speed="10"', 'speed="3"'));
  const application = await RunApplication(t, file, { options: ['--hold'] });
  const inspector = await OpenPage(t, application.url, { width: 1600, height: 1000, lost: true });
  const { page } = inspector;

  for (const name of ['world', 'laser', 'robot', 'robot/planner', 'referee']) {
    await inspector.node(`/bug_demo/${name}`).waitFor();
  }
  assert.equal((await inspector.edges()).length, 24);
  // Rates come along: the world publishes its pose in each of 20 cycles a second.
  await inspector.until('the rate of the pose', () =>
    [...document.querySelectorAll('[data-node="/bug_demo/world"] .rate')].some((rate) => rate.textContent === '20 Hz'));

  await t.test('a value changes', async () => {
    await inspector.click('/bug_demo/world');
    const value = page.locator('[data-port-row$="/pose"] .value');
    await value.filter({ hasText: 'heading' }).waitFor();
    const before = await value.textContent();
    await inspector.until('another pose', (text) =>
      document.querySelector('[data-port-row$="/pose"] .value').textContent !== text, before);
  });

  await t.test('a parameter is set, and one that is out of its bounds is refused at its field', async () => {
    await inspector.click(kPlanner);
    const field = inspector.parameter('cruise_speed');
    await inspector.enter(field, '11', inspector.parameterRow('cruise_speed').locator('.problem', { hasText: '10 m/s' }));
    await inspector.enter(field, '0.45', inspector.details.getByLabel('Set cruise_speed back to 0.4'));
    assert.equal(await field.inputValue(), '0.45');
    assert.equal(await inspector.parameterRow('cruise_speed').locator('.problem').count(), 0);
    await page.locator('#undo:not([disabled])').waitFor();
  });

  await t.test('while it drives the planner becomes a TangentBug', async () => {
    await page.locator('#swap').click();
    await page.locator('.choice-search').fill('tangent');
    await page.locator('[data-choice="planning/tangent_bug"]').click();
    await inspector.node(kPlanner).locator('.type', { hasText: 'planning/tangent_bug' }).waitFor();
    await inspector.details.locator('.kind', { hasText: 'planning/tangent_bug' }).waitFor();
    assert.equal((await inspector.edges()).length, 24, 'all connections stay');
  });

  await t.test('numbers are plotted', async () => {
    await inspector.select(`${kPlanner}/output/twist`);
    await page.locator('[data-field="forward"] .plot-this').click();
    await page.locator('[data-field="turn"] .plot-this').click();
    await inspector.until('two plots', () => document.querySelectorAll('.plot canvas').length === 2);
    await inspector.until('values in them', () =>
      [...document.querySelectorAll('.legend output')].every((output) => /\d/.test(output.textContent)));
  });

  await t.test('the robot arrives', async () => {
    await inspector.click(kPlanner);
    const plotted = await inspector.time();
    await inspector.until('20 s of plots', (time) => {
      const [seconds, minutes = 0] = document.querySelector('#time').textContent.split(':').map(parseFloat).reverse();
      return minutes * 60 + seconds > time;
    }, plotted + 20);
    await page.locator('.toast').waitFor({ state: 'detached' });
    await page.setViewportSize({ width: 1500, height: 860 });
    await inspector.picture('inspector_light');
    await page.emulateMedia({ colorScheme: 'dark' });
    await inspector.until('dark', () => getComputedStyle(document.body).backgroundColor === 'rgb(16, 20, 26)');
    await inspector.picture('inspector_dark');
    await page.locator('#speed').selectOption('0');
    await page.locator('#connection-state', { hasText: 'reached' }).waitFor();
    assert.equal(await application.stop(), 0, application.output());
    assert.match(application.output(), /reached: path/);
    await page.locator('#lost', { hasText: 'reached' }).waitFor();
  }, { timeout: 300000 });
});
