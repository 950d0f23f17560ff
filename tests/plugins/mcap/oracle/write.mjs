// Writes a recording by @mcap/core.   node write.mjs FILE [--loose]
import {openSync, writeSync, closeSync} from 'node:fs';
import {McapWriter} from '@mcap/core';

const [path, option] = process.argv.slice(2);
const descriptor = openSync(path, 'w');
let position = 0n;
const writable = {
  position: () => position,
  write: async (bytes) => {
    writeSync(descriptor, bytes);
    position += BigInt(bytes.byteLength);
  },
};
const writer = new McapWriter({writable, useChunks: option !== '--loose', chunkSize: 400});
const bytes = (text) => new TextEncoder().encode(text);
await writer.start({profile: 'oracle', library: 'mcap core'});
const schemaId = await writer.registerSchema(
    {name: 'Pose2', encoding: 'jsonschema', data: bytes('{"type":"object"}')});
const pose = await writer.registerChannel(
    {topic: '/robot/pose', messageEncoding: 'json', schemaId, metadata: new Map([['unit', 'm']])});
const bare = await writer.registerChannel(
    {topic: '/bare', messageEncoding: 'json', schemaId: 0, metadata: new Map()});
for (let i = 0; i < 50; ++i) {
  await writer.addMessage({channelId: i % 5 === 4 ? bare : pose, sequence: i,
                           logTime: BigInt(i) * 1000n, publishTime: BigInt(i) * 1000n + 1n,
                           data: bytes(`{"x":${i}}`)});
}
// Without chunks @mcap/core 2.2.2 notes wrong offsets for these.
if (option !== '--loose') {
  await writer.addAttachment({name: 'note.txt', mediaType: 'text/plain', logTime: 7n,
                              createTime: 8n, data: bytes('a note')});
  await writer.addMetadata({name: 'about', metadata: new Map([['who', 'the oracle']])});
}
await writer.end();
closeSync(descriptor);
