// What a process uses, and whether it grows: memory of its own, file descriptors, threads; how long locks were held in it.

import { readFile, readdir } from 'node:fs/promises';

const kLongestHold = 50; // ms
// Libraries are never unloaded (core/plugin), so that what they have of their own grows with each reload: it is told, and that is all.
// Memory may grow so much, by the least from the first third after the warm-up to the last one: an allocator gives back in pieces.
const kMemory = { share: 0.03, least: 2048 }; // kB

// These only have changes come one after the other, and so last as long as one: no cycle, viewer or STOP waits for them.
const kOrderChanges = /^\S+:runnel::(Application::Reload|StructureEditor::Apply|ChangeHistory::)/;

/** Of process `id`, now. */
export async function Use(id) {
  const status = await readFile(`/proc/${id}/status`, 'utf8');
  const number = (name) => Number(status.match(new RegExp(`^${name}:\\s+(\\d+)`, 'm'))[1]);
  const use = { memory: 0, libraries: 0, descriptors: (await readdir(`/proc/${id}/fd`)).length, threads: number('Threads') };
  let isLibrary = false;
  for (const line of (await readFile(`/proc/${id}/smaps`, 'utf8')).split('\n')) {
    const [, name] = line.match(/^[\da-f]+-[\da-f]+ \S+ \S+ \S+ \S+ *(.*)$/) ?? [];
    if (name !== undefined) isLibrary = name.startsWith('/');
    const [, octets] = line.match(/^Anonymous: +(\d+)/) ?? [];
    if (octets) use[isLibrary ? 'libraries' : 'memory'] += Number(octets);
  }
  return use;
}

/** What has grown, in words. Descriptors and threads: more in each of the last third than in any of the first one. */
export function Growth(all) {
  const third = Math.floor(all.length / 3);
  if (third < 3) return [`only ${all.length} samples: nothing can be said of growth; give it more time`];
  const of = (name, part) => part.map((each) => each[name]);
  const [first, last] = [all.slice(0, third), all.slice(-third)];
  const grown = [];
  for (const name of ['descriptors', 'threads']) {
    if (Math.min(...of(name, last)) > Math.max(...of(name, first))) grown.push(`${name} grow: ${of(name, all).join(' ')}`);
  }
  const [before, after] = [first, last].map((part) => Math.min(...of('memory', part)));
  if (after - before > Math.max(kMemory.least, before * kMemory.share)) grown.push(`memory grows from ${before} to ${after} kB`);
  return grown;
}

/** Of the file that lock_watch.cpp writes: locks of Runnel. {longest, at, tooLong} */
export async function Holds(file) {
  const text = await readFile(file, 'utf8').catch(() => '');
  const holds = { longest: 0, at: '', tooLong: [] };
  for (const line of text.split('\n')) {
    const [, time, at] = line.match(/^([\d.]+) (.*)$/) ?? [];
    const isOwn = at !== undefined && (/^(lib)?runnel/.test(at) || /^\w+\.so:.*runnel::/.test(at));
    if (!isOwn || kOrderChanges.test(at)) continue;
    const who = at.split(' < ').slice(0, 6).join(' < ');
    if (Number(time) > holds.longest) Object.assign(holds, { longest: Number(time), at: who });
    if (Number(time) > kLongestHold) holds.tooLong.push(`a lock was held for ${time} ms: ${who}`);
  }
  return holds;
}
