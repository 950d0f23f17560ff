// Where Chromium is, if it is here.

import { existsSync } from 'node:fs';
import { delimiter, join } from 'node:path';

const kBrowsers = ['chromium', 'chromium-browser', 'google-chrome'];

export function FindBrowser() {
  const folders = (process.env.PATH ?? '').split(delimiter);
  return process.env.RUNNEL_BROWSER ?? kBrowsers.flatMap((name) => folders.map((folder) => join(folder, name))).find(existsSync);
}
