// The world in three dimensions: fetched when somebody looks, drawn when something has changed.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MockApplication } from '../mock/mock_application.mjs';
import { ServeMock } from '../mock/mock_server.mjs';
import { RobotStructure, RobotValues, kCatalogue } from '../mock/mock_structures.mjs';
import { OpenPage } from '../support/browser.mjs';
import { Cleanup } from '../support/cleanup.mjs';

async function Robot(t, options) {
  let application = null;
  application = new MockApplication({ name: 'mock', catalogue: kCatalogue, structure: RobotStructure(), values: RobotValues(() => application) });
  const server = await ServeMock(application, { page: process.env.RUNNEL_PAGE });
  Cleanup(t, () => server.close());
  const inspector = await OpenPage(t, server.url, options);
  return { application, inspector, page: inspector.page };
}

/** How many pictures have been drawn so far. */
const Drawn = (page) => page.locator('.world-solid canvas').evaluate((canvas) => Number(canvas.dataset.drawn ?? 0));

/** What is seen of it. */
async function Seen(page) {
  return page.screenshot({ clip: await page.locator('.world-solid canvas').boundingBox() });
}

/** How many colours a picture has; one that is empty has one. */
const Colours = async (page) => page.evaluate(async (bytes) => {
  const picture = await createImageBitmap(new Blob([new Uint8Array(bytes)], { type: 'image/png' }));
  const canvas = document.createElement('canvas');
  Object.assign(canvas, { width: picture.width, height: picture.height });
  const context = canvas.getContext('2d');
  context.drawImage(picture, 0, 0);
  const { data } = context.getImageData(0, 0, picture.width, picture.height);
  const found = new Set();
  for (let at = 0; at < data.length; at += 4) found.add((data[at] << 16) | (data[at + 1] << 8) | data[at + 2]);
  return found.size;
}, [...await Seen(page)]);

test('the room is fetched when it is looked at, follows the robot and the colours, and rests when nothing changes', async (t) => {
  const { application, inspector, page } = await Robot(t, { width: 1400, height: 860 });
  const scripts = () => page.evaluate(() => performance.getEntriesByType('resource').filter(({ name }) => name.includes('world_3d')).length);
  await page.locator('#world canvas').first().waitFor();
  assert.equal(await scripts(), 0, 'nothing is fetched that nobody looks at');
  await page.locator('#solid').click();
  await page.locator('.world-solid canvas[data-drawn]').waitFor();
  assert.equal(await scripts(), 1);
  await inspector.until('several pictures', () => Number(document.querySelector('.world-solid canvas').dataset.drawn) > 3);
  assert.ok(await Colours(page) > 20, 'a room, a robot, rays');
  await inspector.picture('solid_light');

  application.paused = true;
  await inspector.until('the pause', () => document.querySelector('#pause').getAttribute('aria-pressed') === 'true');
  // What had come before the pause is drawn; then the count stays.
  let before = -1;
  while (before !== await Drawn(page)) {
    before = await Drawn(page);
    for (let frame = 0; frame < 10; ++frame) await inspector.drawn();
  }
  const box = await page.locator('.world-solid canvas').boundingBox();
  await page.mouse.move(box.x + box.width / 2, box.y + box.height / 2);
  await page.mouse.down();
  await page.mouse.move(box.x + box.width / 2 + 60, box.y + box.height / 2 + 10, { steps: 4 });
  await page.mouse.up();
  await inspector.until('it is turned', (count) => Number(document.querySelector('.world-solid canvas').dataset.drawn) > count, before);

  const light = await Seen(page);
  await page.emulateMedia({ colorScheme: 'dark' });
  await inspector.until('dark', () => document.documentElement.dataset.theme === 'dark');
  while ((await Seen(page)).equals(light)) await inspector.drawn();
  await inspector.picture('solid_dark');

  await page.locator('#solid').click();
  await page.locator('.world-solid').waitFor({ state: 'detached' });
});

test('in a large view the map stays beside it', async (t) => {
  const { page } = await Robot(t, { width: 1500, height: 900 });
  await page.locator('[aria-label="Large map"]').click();
  await page.locator('#solid').click();
  await page.locator('.world-solid canvas[data-drawn]').waitFor();
  const [room, map] = [await page.locator('.world-solid').boundingBox(), await page.locator('.world-map').boundingBox()];
  assert.ok(map.x + map.width <= room.x + 1, 'side by side');
  assert.ok(await page.locator('.world-canvas canvas').isVisible());
});
