// A person at a page, for bench_stop: node press_stop.mjs URL [saturated]. Says "ready", and presses STOP for each line that it
// is told, by the mouse and by keys in turn; the answer is when the event was, by the machine's wall clock, in ms.

import { connect, createServer } from 'node:net';
import { createInterface } from 'node:readline';
import { OpenPage } from '../support/browser.mjs';
import { FindBrowser } from '../support/find_browser.mjs';

const [url, saturated] = process.argv.slice(2);
process.env.RUNNEL_BROWSER = FindBrowser();
if (!process.env.RUNNEL_BROWSER) process.exit(77);

// The server's side of all but the connection of the STOP is full, and stays so: far more is watched than passes. What passes is
// bounded, or the page would do nothing but read it.
const kPasses = 1000; // octets in a ms

async function Narrow(to) {
  const server = createServer((near) => {
    const far = connect(Number(new URL(to).port), '127.0.0.1');
    let isStop = false;
    near.on('data', (data) => { isStop ||= data.includes('runnel.stop.v1'); far.write(data); });
    far.on('data', (data) => {
      near.write(data);
      if (isStop) return;
      far.pause();
      setTimeout(() => far.resume(), data.length / kPasses);
    });
    for (const [one, other] of [[near, far], [far, near]]) {
      one.setNoDelay(true);
      one.on('error', () => other.destroy());
      one.on('close', () => other.destroy());
    }
  });
  await new Promise((done) => { server.listen(0, '127.0.0.1', done); });
  return `http://127.0.0.1:${server.address().port}/`;
}

const ends = [];
const address = saturated ? await Narrow(url) : url;
const { page } = await OpenPage({ after: (end) => ends.push(end) }, address, { shows: '#stop-button' });
const button = page.locator('#stop-button');
const { x, y, width, height } = await button.boundingBox();
await page.evaluate(() => {
  for (const kind of ['pointerdown', 'keydown']) {
    addEventListener(kind, (event) => { window.pressed_at = performance.timeOrigin + event.timeStamp; }, true);
  }
});
if (saturated) {
  // Beside the page's own thread, which no reader of so much would leave any time.
  await page.evaluate(() => {
    const reads = `const socket = new WebSocket(${JSON.stringify(location.href.replace(/^http/, 'ws'))}, 'runnel.inspector.v1');
      socket.onopen = () => socket.send(JSON.stringify({ op: 'watch', path: '/planner/output/picture', rate: 60, elements: 1000000 }));`;
    window.reader = new Worker(URL.createObjectURL(new Blob([reads], { type: 'text/javascript' })));
  });
}
const UntilShown = (state) => page.evaluate((wanted) => new Promise((done) => {
  const timer = setInterval(() => {
    if (document.querySelector('#stop-button').dataset.stop !== wanted) return;
    clearInterval(timer);
    done();
  }, 1);
}), state);
console.log('ready');
await page.mouse.move(x + width / 2, y + height / 2);
let presses = 0;
for await (const _ of createInterface({ input: process.stdin })) {
  await UntilShown('free');
  if (++presses % 2 === 1) {
    await page.mouse.down();
    page.mouse.up();
  } else {
    await page.keyboard.down('Pause');
    page.keyboard.up('Pause');
  }
  // What the page has not heard of after a second it asks for once more, and that may come after the release.
  await UntilShown('in_force');
  console.log(await page.evaluate(() => window.pressed_at));
}
for (const end of ends) await end().catch(() => {});
process.exit(0);
