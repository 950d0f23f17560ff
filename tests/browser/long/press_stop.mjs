// A person at a page, for bench_stop: node press_stop.mjs URL [saturated]. Says "ready", and presses STOP for each line that it
// is told, by the mouse and by keys in turn; the answer is when the event was, by the machine's wall clock, in ms.

import { createInterface } from 'node:readline';
import { OpenPage } from '../support/browser.mjs';
import { FindBrowser } from '../support/find_browser.mjs';

const [url, saturated] = process.argv.slice(2);
process.env.RUNNEL_BROWSER = FindBrowser();
if (!process.env.RUNNEL_BROWSER) process.exit(77);

const ends = [];
const { page } = await OpenPage({ after: (end) => ends.push(end) }, url, { shows: '#stop-button' });
const button = page.locator('#stop-button');
const { x, y, width, height } = await button.boundingBox();
await page.evaluate(() => {
  for (const kind of ['pointerdown', 'keydown']) {
    addEventListener(kind, (event) => { window.pressed_at = performance.timeOrigin + event.timeStamp; }, true);
  }
});
if (saturated) {
  await page.evaluate(() => {
    const socket = new WebSocket(location.href.replace(/^http/, 'ws'), 'runnel.inspector.v1');
    socket.onopen = () => socket.send(JSON.stringify({ op: 'watch', path: '/planner/output/picture', rate: 60, elements: 1000000 }));
    socket.onmessage = ({ data }) => JSON.parse(data);
  });
}
console.log('ready');
await page.mouse.move(x + width / 2, y + height / 2);
let presses = 0;
for await (const _ of createInterface({ input: process.stdin })) {
  await page.evaluate(() => new Promise((done) => {
    const timer = setInterval(() => {
      if (document.querySelector('#stop-button').dataset.stop !== 'free') return;
      clearInterval(timer);
      done();
    }, 1);
  }));
  if (++presses % 2 === 1) {
    await page.mouse.down();
    page.mouse.up();
  } else {
    await page.keyboard.down('Pause');
    page.keyboard.up('Pause');
  }
  console.log(await page.evaluate(() => window.pressed_at));
}
for (const end of ends) await end().catch(() => {});
process.exit(0);
