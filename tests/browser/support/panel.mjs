// The operator's panel, and what a person does at it.

import { connect, createServer } from 'node:net';
import { Cleanup } from './cleanup.mjs';
import { OpenPage } from './browser.mjs';

/** `url`: of the application. */
export async function OpenPanel(t, url, options) {
  const opened = await OpenPage(t, new URL('/panel', url).href, { width: 1400, height: 860, shows: '[data-widget]', ...options });
  return new Panel(opened);
}

class Panel {
  constructor(opened) {
    this.page = opened.page;
    this.drawn = () => opened.drawn();
    this.until = (...all) => opened.until(...all);
    this.picture = (name) => opened.picture(name);
  }

  widget(id) {
    return this.page.locator(`[data-widget="${id}"]`);
  }

  /** Presses the stick, and pushes it: x to the right, y up, 1 is as far as it goes. */
  async push(x, y) {
    const pad = this.page.locator('[data-stick]').first();
    await this.drawn();
    const box = await pad.boundingBox();
    const [middleX, middleY, radius] = [box.x + box.width / 2, box.y + box.height / 2, box.width / 2 * 0.72];
    await this.page.mouse.move(middleX, middleY);
    await this.page.mouse.down();
    await this.page.mouse.move(middleX + x * radius, middleY - y * radius, { steps: 3 });
  }

  letGo() {
    return this.page.mouse.up();
  }

  /** Waits until one of these is said of the joystick: mine, free, set, lost, stopped, driven. */
  drives(...who) {
    return this.widget('joystick').locator(who.map((one) => `[data-driving="${one}"]`).join()).waitFor();
  }

  /** Waits until a gauge shows a number between two. */
  shows(id, least, most) {
    return this.until(`${id} from ${least} to ${most}`, ([name, from, to]) => {
      const text = document.querySelector(`[data-widget="${name}"] [data-gauge]`)?.dataset.gauge;
      return text !== '' && Number(text) >= from && Number(text) <= to;
    }, [id, least, most]);
  }

  /**
   * Has `panel` begin to drive (and end before it begins again) until the robot turns here as it should: a machine that
   * is busy with other tests may itself leave a page without a turn for so long that the server takes it for dead, or without an
   * answer for so long that the page lets go.
   */
  async turns(least, most, { begin, end }) {
    for (let left = 10; ; --left) {
      await begin();
      const seen = await this.page.waitForFunction(([from, to]) => {
        const text = document.querySelector('[data-widget="turning"] [data-gauge]')?.dataset.gauge;
        if (text !== '' && Number(text) >= from && Number(text) <= to) return 'turns';
        return document.querySelector('#hand-banner.lost') ? 'lost' : false;
      }, [least, most], { timeout: left > 0 ? 6000 : 60000 }).catch((error) => { if (left === 0) throw error; });
      if (await seen?.jsonValue() === 'turns') return;
      await end();
    }
  }

  /** Nothing moves any more. */
  async rests() {
    await this.shows('speed', -0.002, 0.002);
    await this.shows('turning', -0.002, 0.002);
  }
}

/** A network between a page and its application, which can be stuck (nothing passes, and nothing is closed) or drop its connections. */
export async function Network(t, url) {
  const target = Number(new URL(url).port);
  const sockets = new Set();
  let isStuck = false;
  const server = createServer((near) => {
    const far = connect(target, '127.0.0.1');
    for (const [from, to] of [[near, far], [far, near]]) {
      sockets.add(from);
      from.pipe(to);
      if (isStuck) from.pause();
      from.on('error', () => to.destroy());
      from.on('close', () => { sockets.delete(from); to.destroy(); });
    }
  });
  await new Promise((resolve) => { server.listen(0, '127.0.0.1', resolve); });
  Cleanup(t, () => {
    for (const socket of sockets) socket.destroy();
    server.close();
  });
  return {
    url: `http://127.0.0.1:${server.address().port}/`,
    stick() { isStuck = true; for (const socket of sockets) socket.pause(); },
    loosen() { isStuck = false; for (const socket of sockets) socket.resume(); },
    drop() { for (const socket of sockets) socket.destroy(); },
  };
}
