// The operator's panel says what is so: refusals, panels of others, widgets that cannot be drawn.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenMockPanel } from '../support/open_mock.mjs';

const kText = { id: 'note', kind: 'text', x: 0, y: 0, w: 3, h: 2, text: 'made by hand' };
const Saved = (...widgets) => JSON.stringify({ panel: 1, widgets });

test('a switch that is refused shows what the application has, each time', async (t) => {
  const { page } = await OpenMockPanel(t, { widgets: [{ id: 'flip', kind: 'switch', x: 0, y: 0, w: 3, h: 2, target: '/mock/robot/planner/stubborn' }] });
  const flip = page.locator('[data-widget="flip"] input');
  for (let time = 0; time < 3; ++time) {
    await flip.dispatchEvent('click');
    await page.locator('[data-widget="flip"] .problem', { hasText: 'not to its taste' }).waitFor();
    await page.waitForFunction(() => !document.querySelector('[data-widget="flip"] input').checked);
  }
});

test('a panel whose reply the connection has lost is asked for again', async (t) => {
  let asked = 0;
  const { application, page } = await OpenMockPanel(t, { widgets: [kText], lost: true, prepare: (mock) => {
    mock.answers.panel = (reply, _, socket) => (++asked === 1 ? socket.terminate() : reply({ ok: true, text: Saved(kText), file: '/x' }));
  } });
  await page.getByText('made by hand').waitFor();
  assert.equal(asked, 2);
  await page.locator('#edit').click();
  await page.locator('#panel-state', { hasText: /^saved$/ }).waitFor();
  assert.ok(!application.asked.some(({ op }) => op === 'save_panel'));
});

test('a panel is made for the structure of this connection, not for that of the one before', async (t) => {
  const { application, server, page } = await OpenMockPanel(t, { lost: true });
  await page.locator('[data-widget="joystick"]').waitFor();
  application.delay = 500;
  application.values = {}; // they are of the old names
  application.change([{ change: 'rename', path: '/mock/world', name: 'earth' }]);
  server.restart();
  await page.locator('#edit').click();
  await page.locator('[data-widget="joystick"] .card-bar').click();
  await page.waitForFunction(() => document.querySelector('#setting\\:target')?.value === '/mock/earth/twist');
});

test('saving over a panel that somebody else has changed is asked for twice', async (t) => {
  const { application, page } = await OpenMockPanel(t, { widgets: [kText] });
  await page.locator('#edit').click();
  await page.locator('[data-add="text"]').click();
  application.panel = Saved({ ...kText, text: 'by another' });
  await page.locator('#save-panel').click();
  await page.getByText('somebody has changed it').waitFor();
  assert.match(application.panel, /by another/);
  await page.locator('#save-panel', { hasText: 'Overwrite' }).click();
  await page.locator('#panel-state', { hasText: /^saved$/ }).waitFor();
  assert.doesNotMatch(application.panel, /by another/);
  application.panel = Saved({ ...kText, text: 'by a third' });
  await page.locator('[data-add="text"]').click();
  await page.locator('#save-panel').click();
  await page.locator('#save-panel', { hasText: 'Overwrite' }).waitFor();
  await page.locator('#discard').click();
  await page.getByText('by a third').waitFor();
  await page.locator('#panel-state', { hasText: /^saved$/ }).waitFor();
});

test('a widget that cannot be drawn says so, and takes nothing else with it', async (t) => {
  const gauge = { id: 'gauge', kind: 'gauge', x: 3, y: 0, w: 2, h: 4, target: '/mock/world/pose', field: 'x', minimum: '0', maximum: 2 };
  const { page } = await OpenMockPanel(t, { widgets: [kText, gauge], forgive: [/cannot be drawn/] });
  await page.locator('[data-widget="gauge"] .problem', { hasText: 'cannot be drawn' }).waitFor();
  await page.getByText('made by hand').waitFor();
});
