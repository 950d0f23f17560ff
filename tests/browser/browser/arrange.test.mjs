// Boxes, notes, copies, the address; small windows and phones.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { OpenMock } from '../support/open_mock.mjs';
import { DemoFile, Replaced, RunApplication } from '../support/runnel.mjs';

const kSlow = (text) => Replaced(text, 'speed="10"', 'speed="0.2"');

async function Place(inspector, path) {
  await inspector.drawn();
  const { x, y } = await inspector.node(path).locator('.body').boundingBox();
  return { x: Math.round(x), y: Math.round(y) };
}

async function Drag(inspector, path, dx, dy) {
  const { page } = inspector;
  await inspector.drawn();
  const { x, y, width, height } = await inspector.node(path).locator('.name').boundingBox();
  await page.mouse.move(x + width / 2, y + height / 2);
  await page.mouse.down();
  await page.mouse.move(x + width / 2 + dx, y + height / 2 + dy, { steps: 5 });
  await page.mouse.up();
}

test('at 1400x860 the names of all ports of the demonstration can be read without zooming', async (t) => {
  const { file } = await DemoFile(t, kSlow);
  const application = await RunApplication(t, file);
  const { inspector, page } = await Opened(t, application.url, { width: 1400, height: 860 });
  await inspector.drawn();
  const names = await page.locator('.port > text:not(.rate)').evaluateAll((texts) => texts.map((text) => {
    const scale = text.getScreenCTM().a;
    const { x, y, right, bottom } = text.getBoundingClientRect();
    return { name: text.textContent, size: parseFloat(getComputedStyle(text).fontSize) * scale, x, y, right, bottom };
  }));
  const { width, height } = await page.locator('#graph').boundingBox();
  assert.ok(names.length >= 30, `${names.length} ports`);
  for (const { name, size, right, bottom } of names) {
    assert.ok(size >= 11, `${name} is ${size.toFixed(1)} px`);
    assert.ok(right <= width && bottom <= height + 60, `${name} is on the screen`);
  }
  assert.equal(await page.locator('#minimap').count(), 0, 'all is on the screen');
  await page.locator('[aria-label="Zoom in"]').click();
  await page.locator('[aria-label="Zoom in"]').click();
  await page.locator('#minimap').waitFor();
});

test('a box is moved by mouse and stays: for other viewers, after a reload, after a restart of the application', async (t) => {
  const { file } = await DemoFile(t, kSlow);
  const application = await RunApplication(t, file);
  const { inspector, page } = await Opened(t, application.url, { lost: true });
  const other = await OpenPage(t, application.url, { lost: true });
  const before = await Place(inspector, '/bug_demo/laser');
  await Drag(inspector, '/bug_demo/laser', 60, 90);
  const after = await Place(inspector, '/bug_demo/laser');
  assert.ok(Math.abs(after.x - before.x - 60) <= 4 && Math.abs(after.y - before.y - 90) <= 4, JSON.stringify([before, after]));
  const Apart = async (each) => {
    const [world, laser] = [await Place(each, '/bug_demo/world'), await Place(each, '/bug_demo/laser')];
    const scale = await each.page.evaluate(() => document.querySelector('.scene').getScreenCTM().a);
    return `${Math.round((laser.x - world.x) / scale / 8)} ${Math.round((laser.y - world.y) / scale / 8)}`;
  };
  const wanted = await Apart(inspector);
  const Same = async (each, what) => {
    for (let i = 0; i < 100; ++i) {
      if (await Apart(each) === wanted) return;
      await each.drawn();
    }
    assert.equal(await Apart(each), wanted, what);
  };
  await Same(other, 'for another viewer');
  await page.reload();
  await inspector.node('/bug_demo/laser').waitFor();
  await Same(inspector, 'after a reload');
  await page.goto('about:blank');
  await other.page.goto('about:blank');
  await application.stop();
  const again = await RunApplication(t, file);
  await page.goto(again.url);
  await inspector.node('/bug_demo/laser').waitFor();
  await Same(inspector, 'after a restart');

  await t.test('and goes back when it is arranged automatically', async () => {
    await page.locator('#graph').click({ button: 'right', position: { x: 4, y: 4 } });
    await page.locator('[role="menuitem"]', { hasText: 'Arrange automatically' }).click();
    await inspector.closed();
    await inspector.until('it is gone', () => document.querySelector('.scene') !== null);
    assert.notEqual(await Apart(inspector), wanted);
  });
}, { timeout: 400000 });

