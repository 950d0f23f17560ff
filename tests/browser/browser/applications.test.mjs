// Another application in the network, as a box whose ports are connected as any.

import assert from 'node:assert/strict';
import { readFile, writeFile } from 'node:fs/promises';
import { join } from 'node:path';
import { test } from 'node:test';
import { OpenPage } from '../support/browser.mjs';
import { DemoFile, RunApplication } from '../support/runnel.mjs';

const kFollower = `<application name="follower">
  <load plugin="motion"/>
  <load plugin="signal"/>
  <network/>
  <module name="gate" type="motion/command_gate"/>
  <module name="scale" type="signal/linear"/>
  <module name="other" type="signal/linear"/>
  <connect from="//nobody/twist" to="gate/wanted"/>
  <connect from="//scout/pose.x" to="other/in"/>
  <connect from="other/out" to="scale/in"/>
</application>
`;

async function Drag(page, from, to) {
  // What is drawn anew meanwhile has no box for a moment.
  const boxOf = async (place) => {
    for (;;) {
      await place.waitFor();
      const box = await place.boundingBox();
      if (box !== null) return box;
    }
  };
  const [start, end] = [await boxOf(from), await boxOf(to)];
  await page.mouse.move(start.x + start.width / 2, start.y + start.height / 2);
  await page.mouse.down();
  await page.mouse.move((start.x + end.x) / 2, (start.y + end.y) / 2, { steps: 5 });
  await page.mouse.move(end.x + end.width / 2, end.y + end.height / 2, { steps: 5 });
  await page.mouse.up();
}

/** The planner of the two robots, and one that follows what it wants. */
async function Both(t) {
  const { folder } = await DemoFile(t);
  const planner = join(folder, 'planner.xml');
  await writeFile(planner, await readFile(join(process.env.RUNNEL_XML, 'apps/two_robots_planner.xml'), 'utf8'));
  const follower = join(folder, 'follower.xml');
  await writeFile(follower, kFollower);
  await RunApplication(t, planner);
  const application = await RunApplication(t, follower);
  return { follower, inspector: await OpenPage(t, application.url, { width: 1400, height: 900 }) };
}

test('an edge is drawn between an application elsewhere and a port here', async (t) => {
  const { follower, inspector } = await Both(t);
  const { page } = inspector;
  await page.locator('[data-node="/follower/@planner"]').waitFor();
  const from = page.locator('[data-port="//planner/planner/twist"] circle');
  const to = page.locator('[data-port="/follower/gate/input/wanted"] circle');
  await from.waitFor();
  await page.locator('.box.absent[data-node="/follower/@nobody"]').waitFor();
  await page.locator('.edge.waiting[data-edge="/follower/network/nobody/twist → /follower/gate/input/wanted"]').waitFor({ state: 'attached' });
  await Drag(page, from, to);
  const edge = page.locator('[data-edge="/follower/network/planner/planner/twist → /follower/gate/input/wanted"]');
  await edge.first().waitFor({ state: 'attached' });
  await page.locator('[data-port="/follower/network/planner/planner/twist"][aria-label*="connected"]').waitFor();
  await page.locator('[data-node="/follower/@planner"] .body').click({ position: { x: 60, y: 15 } });
  await page.locator('.far-structure', { hasText: 'surroundings' }).waitFor();
  await inspector.picture('network');
  await page.keyboard.press('Control+z');
  await edge.first().waitFor({ state: 'detached' });
  assert.ok((await readFile(follower, 'utf8')).includes('//nobody/twist'));
});

