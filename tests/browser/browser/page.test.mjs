// What the page does by itself: keys, colours, log, errors, dialogs. The application is a mock.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenMock as Robot } from '../support/open_mock.mjs';

const SelectedName = (page) => page.locator('#details h2').textContent();

test('arrow keys walk through the graph, and a screen reader is told where one is', async (t) => {
  const { inspector, page } = await Robot(t);
  await page.keyboard.press('g');
  assert.equal(await page.evaluate(() => document.activeElement.id), 'graph');
  await page.keyboard.press('ArrowRight');
  assert.equal(await SelectedName(page), 'world');
  await page.keyboard.press('ArrowRight');
  assert.equal(await SelectedName(page), 'laser');
  await page.locator('.graph [role="status"]', { hasText: 'laser, module mock/laser, 1 input, 1 output' }).waitFor({ state: 'attached' });
  assert.equal(await page.locator('#graph').getAttribute('aria-activedescendant'), 'node:/mock/laser');
  await page.keyboard.press('Shift+ArrowDown');
  await page.keyboard.press('Shift+ArrowDown');
  assert.equal(await SelectedName(page), 'scan');
  await page.keyboard.press('ArrowRight');
  assert.equal(await SelectedName(page), 'planner');
  await page.keyboard.press('ArrowUp');
  assert.equal(await SelectedName(page), 'robot', 'the group around it');
  await page.keyboard.press('Enter');
  await inspector.node('/mock/robot/planner').waitFor({ state: 'detached' });
  await page.keyboard.press('Escape');
  assert.equal(await SelectedName(page), 'robot', 'the application, which has the same name');
});

test('everything that can be pressed can be reached by the tab key, and shows that it is', async (t) => {
  const { page } = await Robot(t);
  await page.locator('#pause').focus();
  const reached = new Set();
  for (let i = 0; i < 60; ++i) {
    await page.keyboard.press('Tab');
    const found = await page.evaluate(() => {
      const element = document.activeElement;
      const style = getComputedStyle(element);
      return { id: element.id || element.getAttribute('aria-label'), outline: style.outlineStyle !== 'none' || element === document.body };
    });
    assert.ok(found.outline, `${found.id} shows its focus`);
    reached.add(found.id);
  }
  for (const id of ['step', 'speed', 'add', 'save', 'search', 'theme', 'help', 'graph', 'tab-plots', 'details']) {
    assert.ok(reached.has(id) || id === 'details', `${id} among ${[...reached].join(', ')}`);
  }
});

test('every button, field and picture has a name', async (t) => {
  const { inspector, page } = await Robot(t);
  await inspector.select('/mock/robot/planner');
  const nameless = await page.evaluate(() => [...document.querySelectorAll('button, input, select, [role]')].filter((element) => {
    const label = element.getAttribute('aria-label') || element.textContent.trim() || element.title ||
      (element.id && document.querySelector(`label[for="${CSS.escape(element.id)}"]`)?.textContent) || element.closest('label')?.textContent;
    return !label && !['presentation', 'status', 'group', 'tabpanel'].includes(element.getAttribute('role'));
  }).map((element) => element.outerHTML.slice(0, 120)));
  assert.deepEqual(nameless, []);
});

test('light and dark have enough contrast for all texts', async (t) => {
  for (const colours of ['light', 'dark']) {
    const { inspector, page } = await Robot(t, { colours });
    await inspector.select('/mock/robot/planner');
    const weak = await page.evaluate(WeakTexts);
    assert.deepEqual(weak, [], colours);
  }
});

test('the colours are chosen by hand, and kept', async (t) => {
  const { page } = await Robot(t, { colours: 'light' });
  const ground = () => page.evaluate(() => getComputedStyle(document.body).backgroundColor);
  const light = await ground();
  await page.locator('#theme').click(); // light, whatever the system wants
  await page.locator('#theme').click(); // dark
  assert.notEqual(await ground(), light);
  await page.reload();
  await page.locator('[data-node]').first().waitFor();
  assert.notEqual(await ground(), light);
});

test('only Enter sets a value: Escape and leaving the field drop what was typed, and say so', async (t) => {
  const { inspector, page } = await Robot(t);
  await inspector.select('/mock/robot/planner');
  const field = inspector.parameter('speed');
  const before = await field.inputValue();
  const typed = before === '2' ? '3' : '2';
  for (const leave of [() => field.press('Escape'), () => page.locator('#graph').focus()]) {
    await field.fill(typed);
    await leave();
    await page.locator('[data-parameter$="/speed"] .dropped', { hasText: `“${typed}” was not set` }).waitFor();
    assert.equal(await field.inputValue(), before);
  }
  await field.fill(typed);
  await field.press('Enter');
  await inspector.until('the value', (wanted) => document.querySelector('[data-parameter$="/speed"] input').value === wanted &&
    !document.querySelector('[data-parameter$="/speed"].edited'), typed);
  assert.equal(await page.locator('[data-parameter$="/speed"] .dropped').count(), 0);
});

