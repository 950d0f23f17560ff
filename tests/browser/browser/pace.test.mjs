// The clock of the simulation, and the goal, in the hands of a viewer.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { DemoFile, Replaced, RunApplication } from '../support/runnel.mjs';

async function Demo(t, speed) {
  const { file } = await DemoFile(t, (text) => Replaced(text, 'speed="10"', `speed="${speed}"`));
  const application = await RunApplication(t, file);
  const inspector = await OpenPage(t, application.url);
  return { application, inspector, page: inspector.page };
}

test('pause stands still, a step goes so many cycles, and it goes on', async (t) => {
  const { inspector, page } = await Demo(t, 1);
  await page.locator('#pause').click();
  await page.locator('#pause[aria-pressed="true"]').waitFor();
  const stood = await inspector.time();
  await page.locator('#step-cycles').fill('40');
  await page.locator('#step').click();
  await inspector.until('40 cycles of 50 ms', (time) =>
    Math.abs(Number.parseFloat(document.querySelector('#time').textContent) - time) < 0.011, stood + 2);
  await page.locator('#step-cycles').fill('1');
  await page.locator('#step').click();
  await inspector.until('one more', (time) =>
    Math.abs(Number.parseFloat(document.querySelector('#time').textContent) - time) < 0.011, stood + 2.05);
  await page.locator('#pause').click();
  await page.locator('#pause[aria-pressed="false"]').waitFor();
  await inspector.until('time goes on', (time) => Number.parseFloat(document.querySelector('#time').textContent) > time, stood + 2.2);
});

test('the speed is chosen, and shown to all viewers', async (t) => {
  const { application, inspector, page } = await Demo(t, 1);
  const other = await OpenPage(t, application.url);
  await page.locator('#speed').selectOption('5');
  await other.until('the other page to know', () => document.querySelector('#speed').value === '5');
  const before = await inspector.time();
  await inspector.until('time at that speed', (time) => Number.parseFloat(document.querySelector('#time').textContent) > time, before + 3);
});

test('the goal is dragged, and moved by keys; an undo brings it back', async (t) => {
  const { inspector, page } = await Demo(t, 0.5);
  const goal = page.locator('.goal');
  const described = async () => (await goal.getAttribute('aria-label')).match(/-?[−\d.]+/g).map((text) => Number(text.replace('−', '-')));
  await goal.waitFor();
  const before = await described();
  const box = await goal.boundingBox();
  const [x, y] = [box.x + box.width / 2, box.y + box.height / 2];
  await page.mouse.move(x, y);
  await page.mouse.down();
  await page.mouse.move(x - 40, y + 10, { steps: 3 });
  await page.mouse.up();
  await page.locator('.goal:not(.moved)').waitFor();
  await inspector.until('the goal to be elsewhere', (x0) =>
    Number(document.querySelector('.goal').getAttribute('aria-label').match(/x (\S+)/)[1].replace('−', '-')) < x0 - 0.3, before[0]);
  const undo = page.locator('#undo');
  await page.locator('#undo[aria-label*="goal"]').waitFor();

  const dragged = await described();
  await goal.focus();
  await page.keyboard.press('ArrowLeft');
  await page.keyboard.press('ArrowLeft');
  await page.locator('.goal:not(.moved)').waitFor();
  await inspector.until('two tenths of a metre', (x0) =>
    Math.abs(Number(document.querySelector('.goal').getAttribute('aria-label').match(/x (\S+)/)[1].replace('−', '-')) - (x0 - 0.2)) < 0.006, dragged[0]);
  await undo.click();
  await inspector.until('the goal to come back', (x0) =>
    Math.abs(Number(document.querySelector('.goal').getAttribute('aria-label').match(/x (\S+)/)[1].replace('−', '-')) - x0) < 0.006, dragged[0]);
});