test('a part of what another application has is connected, and one is shown that waits', async (t) => {
  const { inspector } = await Both(t);
  const { page } = inspector;
  await page.locator('.box.absent[data-node="/follower/@scout"]').waitFor();
  await page.locator('[data-port="//scout/pose"][aria-label*="waiting"]').waitFor();
  const from = page.locator('[data-port="//planner/planner/twist"] circle');
  await from.waitFor();
  await Drag(page, from, page.locator('[data-port="/follower/scale/input/in"] circle'));
  await page.getByRole('option', { name: 'forward' }).click();
  const edge = page.locator('[data-edge="/follower/network/planner/planner/twist → /follower/scale/input/in"]');
  await edge.first().waitFor({ state: 'attached' });
  await inspector.picture('network_part');
  await page.locator('#graph').focus();
  await page.keyboard.press('Control+s');
  await page.locator('.difference .new', { hasText: 'from="//planner/planner/twist.forward" to="scale/in"' }).waitFor();
  assert.equal(await page.locator('.difference .gone').count(), 0, 'what waits is saved as it was');
  await page.keyboard.press('Escape');
  await page.locator('#undo').click();
  await edge.first().waitFor({ state: 'detached' });
  await page.locator('[data-port="//planner/planner/twist"] circle').click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Connect …' }).click();
  await page.locator('.choice-search').fill('scale in');
  await page.getByRole('option', { name: 'scale/in' }).click();
  await page.getByRole('option', { name: 'turn' }).click();
  await edge.first().waitFor({ state: 'attached' });
  await inspector.select('/follower/other/input/in');
  await inspector.details.locator('.awaited', { hasText: '//scout/pose.x' }).getByTitle('Wait no more').click();
  await page.locator('[data-node="/follower/@scout"]').waitFor({ state: 'detached' });
  await page.locator('#undo').click();
  await page.locator('[data-node="/follower/@scout"]').waitFor();
});

test('a port is offered from its menu, and no more', async (t) => {
  const { inspector } = await Both(t);
  const { page } = inspector;
  const port = page.locator('[data-port="/follower/gate/output/allowed"]');
  await page.locator('[data-node="/follower/@planner"]').waitFor();
  await port.locator('circle').click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Offer in the network …' }).click();
  await page.locator('#offer-topic').fill('go there');
  await page.locator('#offer').click();
  await page.locator('.problem', { hasText: 'topic' }).waitFor();
  await page.locator('#offer-topic').fill('/go');
  await page.locator('#offer').click();
  await page.locator('.port.offered[data-port="/follower/gate/output/allowed"]').waitFor();
  await port.locator('circle').click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Offer as /go no more' }).click();
  await page.locator('.port.offered').waitFor({ state: 'detached' });
  await page.keyboard.press('Control+z');
  await page.locator('.port.offered[data-port="/follower/gate/output/allowed"]').waitFor();
});

test('a port takes a topic, by the words that say how', async (t) => {
  const { inspector } = await Both(t);
  const { page } = inspector;
  await page.locator('[data-node="/follower/@planner"]').waitFor();
  await page.locator('[data-port="/follower/gate/input/wanted"] circle').click({ button: 'right' });
  await page.getByRole('menuitem', { name: 'Take from the network …' }).click();
  await page.locator('#take-topic').fill('go there');
  await page.locator('#take').click();
  await page.locator('.problem', { hasText: '/go_there' }).waitFor();
  await page.locator('#take-topic').fill('/cmd_vel');
  await page.locator('#take-as').fill('geometry_msgs/msg/Twist');
  await page.locator('#take-stamp').selectOption('sent');
  await page.locator('#take-exclusive').selectOption('true');
  await page.locator('#take').click();
  const edge = page.locator('[data-edge="/follower/network/cmd_vel → /follower/gate/input/wanted"]');
  await edge.first().waitFor({ state: 'attached' });
  await page.locator('#graph').focus();
  await page.keyboard.press('Control+s');
  for (const said of ['topic="/cmd_vel"', 'as="geometry_msgs/msg/Twist"', 'stamp="sent"', 'exclusive="true"']) {
    await page.locator('.difference .new', { hasText: said }).waitFor();
  }
  await page.keyboard.press('Escape');
  await page.locator('#undo').click();
  await edge.first().waitFor({ state: 'detached' });
});