test('what the application says of a wrong value stands at its field', async (t) => {
  const { inspector, page } = await Robot(t);
  await inspector.select('/mock/robot/planner');
  const field = inspector.parameter('stubborn');
  await field.fill('yes');
  await field.press('Enter');
  await page.locator('[data-parameter$="/stubborn"] .problem', { hasText: "'yes' is not to its taste; try 7" }).waitFor();
  await field.press('Escape');
  assert.equal(await field.inputValue(), 'no');
});

test('switches and choices set at once', async (t) => {
  const { application, inspector, page } = await Robot(t);
  await inspector.select('/mock/robot/planner');
  await inspector.parameter('careful').click();
  await inspector.parameter('direction').selectOption('right');
  await page.locator('[aria-label="Set direction back to left"]').waitFor();
  assert.equal(application.elements.get('/mock/robot/planner/careful').value, 'true');
  assert.equal(application.elements.get('/mock/robot/planner/direction').value, 'right');
});

test('a connection is pulled, and looks like it, where the output can be', async (t) => {
  const { inspector, page } = await Robot(t);
  const choose = async (from, to) => {
    const edge = page.locator(`[data-edge="${from} → ${to}"]`);
    const { x, y } = await edge.evaluate((path) => {
      const { x, y } = path.getPointAtLength(path.getTotalLength() / 2).matrixTransform(path.getScreenCTM());
      return { x, y };
    });
    await page.mouse.click(x, y);
    await inspector.details.locator('#disconnect').waitFor();
    return edge;
  };
  await choose('/mock/world/pose', '/mock/laser/pose');
  assert.equal(await page.locator('#pull').count(), 0);
  const edge = await choose('/mock/laser/scan', '/mock/robot/scan');
  await page.locator('#pull', { hasText: 'Pull' }).click();
  await page.locator('#pull', { hasText: 'Push' }).waitFor();
  assert.match(await edge.getAttribute('class'), /pulled/);
  await inspector.details.locator('.facts dt', { hasText: 'pulled' }).waitFor();
  await page.locator('#pull').click();
  await page.locator('#pull', { hasText: 'Pull' }).waitFor();
  assert.doesNotMatch(await edge.getAttribute('class'), /pulled/);
});

test('how many values wait for a reader is seen and changed at the connection', async (t) => {
  const { application, inspector, page } = await Robot(t);
  await inspector.select('/mock/robot/planner/scan');
  await inspector.details.locator('.connections button', { hasText: 'newest value' }).click();
  await page.locator('#queue').fill('5');
  await page.locator('#queue').press('Escape');
  assert.equal(await page.locator('#queue').inputValue(), '0');
  await page.locator('#queue').fill('5');
  await page.locator('#queue').press('Enter');
  await page.locator('#on-full').selectOption('drop_newest');
  await inspector.until('both', () => document.querySelector('#queue')?.value === '5' && document.querySelector('#on-full')?.value === 'drop_newest');
  const { queue, on_full: onFull } = application.connections.find(({ to }) => to === '/mock/robot/planner/scan');
  assert.deepEqual([queue, onFull], [5, 'drop_newest']);
});

test('what has no text form says so, and parameters say what they are for', async (t) => {
  const { inspector, page } = await Robot(t);
  await inspector.select('/mock/world');
  await page.locator('[data-port-row="/mock/world/scene"] .value', { hasText: 'has no text form' }).waitFor();
  await inspector.select('/mock/robot/planner');
  await page.locator('[data-parameter$="/speed"] .description', { hasText: 'along the way' }).waitFor();
});

test('the log is filtered, and faults of changes come up as toasts', async (t) => {
  const { application, inspector, page } = await Robot(t);
  await page.locator('#tab-log').click();
  await page.locator('#log li', { hasText: 'the mock began' }).waitFor();
  application.change(['set /mock/robot/planner/speed 1'], 'set speed');
  await inspector.select('/mock/robot/planner');
  await inspector.parameter('speed').fill('2');
  await inspector.parameter('speed').press('Enter');
  await page.locator('#log li', { hasText: 'set /mock/robot/planner/speed 2' }).waitFor();
  await page.locator('#log-filter').fill('began');
  await inspector.until('one entry', () => document.querySelectorAll('#log li').length === 1);
  application.elements.delete('/mock/laser'); // behind the page's back
  await inspector.select('/mock/laser');
  await page.locator('#delete').click();
  await page.locator('#confirm-yes').click();
  await page.locator('.toast.error', { hasText: "there is no '/mock/laser'" }).waitFor();
  await page.locator('.toast .remove').click();
  assert.equal(await page.locator('.toast').count(), 0);
});

