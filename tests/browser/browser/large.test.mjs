// A thousand modules with two thousand connections: the page answers, and never draws too much.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MockApplication } from '../mock/mock_application.mjs';
import { ServeMock } from '../mock/mock_server.mjs';
import { LargeStructure, kCatalogue } from '../mock/mock_structures.mjs';
import { OpenPage } from '../support/browser.mjs';
import { Cleanup } from '../support/cleanup.mjs';

const kMostNodes = 6000; // of the document, whatever is open

async function Large(t, groups, each) {
  const application = new MockApplication({ name: 'large', catalogue: kCatalogue, structure: LargeStructure(groups, each) });
  const server = await ServeMock(application, { page: process.env.RUNNEL_PAGE });
  Cleanup(t, () => server.close());
  return OpenPage(t, server.url);
}

const CountNodes = (page) => page.evaluate(() => document.querySelectorAll('*').length);

test('groups are folded at first, and open one by one', async (t) => {
  const inspector = await Large(t, 40, 25);
  const { page } = inspector;
  assert.equal(await page.locator('[data-node]').count(), 40);
  assert.ok(await CountNodes(page) < kMostNodes);
  await inspector.select('/large/group_7/filter_12');
  await inspector.node('/large/group_7/filter_12').waitFor();
  assert.equal(await page.locator('#details h2').textContent(), 'filter_12');
  assert.ok(await CountNodes(page) < kMostNodes);
});

test('all open, from far away and near, the document stays small and answers', async (t) => {
  const inspector = await Large(t, 40, 25);
  const { page } = inspector;
  await page.locator('#graph').click({ button: 'right', position: { x: 5, y: 5 } });
  await page.locator('[role="menuitem"]', { hasText: 'Open all groups' }).click();
  await page.locator('.boxes-far').first().waitFor();
  assert.ok(await CountNodes(page) < kMostNodes, `${await CountNodes(page)} nodes from far away`);
  await inspector.picture('thousand_modules');
  await inspector.select('/large/group_20/filter_3');
  await inspector.node('/large/group_20/filter_3').waitFor();
  assert.ok(await CountNodes(page) < kMostNodes, `${await CountNodes(page)} nodes from near`);
  const field = inspector.parameter('window');
  await field.fill('9');
  await field.press('Enter');
  await page.locator('#undo:not([disabled])').waitFor();
  await page.locator('#undo').click();
  await inspector.until('the old value', () => document.querySelector('#details .parameter input').value === '5');
});

test('a thousand modules without groups can be walked through', async (t) => {
  const inspector = await Large(t, 1, 1000);
  const { page } = inspector;
  await inspector.select('/large/group_0/filter_500');
  await inspector.node('/large/group_0/filter_500').waitFor();
  assert.ok(await CountNodes(page) < kMostNodes);
  await page.locator('#graph').focus();
  await page.keyboard.press('ArrowRight');
  await inspector.until('the next one', () => {
    const name = document.querySelector('#details h2').textContent;
    return name.startsWith('filter_') && name !== 'filter_500';
  });
});
