// Does what pages ask their readers to do, in an empty folder and one shell, and fails at the first thing that
// is not as they say: node run_pages.mjs FOLDER [--with FOLDER] PAGE …
// --with: a copy of that folder is there from the start, for READMEs speak of what lies beside them.

import { spawnSync } from 'node:child_process';
import { cpSync, mkdirSync, mkdtempSync, readFileSync, rmSync, writeFileSync } from 'node:fs';
import { tmpdir } from 'node:os';
import { basename, join } from 'node:path';
import { fileURLToPath } from 'node:url';
import { BlocksOf, FirstMissing, FirstUnknown } from './page_blocks.mjs';

const kStep = '@@@ step ';
// Whoever reads takes longer to come to the next command than an application to start.
const kStarted = 'for attempt in $(seq 600); do runnel ls >/dev/null 2>&1 && break; sleep 0.1; done\n';
// Less than the test's time-out: whoever waits for ever is named, with what it has printed.
const kPatience = 540_000;  // ms
const [folder, ...words] = process.argv.slice(2);
const beside = words[0] === '--with' ? words.splice(0, 2)[1] : undefined;
const pages = words;

function Fail(place, what, printed = '') {
  console.error(`${place}: ${what}\n${printed}`);
  process.exit(1);
}

// The shell says before each step which one it is; what follows in its output is that step's.
function StepOf(block, index) {
  const step = `echo '${kStep}${index}'\n`;
  if (block.kind === 'run') return step + block.text + (/ &$/m.test(block.text) ? kStarted : '');
  if (block.kind === 'file') return `${step}mkdir -p "$(dirname '${block.name}')"\ncat >'${block.name}' <<'RUNNEL_END_OF_FILE'\n${block.text}RUNNEL_END_OF_FILE\n`;
  if (block.kind === 'from') return `${step}"${process.execPath}" "${fileURLToPath(new URL('has_part.mjs', import.meta.url))}" '${block.name}' <<'RUNNEL_END_OF_FILE'\n${block.text}RUNNEL_END_OF_FILE\n`;
  return '';
}

const blocks = pages.flatMap((page) => BlocksOf(readFileSync(page, 'utf8')).map((block) => ({ ...block, place: `${basename(page)}:${block.line}` })));
for (const page of pages) {
  const unknown = FirstUnknown(readFileSync(page, 'utf8'), basename(page) === 'README.md');
  if (unknown) Fail(`${basename(page)}:${unknown.line}`, 'nobody runs this block; see page_blocks.mjs');
}
if (!blocks.some((block) => block.kind === 'run' || block.kind === 'file')) Fail(pages.join(' '), 'there is nothing to run');

rmSync(folder, { recursive: true, force: true });
mkdirSync(folder, { recursive: true });
if (beside) cpSync(beside, join(folder, basename(beside)), { recursive: true });
const script = `${folder}.sh`;
writeFileSync(script, `set -eu\ntrap 'kill $(jobs -p) 2>/dev/null || true' EXIT\n${blocks.map(StepOf).join('')}`);
// A folder of its own for sockets: only the page's applications are running then.
const sockets = mkdtempSync(join(tmpdir(), 'runnel_pages_'));
const shell = spawnSync('bash', ['-c', `bash '${script}' 2>&1`],
  { cwd: folder, encoding: 'utf8', maxBuffer: 1 << 26, timeout: kPatience, killSignal: 'SIGKILL', env: { ...process.env, XDG_RUNTIME_DIR: sockets } });
rmSync(sockets, { recursive: true, force: true });

const printed = {};
for (const part of shell.stdout.split(kStep).slice(1)) {
  const end = part.indexOf('\n');
  printed[Number(part.slice(0, end))] = part.slice(end + 1);
}
blocks.forEach((block, index) => {
  if (block.kind !== 'output' || printed[index - 1] === undefined) return;
  const missing = FirstMissing(block.text, printed[index - 1]);
  if (missing !== undefined && (shell.status === 0 || printed[index + 1] !== undefined)) {
    Fail(block.place, `is not printed: ${missing}`, printed[index - 1]);
  }
});
if (shell.status !== 0) {
  const last = Math.max(0, ...Object.keys(printed).map(Number));
  Fail(blocks[last].place, `ended with ${shell.status ?? shell.signal}`, printed[last]);
}
console.log(`${blocks.length} blocks of ${pages.length} pages are as they say`);