test('what is found stays for whoever comes back to the search at once', async (t) => {
  const { page } = await Robot(t);
  await page.locator('[data-node]').first().waitFor();
  await page.clock.install();
  await page.locator('#search').fill('laser');
  await page.evaluate(() => { document.getElementById('graph').focus(); document.getElementById('search').focus(); });
  await page.clock.runFor(300); // twice as long as what is found outlives the focus
  assert.equal(await page.locator('#search-found .path', { hasText: '/mock/laser' }).count() > 0, true);
  await page.locator('#graph').focus();
  await page.locator('#search-found').waitFor({ state: 'detached' });
});

test('plots pause, and take away what is not wanted any more', async (t) => {
  const { inspector, page } = await Robot(t);
  await inspector.select('/mock/world/pose');
  for (const field of ['x', 'y']) await page.locator(`[data-field="${field}"] .plot-this`).click();
  assert.equal(await page.locator('.plot').count(), 1, 'the same unit, the same plot');
  assert.equal(await page.locator('.legend').count(), 2);
  await page.locator('#plot-pause').click();
  await page.locator('#plot-pause[aria-pressed="true"]').waitFor();
  await page.locator('[data-field="x"] .plot-this').click();
  await inspector.until('one curve', () => document.querySelectorAll('.legend').length === 1);
  await page.locator('[aria-label="Close the plot"]').click();
  await inspector.until('none', () => document.querySelectorAll('.plot').length === 0);
});

test('the map is drawn, moves and grows, and layers can be left out', async (t) => {
  const { inspector, page } = await Robot(t);
  const painted = () => page.evaluate(() => {
    const canvas = document.querySelector('#world canvas');
    const copy = Object.assign(document.createElement('canvas'), { width: canvas.width, height: canvas.height });
    const context = copy.getContext('2d', { willReadFrequently: true });
    context.drawImage(canvas, 0, 0);
    const { data } = context.getImageData(0, 0, canvas.width, canvas.height);
    const colours = new Set();
    for (let i = 0; i < data.length; i += 4) colours.add(`${data[i] >> 4} ${data[i + 1] >> 4} ${data[i + 2] >> 4}`);
    return colours.size;
  });
  await page.locator('.goal').waitFor();
  const before = await painted();
  await page.locator('[aria-label="Layers"]').click();
  for (const box of await page.locator('.layers input').all()) await box.click();
  await page.locator('.goal').waitFor({ state: 'detached' });
  await inspector.drawn();
  assert.ok(before > 8, `${before} colours`);
  assert.ok(await painted() < before / 2, 'fewer colours without layers');
  await page.locator('[aria-label="Large map"]').click();
  await page.locator('.main #world').waitFor();
  await page.locator('.side #graph').waitFor();
});

test('a key lists all keys', async (t) => {
  const { page } = await Robot(t);
  await page.keyboard.press('?');
  await page.locator('dialog', { hasText: 'Ctrl + Shift + Z' }).waitFor();
  await page.keyboard.press('Escape');
  await page.locator('dialog').waitFor({ state: 'detached' });
});

/** Texts whose contrast to what is behind them is less than 4.5; runs in the page. */
function WeakTexts() {
  const canvas = document.createElement('canvas').getContext('2d', { willReadFrequently: true });
  const numbers = (colour) => {
    canvas.clearRect(0, 0, 1, 1);
    canvas.fillStyle = colour;
    canvas.fillRect(0, 0, 1, 1);
    return [...canvas.getImageData(0, 0, 1, 1).data];
  };
  const light = ([r, g, b]) => [r, g, b].map((value) => value / 255)
    .map((value) => (value <= 0.03928 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4))
    .reduce((sum, value, index) => sum + value * [0.2126, 0.7152, 0.0722][index], 0);
  const behind = (element) => {
    for (let at = element; at; at = at.parentElement) {
      const [r, g, b, a] = numbers(getComputedStyle(at).backgroundColor);
      if (a > 250) return [r, g, b];
    }
    return [255, 255, 255];
  };
  const weak = [];
  for (const element of document.querySelectorAll('body *')) {
    const hasText = [...element.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim() !== '');
    const isSeen = element.getClientRects().length > 0 && !element.closest('.unseen, :disabled, noscript, option');
    if (!hasText || !isSeen) continue;
    const style = getComputedStyle(element);
    const isDrawn = element instanceof SVGElement;
    const ground = isDrawn && element.closest('.box') && !element.matches('.rate')
      ? numbers(getComputedStyle(element.closest('.box').querySelector('.body')).fill).slice(0, 3) : behind(element);
    const [a, b] = [light(numbers(isDrawn ? style.fill : style.color)), light(ground)].sort((x, y) => y - x);
    const contrast = (a + 0.05) / (b + 0.05);
    if (contrast < 4.5) weak.push(`${contrast.toFixed(2)} ${element.className.baseVal ?? element.className} '${element.textContent.trim().slice(0, 30)}'`);
  }
  return [...new Set(weak)];
}
