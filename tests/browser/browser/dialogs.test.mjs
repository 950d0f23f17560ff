// What dialogs send, and when: once, what they show, and nothing that somebody has not asked for.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import WebSocket from 'ws';
import { OpenMock } from '../support/open_mock.mjs';

/** A change of somebody else. */
function Elsewhere(server, ...changes) {
  return new Promise((done) => {
    const socket = new WebSocket(server.url.replace('http', 'ws'));
    socket.on('open', () => socket.send(JSON.stringify({ op: 'change', request: 1, changes })));
    socket.on('message', (text) => { if (JSON.parse(text).op === 'reply') done(socket.close()); });
  });
}

/** Answers to `op` wait until the test gives them: take() is the next of them. */
function HeldBack(application, op) {
  const waiting = [];
  application.answers[op] = (reply, asked) => waiting.push({ reply, asked });
  return async () => {
    while (waiting.length === 0) await new Promise((done) => { setTimeout(done, 10); });
    return waiting.shift();
  };
}

const Asked = (application, op) => application.asked.filter((each) => each.op === op);
const Refused = (message, more = {}) => ({ ok: false, errors: [{ message, path: null, hint: null }], ...more });

async function Press(page, ...keys) {
  await page.locator('#graph').focus();
  for (const key of keys) await page.keyboard.press(key);
}

test('a swap shows the values that the new module will have, and sends what was typed', async (t) => {
  const { application, inspector, page } = await OpenMock(t, { prepare: (mock) => {
    const planner = mock.catalogue.modules.find(({ type }) => type === 'mock/planner');
    const parameters = planner.parameters.map((each) => (each.name === 'speed' ? { ...each, default: '1.0' } : each));
    mock.catalogue = { ...mock.catalogue, modules: [...mock.catalogue.modules, { ...planner, type: 'mock/fast_planner', parameters }] };
    const path = '/mock/robot/planner/stubborn';
    mock.elements.set(path, { ...mock.elements.get(path), value: 'very' });
  } });
  await inspector.select('/mock/robot/planner');
  await page.locator('#swap').click();
  await page.locator('[data-choice="mock/fast_planner"]').hover();
  await page.locator('.choices .more').click();
  const speed = page.locator('[id="setting:speed"]');
  assert.equal(await speed.inputValue(), '1.0', 'a default is not taken over');
  assert.equal(await page.locator('[id="setting:stubborn"]').inputValue(), 'very', 'what has been set is');
  await page.locator('.settings .parameter', { hasText: 'speed' }).locator('.note', { hasText: 'the old one has 0.4' }).waitFor();
  await speed.fill('0.4');
  await speed.press('Enter');
  await inspector.closed();
  assert.deepEqual(Asked(application, 'change').at(-1).changes[0].settings, { speed: '0.4' });
});

test('what the new module cannot have is shown as it is, and a number without a default is needed', async (t) => {
  const { application, page, inspector } = await OpenMock(t, { prepare: (mock) => {
    const planner = mock.catalogue.modules.find(({ type }) => type === 'mock/planner');
    const others = { speed: { default: '' }, stubborn: { choices: ['mildly', 'much'] } };
    const parameters = planner.parameters.map((each) => ({ ...each, ...others[each.name] }));
    mock.catalogue = { ...mock.catalogue, modules: [...mock.catalogue.modules, { ...planner, type: 'mock/mild_planner', parameters }] };
    for (const [name, value] of [['stubborn', 'very'], ['speed', '0.7']]) {
      const path = `/mock/robot/planner/${name}`;
      mock.elements.set(path, { ...mock.elements.get(path), value });
    }
  } });
  await inspector.select('/mock/robot/planner');
  await page.locator('#swap').click();
  await page.locator('[data-choice="mock/mild_planner"]').hover();
  await page.locator('.choices .more').click();
  const [speed, stubborn] = [page.locator('[id="setting:speed"]'), page.locator('[id="setting:stubborn"]')];
  assert.match(await stubborn.locator('option:checked').textContent(), /^very: not among its choices/);
  await stubborn.selectOption('mildly');
  await speed.fill('');
  await page.locator('.settings .problem', { hasText: 'it has no default' }).waitFor();
  await page.locator('#swap-now').click();
  await page.locator('dialog > .dialog-body > .problem', { hasText: 'speed: it has no default' }).waitFor();
  await speed.fill('0.5');
  await page.locator('#swap-now').click();
  await inspector.closed();
  assert.deepEqual(Asked(application, 'change').at(-1).changes[0].settings, { speed: '0.5', stubborn: 'mildly' });
});

