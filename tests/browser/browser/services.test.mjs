// Services called from the page, by forms made from their types.

import assert from 'node:assert/strict';
import { readFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { DemoFile, RunApplication } from '../support/runnel.mjs';

async function Places(t) {
  const places = (await readFile(join(process.env.RUNNEL_XML, 'apps/places_demo.xml'), 'utf8'))
    .replaceAll('../worlds/', `${process.env.RUNNEL_XML}/worlds/`);
  const { file } = await DemoFile(t, () => places);
  const application = await RunApplication(t, file, { options: ['--speed', '1'] });
  return OpenPage(t, application.url, { width: 1400, height: 900 });
}

async function Choose(inspector, path) {
  // A second click would put the table away.
  if (!await inspector.page.locator('#port-filter').isVisible()) await inspector.page.locator('#tab-ports').click();
  await inspector.page.locator('#port-filter').fill(path);
  await inspector.page.locator(`[data-port-line="${path}"]`).click();
  await inspector.page.locator(`[data-service="${path}"]`).waitFor();
}

test('a service is called by its form, and says what it replies and what is wrong', async (t) => {
  const inspector = await Places(t);
  const { page } = inspector;
  const book = '/places_demo/book/output/remember';
  await Choose(inspector, book);
  const form = page.locator(`[data-service="${book}"]`);
  await form.locator('input').fill('dock one');
  await form.locator('.call').click();
  await form.locator('.reply', { hasText: 'heading' }).waitFor();
  await inspector.picture('service_form');
  const where = '/places_demo/book/output/where';
  await Choose(inspector, where);
  await page.locator(`[data-service="${where}"] input`).fill('dck one');
  await page.locator(`[data-service="${where}"] input`).press('Enter');
  await page.locator(`[data-service="${where}"] .problem`, { hasText: "'dock one'" }).waitFor();
});

test('a call that takes long is answered when it has ended', async (t) => {
  const inspector = await Places(t);
  const { page } = inspector;
  const go = '/places_demo/driver/output/go';
  await Choose(inspector, '/places_demo/book/output/remember');
  const remember = page.locator('[data-service="/places_demo/book/output/remember"]');
  await remember.locator('input').fill('here');
  await remember.locator('.call').click();
  await remember.locator('.reply').waitFor();
  await Choose(inspector, go);
  const form = page.locator(`[data-service="${go}"]`);
  await form.locator('input').fill('nowhere');
  await form.locator('.call').click();
  await form.locator('.problem', { hasText: 'nowhere' }).waitFor();
  await form.locator('.calls', { hasText: '1 failed' }).waitFor();
  await form.locator('input').fill('here');
  await form.locator('.call').click();
  await form.locator('.reply').waitFor();
  await form.locator('.calls', { hasText: '1 answered, 1 failed' }).waitFor();
  assert.equal(await form.locator('.call').textContent(), 'Call');
});

test('how far a call has come is shown, and it is aborted', async (t) => {
  const inspector = await Places(t);
  const { page } = inspector;
  // Far from where the robot is.
  const pose = '/places_demo/book/input/pose';
  await page.locator('#tab-ports').click();
  await page.locator('#port-filter').fill(pose);
  await page.locator(`[data-port-line="${pose}"]`).click();
  const hand = page.locator(`[data-by-hand="${pose}"]`);
  await hand.locator('input').first().fill('{x: 4, y: 2.5, heading: 0}');
  await hand.locator('input').first().press('Enter');
  await hand.locator('.release').waitFor();
  const remember = '/places_demo/book/output/remember';
  await Choose(inspector, remember);
  await page.locator(`[data-service="${remember}"] input`).fill('far');
  await page.locator(`[data-service="${remember}"] .call`).click();
  await page.locator(`[data-service="${remember}"] .reply`, { hasText: 'x: 4' }).waitFor();
  const go = '/places_demo/driver/output/go';
  await Choose(inspector, go);
  const form = page.locator(`[data-service="${go}"]`);
  await form.locator('input').fill('far');
  await form.locator('.call').click();
  await form.locator('.activity', { hasText: '% driving' }).waitFor();
  await inspector.picture('service_progress');
  await form.locator('.abort').click();
  await form.locator('.problem', { hasText: "on the way to 'far'" }).waitFor();
  await form.locator('.activity').waitFor({ state: 'detached' });
});

test('a blackboard shows its revision, who reads and who writes', async (t) => {
  const inspector = await Places(t);
  const { page } = inspector;
  const places = '/places_demo/book/output/places';
  await page.locator('#tab-ports').click();
  await page.locator('#port-filter').fill(places);
  await page.locator(`[data-port-line="${places}"]`).click();
  const board = page.locator('#details section', { hasText: 'Blackboard' });
  await board.locator('dd', { hasText: 'surveyor' }).first().waitFor();
  await board.locator('dd', { hasText: '1 answered' }).waitFor();
  await page.locator('#details', { hasText: 'way 1' }).waitFor();
  await inspector.picture('blackboard');
});
