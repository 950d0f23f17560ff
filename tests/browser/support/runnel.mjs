// A real application for tests: `runnel run --inspect`.

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { mkdtemp, readFile, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { Cleanup } from './cleanup.mjs';

/** Starts an application file, which is ended after the test. {url, port, ended, output(), stop(), freeze(), thaw()} */
export async function RunApplication(t, file, { port = 0, options = [] } = {}) {
  const process_ = spawn(process.env.RUNNEL_PROGRAM, ['run', file, `--inspect=${port}`, ...options], { stdio: ['ignore', 'pipe', 'pipe'] });
  let output = '';
  const ended = new Promise((resolve) => { process_.on('exit', (code, signal) => resolve(code ?? signal)); });
  const url = await new Promise((resolve, reject) => {
    const onData = (data) => {
      output += data;
      const found = output.match(/http:\/\/\S+/);
      if (found) resolve(found[0]);
    };
    process_.stdout.on('data', onData);
    process_.stderr.on('data', onData);
    ended.then((code) => reject(new Error(`runnel ended with ${code} before it told its address:\n${output}`)));
  });
  const stop = async () => {
    process_.kill('SIGINT');
    return ended;
  };
  Cleanup(t, () => {
    process_.kill('SIGKILL'); // one that is held for viewers would wait for them
    return ended;
  });
  return { url, port: Number(new URL(url).port), ended, stop, output: () => output,
    freeze: () => process_.kill('SIGSTOP'), thaw: () => process_.kill('SIGCONT') };
}

/** A folder of its own with the demonstration in it; `change` may rewrite its text. */
export async function DemoFile(t, change = (text) => text) {
  const folder = await mkdtemp(join(tmpdir(), 'runnel_browser_'));
  Cleanup(t, () => rm(folder, { recursive: true, force: true }));
  const text = (await readFile(join(process.env.RUNNEL_XML, 'apps/bug_demo.xml'), 'utf8'))
    .replaceAll('../worlds/', `${process.env.RUNNEL_XML}/worlds/`);
  const changed = change(text);
  const file = join(folder, 'bug_demo.xml');
  await writeFile(file, changed);
  return { file, folder };
}

/** `text` with one thing replaced that must be there. */
export function Replaced(text, from, to) {
  assert.ok(text.includes(from), `'${from}' is in the file`);
  return text.replace(from, to);
}