test('a number that is cleared is its default, a text that is cleared is empty, and the fields say so', async (t) => {
  const { application, inspector, page } = await OpenMock(t);
  await Press(page, 'a');
  await page.locator('[data-choice="mock/planner"]').hover();
  await page.locator('.choices .more').click();
  const [speed, stubborn] = [page.locator('[id="setting:speed"]'), page.locator('[id="setting:stubborn"]')];
  await speed.fill('');
  await stubborn.fill('');
  assert.deepEqual([await speed.getAttribute('placeholder'), await stubborn.getAttribute('placeholder')], ['0.4', 'empty']);
  await page.locator('#create').click();
  await inspector.closed();
  assert.deepEqual(Asked(application, 'change').at(-1).changes[0].settings, { stubborn: '' });
});

test('"Save as" without a name saves nothing, by Enter neither', async (t) => {
  const { application, inspector, page } = await OpenMock(t);
  await page.locator('#save-as').click();
  await page.locator('#save-file').fill('  ');
  await page.keyboard.press('Enter');
  await inspector.drawn();
  assert.equal(await page.locator('#save-now').isDisabled(), true);
  await page.locator('#save-file').fill('new.xml');
  await page.keyboard.press('Enter');
  await inspector.closed();
  assert.deepEqual(Asked(application, 'save').map(({ file }) => file), ['new.xml']);
});

test('a file is overwritten only by who was told that it is there', async (t) => {
  const { application, inspector, page } = await OpenMock(t);
  const take = HeldBack(application, 'save');
  await page.locator('#save-as').click();
  await page.locator('#save-file').fill('other.xml');
  await page.keyboard.press('Enter');
  const { reply } = await take();
  await page.locator('#save-file').fill('precious.xml');
  reply(Refused('other.xml is another application', { needs: 'overwrite' }));
  await page.locator('dialog .problem', { hasText: 'other.xml' }).waitFor();
  assert.equal(await page.locator('#save-overwrite').count(), 0);
  await page.locator('#save-file').fill('other.xml');
  await page.keyboard.press('Enter');
  (await take()).reply(Refused('other.xml is another application', { needs: 'overwrite' }));
  await page.locator('#save-overwrite').click();
  const last = await take();
  assert.deepEqual([last.asked.file, last.asked.overwrite], ['other.xml', true]);
  last.reply({ ok: true });
  await inspector.closed();
});

test('Ctrl+S and Enter save, once, and a refusal that comes when the dialog is closed is said', async (t) => {
  const { application, inspector, page } = await OpenMock(t, { prepare: (mock) => {
    mock.answers.preview = (reply) => reply({ ok: true, file: '/mock/robot.xml', before: 'a\n', after: 'b\n' });
  } });
  const take = HeldBack(application, 'save');
  await Press(page, 'Control+s');
  await page.locator('#save-now:focus').waitFor();
  await page.keyboard.press('Enter');
  await page.keyboard.press('Enter');
  const { reply } = await take();
  await page.locator('#save-now[aria-busy=true]').waitFor();
  await inspector.drawn();
  assert.equal(Asked(application, 'save').length, 1);
  await page.keyboard.press('Escape');
  await inspector.closed();
  reply(Refused('no space left on device'));
  await page.locator('.toast.error', { hasText: 'no space left on device' }).waitFor();
});

