// Runs one file of tests, in the folder of the build tree that has their packages; exit code 77 where
// something that they need is missing: node run_test.mjs unit|browser <file>

import { spawnSync } from 'node:child_process';
import { existsSync } from 'node:fs';
import { FindBrowser } from './support/find_browser.mjs';

const [kind, file] = process.argv.slice(2);

function Skip(reason) {
  console.log(`skipped: ${reason}`);
  process.exit(77);
}

if (!existsSync(file)) Skip('npm could not get the packages of the tests; build again with a network');
const environment = { ...process.env };
if (kind === 'browser') {
  environment.RUNNEL_BROWSER = FindBrowser() ?? '';
  if (!environment.RUNNEL_BROWSER) Skip('chromium is not here (apt-get install chromium)');
}
// A network of its own, in which there is nothing but the loopback interface, so that no other test is heard; where the system
// permits none, a domain that is likely to be nobody else's (tests/support/own_network.h does the same).
const kOwnNetwork = ['--net', 'sh', '-c', 'ip link set lo up && exec "$0" "$@"'];
const has_own_network = kind === 'browser' && spawnSync('unshare', [...kOwnNetwork, 'true'], { stdio: 'ignore' }).status === 0;
environment.ROS_DOMAIN_ID = String(has_own_network ? 0 : 1 + process.pid % 100);
const command = [process.execPath, '--enable-source-maps', '--test', file];
const [program, ...words] = has_own_network ? ['unshare', ...kOwnNetwork, ...command] : command;
const run = spawnSync(program, words, { stdio: 'inherit', env: environment });
process.exit(run.status ?? 1);
