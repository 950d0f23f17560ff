// Whether a file has what comes on the standard input, however it is indented: node has_part.mjs FILE

import { readFileSync } from 'node:fs';

const Flat = (text) => text.split('\n').map((line) => line.trim()).filter((line) => line !== '').join('\n');
const [file] = process.argv.slice(2);
if (!Flat(readFileSync(file, 'utf8')).includes(Flat(readFileSync(0, 'utf8')))) {
  console.error(`${file} does not have this part`);
  process.exit(1);
}