test('what is written is what was shown, although others change the application meanwhile', async (t) => {
  let [file, after] = ['/mock/robot.xml', 'b\n'];
  const { application, inspector, page } = await OpenMock(t, { prepare: (mock) => {
    mock.answers.preview = (reply) => reply({ ok: true, file, before: 'a\n', after });
  } });
  await page.locator('#save').click();
  await page.locator('.difference .new', { hasText: 'b' }).waitFor();
  after = 'c\n';
  await page.locator('#save-now').click();
  await page.locator('dialog .problem', { hasText: 'changed meanwhile' }).waitFor();
  await page.locator('.difference .new', { hasText: 'c' }).waitFor();
  file = '/mock/other.xml';
  await page.locator('#save-now').click();
  await page.locator('dialog h2', { hasText: 'other.xml' }).waitFor();
  assert.equal(Asked(application, 'save').length, 0);
  await page.locator('#save-now').click();
  await inspector.closed();
  assert.equal(Asked(application, 'save').length, 1);
});

test('one choice makes one module, however long Enter is held', async (t) => {
  const { application, inspector, page } = await OpenMock(t);
  const take = HeldBack(application, 'change');
  await Press(page, 'a');
  await page.locator('.choice-search').fill('filter');
  for (let times = 0; times < 4; ++times) await page.keyboard.down('Enter');
  await page.keyboard.up('Enter');
  await page.keyboard.press('Enter');
  await page.locator('#create').click();
  const { reply } = await take();
  await inspector.drawn();
  assert.deepEqual(Asked(application, 'change').flatMap(({ changes }) => changes.map(({ path }) => path)), ['/mock/filter']);
  reply(Refused('it is full'));
  await page.locator('dialog .problem', { hasText: 'it is full' }).waitFor();
});

test('a press on the scroll bar of a dialog leaves it open, one beside it closes it', async (t) => {
  const { inspector, page } = await OpenMock(t);
  await Press(page, 'a');
  const dialog = page.locator('dialog.wide');
  // As browsers tell of a press on the scroll bar: at the dialog itself.
  await dialog.evaluate((element) => {
    const { right, top } = element.getBoundingClientRect();
    element.dispatchEvent(new PointerEvent('pointerdown', { bubbles: true, clientX: right - 2, clientY: top + 20 }));
  });
  await inspector.drawn();
  assert.equal(await dialog.count(), 1);
  await page.mouse.click(3, 3);
  await inspector.closed();
});

test('Ctrl+S in a dialog is not the browser\'s, and the focus of a menu has an outline', async (t) => {
  const { inspector, page } = await OpenMock(t);
  await Press(page, 'a');
  await page.locator('.choice-search').waitFor();
  assert.ok(await page.locator('.choice-search').evaluate((field) => {
    const key = new KeyboardEvent('keydown', { key: 's', ctrlKey: true, bubbles: true, cancelable: true });
    field.dispatchEvent(key);
    return key.defaultPrevented;
  }));
  await page.keyboard.press('Escape');
  await inspector.closed();
  await inspector.select('/mock/robot/planner');
  await Press(page, 'Shift+F10');
  const item = page.locator('[role="menu"] button:focus');
  await item.waitFor();
  await page.keyboard.press('ArrowDown');
  assert.equal(await item.evaluate((button) => getComputedStyle(button).outlineStyle), 'solid');
});

test('"New group" has the name that was typed', async (t) => {
  const { inspector, page } = await OpenMock(t);
  await Press(page, 'a');
  await page.locator('#new-name').fill('arm');
  await page.getByRole('button', { name: 'New group' }).click();
  await inspector.closed();
  await inspector.node('/mock/arm').waitFor();
  await Press(page, 'a');
  await page.locator('#new-name').fill('left arm');
  await page.getByRole('button', { name: 'New group' }).click();
  await page.locator('dialog .problem', { hasText: 'a name has no blanks' }).waitFor();
  assert.equal(await page.locator('#new-name').inputValue(), 'left arm');
});

