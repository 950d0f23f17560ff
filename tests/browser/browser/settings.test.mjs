// Parameters of modules that are about to be made: in Add, in Swap, and by the details of a module that is there.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { DemoFile, RunApplication } from '../support/runnel.mjs';

async function Demo(t) {
  const { file } = await DemoFile(t);
  const application = await RunApplication(t, file, { options: ['--speed', '0.2'] });
  return OpenPage(t, application.url, { width: 1400, height: 860 });
}

/** The text of a parameter, when the details have it. */
async function Has(inspector, name, value) {
  await inspector.until(`${name} = ${value}`, ([which, wanted]) => {
    const field = [...document.querySelectorAll('#details .parameter')]
      .find((row) => row.querySelector('label')?.textContent.trim() === which)?.querySelector('input, select');
    return field?.value === wanted;
  }, [name, value]);
}

test('a module is added with static parameters, whose bounds, units and defaults are told', async (t) => {
  const inspector = await Demo(t);
  const { page } = inspector;
  await page.locator('#graph').focus();
  await page.keyboard.press('a');
  await page.locator('.choice-search').fill('simulation/laser');
  await page.locator('[data-choice="simulation/laser"]').hover();
  await page.locator('.choices .more').click();
  const row = page.locator('.settings .parameter', { hasText: 'field_of_view' });
  assert.match(await row.locator('.note').last().textContent(), /0\.01 … 6\.2832 rad · fixed while it runs/);
  assert.equal(await row.locator('.unit').textContent(), 'rad');
  const rays = page.locator('[id="setting:rays"]');
  assert.equal(await rays.inputValue(), '181');
  await rays.fill('1');
  await page.locator('.settings .problem', { hasText: 'at least 2' }).waitFor();
  await page.locator('#create').click();
  await page.locator('dialog > .dialog-body > .problem', { hasText: 'rays' }).waitFor();
  await rays.fill('33');
  await page.locator('#new-name').fill('second');
  await inspector.picture('add_with_parameters');
  await page.locator('#create').click();
  await inspector.shows('/bug_demo/second');
  await Has(inspector, 'rays', '33');
  await Has(inspector, 'range_maximum', '4');
});

test('a module is swapped by its own type, with another static parameter, and this is undone', async (t) => {
  const inspector = await Demo(t);
  const { page } = inspector;
  await inspector.click('/bug_demo/laser');
  await page.locator('#swap').click();
  await page.locator('[data-choice="simulation/laser"] small', { hasText: 'its own type' }).waitFor();
  await page.locator('[data-choice="simulation/laser"]').click();
  const rays = page.locator('[id="setting:rays"]');
  const before = await rays.inputValue();
  await rays.fill('61');
  await rays.press('Enter');
  await inspector.closed();
  await Has(inspector, 'rays', '61');
  assert.equal((await inspector.edges()).filter((edge) => edge.includes('/laser/')).length, 3, 'its connections stay');
  await page.locator('#undo').click();
  await Has(inspector, 'rays', before);
});

test('a static parameter of a module that runs is set where its others are', async (t) => {
  const inspector = await Demo(t);
  await inspector.click('/bug_demo/laser');
  await inspector.parameterRow('rays').locator('.note', { hasText: 'makes the module anew' }).waitFor();
  await inspector.parameter('rays').fill('45');
  await inspector.parameter('rays').press('Enter');
  await inspector.page.locator('#undo:not([disabled])').waitFor();
  await Has(inspector, 'rays', '45');
});
