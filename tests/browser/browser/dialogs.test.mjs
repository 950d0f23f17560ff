// What dialogs send, and when: once, what they show, and nothing that somebody has not asked for.

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { OpenMock } from '../support/open_mock.mjs';

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