test('the answer about conversions opens nothing over what has been opened meanwhile', async (t) => {
  const { application, inspector, page } = await OpenMock(t);
  const take = HeldBack(application, 'conversions');
  const choose = async () => {
    await inspector.select('/mock/robot/twist');
    await Press(page, 'c');
    await page.locator('.choice-search').fill('laser/pose');
    await page.keyboard.press('Enter');
    return take();
  };
  const answer = { ok: true, conversions: [{ part: 'forward', convert: '' }] };
  const first = await choose();
  await page.locator('dialog', { hasText: 'asking the application' }).waitFor();
  await page.keyboard.press('Escape');
  await inspector.closed();
  await Press(page, 'a');
  await page.locator('.choice-search').fill('filter');
  first.reply(answer);
  await page.locator('.toast', { hasText: 'Not connected' }).waitFor();
  assert.equal(await page.locator('.choice-search').inputValue(), 'filter');
  await page.keyboard.press('Escape');
  await inspector.closed();
  (await choose()).reply(answer);
  await page.locator('[data-choice^="forward"]').waitFor();
});

test('a dialog about what another viewer has taken away closes, and says why', async (t) => {
  const { server, inspector, page } = await OpenMock(t);
  await inspector.select('/mock/robot/planner');
  await Press(page, 'Shift+F10');
  await page.getByRole('menuitem', { name: 'Move to thread …' }).waitFor();
  await Elsewhere(server, { change: 'rename', path: '/mock/robot/planner', name: 'thinker' });
  await page.locator('.toast', { hasText: '/mock/robot/planner is gone' }).waitFor();
  await inspector.closed();
  await inspector.select('/mock/robot/thinker');
  await Press(page, 'm');
  await page.locator('.choice-search').waitFor();
  await Elsewhere(server, { change: 'delete', path: '/mock/robot/thinker' });
  await page.locator('.toast', { hasText: '/mock/robot/thinker is gone' }).waitFor();
  await inspector.closed();
});

test('who renames an element is not told that it is gone', async (t) => {
  const { inspector, page } = await OpenMock(t);
  await inspector.select('/mock/laser');
  await Press(page, 'F2');
  await page.locator('#new-name').fill('eye');
  await page.keyboard.press('Enter');
  await inspector.closed();
  await inspector.node('/mock/eye').waitFor();
  assert.equal(await page.locator('.toast', { hasText: 'is gone' }).count(), 0);
});

test('a dialog that cannot be drawn takes nothing else with it', async (t) => {
  const { inspector, page } = await OpenMock(t, { forgive: [/cannot be drawn/], prepare: (mock) => {
    mock.answers.compatible = (reply) => reply({ ok: true, types: [null] });
  } });
  await inspector.select('/mock/robot/planner');
  await page.locator('#swap').click();
  await page.locator('.toast.error', { hasText: 'The dialog cannot be drawn' }).waitFor();
  await inspector.closed();
  await page.locator('body > #robot-stop #stop-button').waitFor();
  await Press(page, '?');
  await page.locator('dialog.help').waitFor();
});

test('a menu lies neither below the STOP of a phone nor out of the screen', async (t) => {
  const { inspector, page } = await OpenMock(t);
  for (const [width, height, y] of [[375, 667, 520], [640, 300, 120]]) {
    await page.setViewportSize({ width, height });
    await inspector.drawn();
    await page.mouse.click(20, y, { button: 'right' });
    const items = page.locator('dialog.menu [role=menuitem]');
    await items.first().waitFor();
    for (const item of await items.all()) {
      await item.scrollIntoViewIfNeeded();
      const isFree = await item.evaluate((button) => {
        const { left, top, bottom } = button.getBoundingClientRect();
        return [top + 3, bottom - 3].every((at) => document.elementFromPoint(left + 40, at) === button);
      });
      assert.equal(isFree, true, `${await item.textContent()} at ${width} x ${height}`);
    }
    await page.keyboard.press('Escape');
    await inspector.closed();
  }
});
