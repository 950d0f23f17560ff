// How long it takes from what ends a hold, in a real browser, until the port that was driven has its safe value, at a real robot:
// node holding.mjs [--tries 100] [--only TEXT]. A table in milliseconds. The cause is the browser's event, by its own time stamp;
// what has no event (a gamepad, which is none but looks like one) is when it is done. The end is the stamp that the robot gave
// the safe value. A headless browser hides no page: that the page is told, with all that a browser would tell it.

import { mkdtemp, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { parseArgs } from 'node:util';
import { FindBrowser } from '../support/find_browser.mjs';
import { HoldWatcher } from './hold_watcher.mjs';

const { values: asked } = parseArgs({ options: { tries: { type: 'string', default: '100' }, only: { type: 'string', default: '' } } });
process.env.RUNNEL_BROWSER = FindBrowser() ?? '';
if (!process.env.RUNNEL_BROWSER) throw new Error('chromium is not here');
const { OpenPanel } = await import('../support/panel.mjs');
const { RunApplication } = await import('../support/runnel.mjs');

const kTwist = '/holding/drive/input/twist';
const kNumber = '/holding/arm/input/in';
const kText = `<application name="holding" thread="control">
  <load plugin="simulation"/>
  <load plugin="motion"/>
  <load plugin="signal"/>
  <clock type="real"/>
  <thread name="control" period="10ms"/>
  <module name="world" type="simulation/world">
    <parameter name="world" value="${process.env.RUNNEL_XML}/worlds/rooms.xml"/>
  </module>
  <module name="drive" type="motion/differential_drive"/>
  <module name="arm" type="signal/low_pass"/>
  <module name="wish" type="signal/low_pass"/>
  <driving port="drive/twist"/>
  <driving port="arm/in" safe="0" command="velocity"/>
  <connect from="world/twist" to="drive/twist"/>
  <connect from="wish/out" to="arm/in"/>
  <connect from="arm/out" to="wish/in"/>
  <connect from="drive/wheels" to="world/wheels"/>
</application>
`;
const kDrives = { target: kTwist, forward: 0.1, turn: 0.1 };
const kWidgets = [
  { id: 'joystick', kind: 'joystick', x: 0, y: 0, w: 4, h: 6, ...kDrives }, { id: 'keys', kind: 'keys', x: 4, y: 0, w: 3, h: 4, ...kDrives },
  { id: 'gamepad', kind: 'gamepad', x: 7, y: 0, w: 3, h: 4, ...kDrives },
  { id: 'button', kind: 'button', x: 10, y: 0, w: 2, h: 4, target: kTwist, pressed: '{forward: 0.1}', held: true },
  { id: 'slider', kind: 'slider', x: 0, y: 6, w: 4, h: 4, target: kNumber, minimum: 0, maximum: 1 },
];
const kCauses = ['keydown', 'keyup', 'pointerdown', 'pointerup', 'pointercancel', 'focusout', 'blur', 'visibilitychange'];
const kPad = (pressed) => ({ connected: true, index: 0, id: 'Pad', mapping: 'standard', axes: [0, -1, 0, 0],
  buttons: Array.from({ length: 17 }, (_, at) => ({ pressed: at === pressed })) });

const ends = [];
const t = { after: (end) => ends.push(end) };
const folder = await mkdtemp(join(tmpdir(), 'runnel_holding_'));
await writeFile(join(folder, 'holding.xml'), kText);
await writeFile(join(folder, 'holding.panel.json'), JSON.stringify({ panel: 1, widgets: kWidgets }));
process.env.XDG_RUNTIME_DIR = folder;
const robot = await RunApplication(t, join(folder, 'holding.xml'), { options: ['--quiet'] });
const watcher = await HoldWatcher.Connect(robot.url, [kTwist, kNumber]);
const panel = await OpenPanel(t, robot.url, { touch: true, shows: '[data-widget="slider"]', forgive: [/./] });
const { page } = panel;
const { keyboard, mouse } = page;
const debug = await page.context().newCDPSession(page);
await page.addInitScript(([first, causes]) => {
  window.pads = first;
  navigator.getGamepads = () => window.pads;
  window.at = {};
  const note = ({ type, timeStamp }) => { window.at[type] ??= performance.timeOrigin + timeStamp; };
  for (const each of causes) addEventListener(each, note, true);
}, [[kPad(-1)], kCauses]);
async function Reload() {
  await page.reload();
  await page.locator('.gamepad-name', { hasText: 'Pad' }).waitFor();
  await panel.drawn();
}
await Reload();

await debug.send('Emulation.setFocusEmulationEnabled', { enabled: false });
const other = await page.context().newPage(); // which is looked at instead
await page.bringToFront();

const middle = async (locator, part = 0.5) => {
  const { x, y, width, height } = await locator.boundingBox();
  return { x: x + width * part, y: y + height / 2 };
};
const stick = await middle(page.locator('[data-stick]').first());
const button = page.locator('[data-widget="button"] .push-button');
const slider = page.getByRole('slider');
const finger = (id, dx, dy) => ({ id, x: stick.x + dx, y: stick.y + dy });
const touch = (type, ...touchPoints) => debug.send('Input.dispatchTouchEvent', { type, touchPoints });
const pads = (...all) => page.evaluate((now) => { window.pads = now; return performance.timeOrigin + performance.now(); }, all);
const leave = () => other.bringToFront();
const come = async () => { await page.bringToFront(); await page.waitForFunction(() => document.hasFocus()); };
const hide = () => page.evaluate(() => {
  Object.defineProperty(document, 'hidden', { value: true, configurable: true });
  document.dispatchEvent(new Event('visibilitychange'));
});
const show = () => page.evaluate(() => { delete document.hidden; document.dispatchEvent(new Event('visibilitychange')); });

const keys = { begin: () => keyboard.down('w'), after: () => keyboard.up('w') };
const push = { begin: () => touch('touchStart', finger(0, 0, -30)), after: () => touch('touchEnd').catch(() => {}) };
const arrow = { begin: async () => { await page.locator('[data-stick]').first().focus(); await keyboard.down('ArrowUp'); },
  after: () => keyboard.up('ArrowUp') };
const press = { begin: async () => { const { x, y } = await middle(button); await mouse.move(x, y); await mouse.down(); }, after: () => mouse.up() };
const space = { begin: async () => { await button.focus(); await keyboard.down(' '); }, after: () => keyboard.up(' ') };
const drag = { port: kNumber, after: () => mouse.up(), begin: async () => {
  const [from, to] = [await middle(slider, 0.1), await middle(slider, 0.6)];
  await mouse.move(from.x, from.y);
  await mouse.down();
  await mouse.move(to.x, to.y, { steps: 3 });
} };
const step = { port: kNumber, begin: async () => { await slider.focus(); await keyboard.down('ArrowRight'); }, after: () => keyboard.up('ArrowRight') };
const shoulder = { begin: async () => { await pads(kPad(-1)); await page.waitForTimeout(60); await pads(kPad(6)); }, after: () => pads(kPad(-1)) };
const elsewhere = () => page.locator('#edit').focus();

const kAnyhow = [
  { name: 'focus lost', end: leave, by: 'blur', back: come },
  { name: 'page hidden', end: hide, by: 'visibilitychange', back: show },
];
const Anyhow = (name, hold) => kAnyhow.map(({ back, ...each }) => (
  { ...hold, ...each, name: `${name}: ${each.name}`, after: async () => { await back(); await hold.after(); } }));

/** `by`: the event that counts; without it `end` says when it was. */
const kRows = [
  { name: 'keys: key up', ...keys, end: () => keyboard.up('w'), by: 'keyup' },
  ...['Control', 'Alt', 'Meta'].map((modifier) => ({ name: `keys: ${modifier} comes down`, begin: keys.begin,
    end: () => keyboard.down(modifier), by: 'keydown', after: async () => { await keyboard.up('w'); await keyboard.up(modifier); } })),
  { name: 'keys: key up under Shift', begin: async () => { await keyboard.down('w'); await keyboard.down('Shift'); },
    end: () => keyboard.up('w'), by: 'keyup', after: () => keyboard.up('Shift') },
  ...Anyhow('keys', keys),
  { name: 'stick: finger up', ...push, end: () => touch('touchEnd'), by: 'pointerup' },
  { name: 'stick: pointer cancelled', ...push, end: () => touch('touchCancel'), by: 'pointercancel' },
  { name: 'stick: second finger', ...push, end: () => touch('touchStart', finger(0, 0, -30), finger(1, 20, 20)), by: 'pointerdown' },
  { name: 'stick: arrow key up', ...arrow, end: () => keyboard.up('ArrowUp'), by: 'keyup' },
  { name: 'stick: focus goes elsewhere', ...arrow, end: elsewhere, by: 'focusout' },
  ...Anyhow('stick', push),
  { name: 'button: pointer up', ...press, end: () => mouse.up(), by: 'pointerup' },
  { name: 'button: key up', ...space, end: () => keyboard.up(' '), by: 'keyup' },
  { name: 'button: focus goes elsewhere', ...space, end: elsewhere, by: 'focusout' },
  ...Anyhow('button', press),
  { name: 'slider: pointer up', ...drag, end: () => mouse.up(), by: 'pointerup' },
  { name: 'slider: key up', ...step, end: () => keyboard.up('ArrowRight'), by: 'keyup' },
  { name: 'slider: focus goes elsewhere', ...step, end: elsewhere, by: 'focusout' },
  ...Anyhow('slider', drag),
  { name: 'gamepad: shoulder released', ...shoulder, end: () => pads(kPad(-1)) },
  { name: 'gamepad: unplugged', ...shoulder, end: () => pads(null) },
  ...Anyhow('gamepad', shoulder),
];

/** A machine that is busy may itself have a hold refused, or ended at once, as answers come too late: it is begun anew. */
async function Begin(port, begin, after) {
  for (let left = 5; ; --left) {
    await begin();
    try {
      return await watcher.until(port, true, 2000);
    } catch (error) {
      if (left === 0) throw error;
    }
    await after();
    await Reload();
  }
}

async function Try({ port = kTwist, begin, end, by, after }) {
  await Begin(port, begin, after);
  await page.evaluate((name) => { delete window.at[name]; }, by);
  const done = await end();
  const safe = await watcher.until(port, false);
  const at = by ? await page.evaluate((name) => window.at[name], by) : done;
  await after();
  await panel.drawn();
  if (at === undefined) throw new Error(`no '${by}' came`);
  return safe - at;
}

const At = (times, part) => times[Math.min(times.length - 1, Math.floor(times.length * part))].toFixed(1).padStart(9);
console.log(`${'from the end of a hold to the safe value (ms)'.padEnd(56)} ${'tries'.padStart(6)} ${'p50'.padStart(9)} ${'p99'.padStart(9)} ${'max'.padStart(9)}`);
let failed = 0;
for (const row of kRows.filter(({ name }) => name.includes(asked.only))) {
  const times = [];
  try {
    while (times.length < Number(asked.tries)) times.push(await Try(row));
    times.sort((a, b) => a - b);
    console.log(`${row.name.padEnd(56)} ${String(times.length).padStart(6)} ${At(times, 0.5)} ${At(times, 0.99)} ${At(times, 1)}`);
  } catch (error) {
    failed += 1;
    console.log(`${row.name.padEnd(56)} FAILED after ${times.length} tries: ${error.message.split('\n')[0]}`);
    await row.after().catch(() => {});
  }
}
watcher.close();
for (const end of ends.reverse()) await end().catch(() => {});
await rm(folder, { recursive: true, force: true });
process.exit(failed > 0 ? 1 : 0);