test('notes on boxes and on connections are seen by all viewers, changed and taken away', async (t) => {
  const { application, server, inspector, page } = await OpenMock(t);
  const other = await OpenPage(t, server.url);
  await inspector.select('/mock/laser');
  await page.locator('#graph').focus();
  await page.keyboard.press('n');
  await page.locator('#note-text').fill('turned by 180 degrees');
  await page.keyboard.press('Enter');
  await inspector.closed();
  await inspector.node('/mock/laser').locator('.note-on', { hasText: 'turned by 180 degrees' }).waitFor();
  await other.node('/mock/laser').locator('.note-on', { hasText: 'turned' }).waitFor();
  const key = '/mock/laser/scan → /mock/robot/scan';
  await page.goto(`${server.url}#${new URLSearchParams({ at: key })}`);
  await page.locator('#details .kind', { hasText: 'connection' }).waitFor();
  await page.locator('#note').click();
  await page.locator('#note-text').fill('10 Hz at most');
  await page.locator('#note-keep').click();
  await other.page.locator('.edge-note', { hasText: '10 Hz at most' }).waitFor();
  await page.locator('#note').click();
  await page.locator('#note-remove').click();
  await other.page.locator('.edge-note').waitFor({ state: 'detached' });
  assert.equal(application.layout['note /mock/laser'], 'turned by 180 degrees');
});

test('a note that is refused stays in its dialog, and one that nobody has edited takes no other one away', async (t) => {
  const { application, server, inspector, page } = await OpenMock(t);
  const other = await OpenPage(t, server.url);
  const open = async (each) => {
    await each.select('/mock/laser');
    await each.page.locator('#note').click();
    await each.page.locator('#note-text').waitFor();
  };
  await open(inspector);
  await open(other);
  await other.page.locator('#note-text').fill('of the other one');
  await other.page.keyboard.press('Enter');
  await other.closed();
  await inspector.node('/mock/laser').locator('.note-on', { hasText: 'of the other one' }).waitFor();
  await page.locator('#note-keep').click();
  await inspector.closed();
  assert.equal(application.layout['note /mock/laser'], 'of the other one');
  application.answers.arrange = (reply) => reply({ ok: false, errors: [{ message: 'no space left on device', path: null, hint: null }] });
  await open(inspector);
  await page.locator('#note-text').fill('of this one');
  await page.keyboard.press('Enter');
  await page.locator('dialog .problem', { hasText: 'no space left' }).waitFor();
  assert.equal(await page.locator('#note-text').inputValue(), 'of this one');
  await page.keyboard.press('Escape');
  await inspector.closed();
});

test('several boxes are chosen by clicks and by a band, moved, copied and deleted together', async (t) => {
  const { application, inspector, page } = await OpenMock(t);
  await inspector.click('/mock/world');
  await page.keyboard.down('Shift');
  await inspector.click('/mock/laser');
  await page.keyboard.up('Shift');
  await page.locator('#details h2', { hasText: '2 boxes' }).waitFor();
  const before = [await Place(inspector, '/mock/world'), await Place(inspector, '/mock/laser')];
  await Drag(inspector, '/mock/laser', 20, 60);
  const after = [await Place(inspector, '/mock/world'), await Place(inspector, '/mock/laser')];
  assert.deepEqual([after[0].x - before[0].x, after[0].y - before[0].y], [after[1].x - before[1].x, after[1].y - before[1].y]);
  await page.keyboard.press('g');
  await page.keyboard.press('Control+c');
  await page.keyboard.press('Control+v');
  await inspector.node('/mock/world_2').waitFor({ state: 'attached' });
  await inspector.node('/mock/laser_2').waitFor({ state: 'attached' });
  await page.locator('#details h2', { hasText: '2 boxes' }).waitFor();
  assert.ok(application.connections.some(({ from, to }) => from === '/mock/world_2/pose' && to === '/mock/laser_2/pose'));
  await page.locator('#graph').focus();
  await page.keyboard.press('Delete');
  await inspector.node('/mock/world_2').waitFor({ state: 'detached' });
  await inspector.node('/mock/laser_2').waitFor({ state: 'detached' });
  await page.keyboard.press('f');
  await inspector.drawn();
  const area = await page.locator('#graph').boundingBox();
  await page.keyboard.down('Shift');
  await page.mouse.move(area.x + 2, area.y + 2);
  await page.mouse.down();
  await page.mouse.move(area.x + area.width - 2, area.y + area.height - 60, { steps: 4 });
  await page.mouse.up();
  await page.keyboard.up('Shift');
  await page.locator('#details h2', { hasText: '3 boxes' }).waitFor();
});

