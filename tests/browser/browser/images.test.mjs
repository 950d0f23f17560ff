// Pictures: drawn where they are looked at, and fetched nowhere else.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MockApplication, ModuleElements } from '../mock/mock_application.mjs';
import { ServeMock } from '../mock/mock_server.mjs';
import { RobotStructure, kCatalogue } from '../mock/mock_structures.mjs';
import { OpenPage } from '../support/browser.mjs';
import { Cleanup } from '../support/cleanup.mjs';

const kImage = '/mock/camera/image';
const kSize = { width: 64, height: 48 };

function Pixels(time) {
  const bytes = Buffer.alloc(kSize.width * kSize.height * 3);
  for (let y = 0, at = 0; y < kSize.height; ++y) {
    for (let x = 0; x < kSize.width; ++x, at += 3) bytes.set([x * 4, y * 5, (time * 40) % 256], at);
  }
  return bytes.toString('base64');
}

async function WithCamera(t) {
  const catalogue = {
    modules: [...kCatalogue.modules, { type: 'mock/camera', summary: 'sees', plugin: 'mock', parameters: [],
      ports: [{ name: 'image', direction: 'output', type: 'Image' }] }],
    types: [...kCatalogue.types, { name: 'Image', kind: 'structure', meaning: 'image', fields: [] }],
  };
  const structure = RobotStructure();
  structure.elements.push(...ModuleElements(catalogue, 'mock/camera', '/mock/camera'));
  const values = { [kImage]: (time) => ({ ...kSize, encoding: 'rgb8', step: kSize.width * 3, data: Pixels(time) }) };
  const server = await ServeMock(new MockApplication({ name: 'mock', catalogue, structure, values }), { page: process.env.RUNNEL_PAGE });
  Cleanup(t, () => server.close());
  const inspector = await OpenPage(t, server.url, { width: 1400, height: 860 });
  return { server, inspector, page: inspector.page };
}

test('a picture is drawn in the details, comes anew, and is not fetched when nobody looks', async (t) => {
  const { server, inspector, page } = await WithCamera(t);
  assert.ok(!server.watched().includes(kImage));
  await inspector.click('/mock/camera');
  const picture = page.locator(`[data-picture="${kImage}"]`);
  await picture.locator('.note', { hasText: '64 × 48 rgb8' }).waitFor();
  await inspector.until('another picture', () => Number(document.querySelector('.picture canvas').dataset.count) > 2);
  const pixel = await picture.locator('canvas').evaluate((canvas) => [...canvas.getContext('2d').getImageData(10, 20, 1, 1).data]);
  assert.deepEqual([pixel[0], pixel[1], pixel[3]], [40, 100, 255]);
  assert.deepEqual(server.asked(kImage).as, 'image');
  await inspector.picture('image');

  await inspector.click('/mock/laser');
  await picture.waitFor({ state: 'detached' });
  while (server.watched().includes(kImage)) await inspector.drawn();
});

test('in the table a picture is told, and shown when it is clicked', async (t) => {
  const { page, inspector } = await WithCamera(t);
  await page.locator('#tab-ports').click();
  const line = page.locator(`[data-port-line="${kImage}"]`);
  await line.locator('.value', { hasText: '64 × 48 rgb8' }).waitFor();
  await line.click();
  await inspector.shows(kImage);
  await page.locator(`#details [data-picture="${kImage}"] canvas[data-count]`).waitFor();
});
