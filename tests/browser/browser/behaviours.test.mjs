// A network of behaviours, drawn as its users draw it.

import assert from 'node:assert/strict';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { Cleanup } from '../support/cleanup.mjs';
import { RunApplication } from '../support/runnel.mjs';

const kNetwork = '/behaviour_demo/network';

/** The demonstration, slowly: nothing is in its way for a long time. */
async function Demo(t) {
  const folder = await mkdtemp(join(tmpdir(), 'runnel_behaviours_'));
  Cleanup(t, () => rm(folder, { recursive: true, force: true }));
  const text = (await readFile(join(process.env.RUNNEL_XML, 'apps/behaviour_demo.xml'), 'utf8'))
    .replaceAll('../worlds/', `${process.env.RUNNEL_XML}/worlds/`);
  const file = join(folder, 'behaviour_demo.xml');
  await writeFile(file, text);
  return RunApplication(t, file, { options: ['--speed', '0.2'] });
}

test('boxes have bars, edges the colour of their signal, and a press on the sign sets the mode', async (t) => {
  const application = await Demo(t);
  const inspector = await OpenPage(t, application.url, { width: 1400, height: 860, colours: 'dark' });
  const { page } = inspector;
  for (const name of ['drive', 'avoid', 'escape', 'follow_wall', 'motion', 'emergency_stop', 'safe_motion']) {
    await page.locator(`[data-bars="${kNetwork}/${name}"]`).waitFor();
  }
  assert.equal(await page.locator(`[data-bars="${kNetwork}/teller"]`).count(), 0, 'no behaviour');
  await page.locator(`[data-bars="${kNetwork}/drive"][aria-label^="activation 1.00, activity 1.00"]`).waitFor();
  await inspector.until('the bar is as long as the activity', (path) => {
    const bars = document.querySelector(`[data-bars="${path}"]`);
    const width = (rect) => Number(bars.querySelector(rect).getAttribute('width'));
    return width('.activity .bar') === width('.activity .ground') && width('.activity .bar') > 50;
  }, `${kNetwork}/drive`);
  const edge = (signal, end) => page.locator(`path.edge.${signal}[data-edge*="${kNetwork}/${end}"]`);
  await edge('stimulation', 'avoid/input/stimulation').waitFor();
  await edge('inhibition', 'drive/input/inhibition1').waitFor();
  await edge('activity', 'motion/input/activity1').waitFor();
  await inspector.picture('behaviours_dark');

  await page.mouse.move(560, 280);
  await page.mouse.wheel(0, -700); // near, texts and signs are shown
  const mode = (word) => page.locator(`[data-mode-of="${kNetwork}/drive"][aria-label$="${word}"]`);
  await mode('enabled').waitFor();
  await inspector.picture('behaviours_near');
  await mode('enabled').dispatchEvent('click');
  await mode('disabled').waitFor();
  await page.locator(`[data-bars="${kNetwork}/drive"][aria-label^="activation 0.00, activity 0.00"]`).waitFor();
  await page.locator(`[data-bars="${kNetwork}/avoid"][aria-label^="activation 0.00"]`).waitFor();

  await page.emulateMedia({ colorScheme: 'light' });
  await inspector.until('light', () => getComputedStyle(document.body).backgroundColor === 'rgb(243, 245, 248)');
  await inspector.picture('behaviours_light');
});