test('selection, folded groups, plots and panels stand in the address: they survive a reload and can be sent', async (t) => {
  const { server, inspector, page } = await OpenMock(t);
  await page.locator('[data-fold="/mock/robot"]').click();
  await inspector.node('/mock/robot/planner').waitFor({ state: 'detached' });
  await inspector.select('/mock/world/pose');
  await page.locator('[data-field="x"] .plot-this').click();
  await page.locator('.plot').waitFor();
  await inspector.until('the address', () => /plot=/.test(location.hash) && /at=\/mock\/world\/pose/.test(location.hash));
  const Check = async (each) => {
    await each.page.locator('#details h2', { hasText: 'pose' }).waitFor();
    await each.page.locator('.legend', { hasText: 'world/pose.x' }).waitFor();
    assert.equal(await each.node('/mock/robot/planner').count(), 0);
  };
  const address = page.url();
  await page.reload();
  await Check(inspector);
  await Check(await OpenPage(t, address));
  assert.ok(address.startsWith(server.url));
});

test('in a window of 800x600 the graph has the room, and details lie over it when they are wanted', async (t) => {
  const { inspector, page } = await OpenMock(t, { width: 800, height: 600 });
  const { width } = await page.locator('#graph').boundingBox();
  assert.equal(width, 800);
  for (const id of ['pause', 'undo', 'save', 'search', 'show-side', 'theme']) {
    const { x, width: wide } = await page.locator(`#${id}`).boundingBox();
    assert.ok(x >= 0 && x + wide <= 800, id);
  }
  await inspector.click('/mock/laser');
  await page.locator('#details h2', { hasText: 'laser' }).waitFor();
  await page.locator('.close-side').click();
  await page.locator('#details').waitFor({ state: 'detached' });
});

test('on a phone map, graph, values, parameters and STOP are a tap away', async (t) => {
  const { application, inspector, page } = await OpenMock(t, { width: 390, height: 844 });
  for (const id of ['phone-map', 'phone-graph', 'phone-values', 'phone-parameters', 'pause-all', 'stop-button']) {
    const { x, width, y, height } = await page.locator(`#${id}`).boundingBox();
    assert.ok(x >= 0 && x + width <= 390 && y + height <= 844 && height >= 44, id);
  }
  await page.locator('#phone-map').click();
  await page.locator('#world').waitFor();
  await page.locator('#phone-values').click();
  await page.locator('[data-port-row="/mock/world/pose"] .value', { hasText: 'heading' }).waitFor();
  await page.locator('#phone-parameters').click();
  const field = page.locator('[data-parameter="/mock/robot/planner/speed"] input');
  await field.fill('2');
  await field.press('Enter');
  await page.locator('#undo:not([disabled])').waitFor();
  await page.locator('#pause-all').click();
  await page.locator('#pause-all', { hasText: 'Go on' }).waitFor();
  assert.equal(application.paused, true);
  await page.locator('#phone-graph').click();
  await inspector.click('/mock/laser');
  await page.locator('#phone-details').click();
  await page.locator('#details h2', { hasText: 'laser' }).waitFor();
  assert.ok(await page.evaluate(() => document.documentElement.scrollWidth) <= 390, 'nothing beside the screen');
});

test('a module is renamed, and its note, its place and the selection go with the name', async (t) => {
  const { application, inspector, page } = await OpenMock(t);
  await inspector.select('/mock/robot/planner');
  await page.locator('#graph').focus();
  await page.keyboard.press('n');
  await page.locator('#note-text').fill('the best');
  await page.keyboard.press('Enter');
  await inspector.closed();
  await page.keyboard.press('F2');
  await page.locator('#new-name').fill('twist');
  await page.keyboard.press('Enter');
  await page.locator('dialog .problem', { hasText: "there is a 'twist'" }).waitFor();
  await page.locator('#new-name').fill('pilot');
  await page.keyboard.press('Enter');
  await inspector.closed();
  await inspector.node('/mock/robot/pilot').locator('.note-on', { hasText: 'the best' }).waitFor();
  await inspector.shows('/mock/robot/pilot');
  assert.equal(application.layout['note /mock/robot/planner'], '');
  assert.equal(await inspector.edges().then((edges) => edges.filter((edge) => edge.includes('/pilot/')).length), 4);
  await page.locator('#undo').click();
  await inspector.node('/mock/robot/planner').locator('.note-on', { hasText: 'the best' }).waitFor();
  await inspector.shows('/mock/robot/planner');
  await page.locator('#redo').click();
  await inspector.node('/mock/robot/pilot').locator('.note-on', { hasText: 'the best' }).waitFor();
});

async function Opened(t, url, options) {
  const inspector = await OpenPage(t, url, options);
  return { inspector, page: inspector.page };
}
