// Reads a recording by @mcap/core, in both of its ways, and prints what it found as JSON.
//   node read.mjs FILE        fails if the file is not what the format wants, checksums included
//   node read.mjs FILE --streamed-only
import {openSync, readSync, fstatSync, readFileSync} from 'node:fs';
import {McapIndexedReader, McapStreamReader} from '@mcap/core';
import * as fzstd from 'fzstd';
import lz4js from 'lz4js';

const decompressHandlers = {
  zstd: (packed, size) => fzstd.decompress(packed, new Uint8Array(Number(size))),
  lz4: (packed, size) => lz4js.decompress(packed, Number(size)),
};
const text = (bytes) => new TextDecoder('utf-8', {fatal: true}).decode(bytes);

class File {
  constructor(path) { this.descriptor = openSync(path, 'r'); }
  async size() { return BigInt(fstatSync(this.descriptor).size); }
  async read(offset, size) {
    const bytes = new Uint8Array(Number(size));
    const count = readSync(this.descriptor, bytes, 0, Number(size), Number(offset));
    if (count !== Number(size)) throw new Error(`read ${count} of ${size} bytes at ${offset}`);
    return bytes;
  }
}

async function readIndexed(path) {
  const reader = await McapIndexedReader.Initialize({readable: new File(path), decompressHandlers});
  const result = {
    profile: reader.header.profile,
    library: reader.header.library,
    channels: [], messages: [], metadata: [], attachments: [],
    statistics: {
      messages: Number(reader.statistics.messageCount),
      channels: reader.statistics.channelCount,
      schemas: reader.statistics.schemaCount,
      chunks: reader.statistics.chunkCount,
      start: String(reader.statistics.messageStartTime),
      end: String(reader.statistics.messageEndTime),
    },
    chunks: reader.chunkIndexes.map((each) => each.compression),
  };
  for (const channel of reader.channelsById.values()) {
    const schema = reader.schemasById.get(channel.schemaId);
    result.channels.push({
      id: channel.id, topic: channel.topic, encoding: channel.messageEncoding,
      metadata: Object.fromEntries(channel.metadata), schema: schema?.name ?? null,
      schemaEncoding: schema?.encoding ?? null, schemaData: schema ? text(schema.data) : null,
      count: Number(reader.statistics.channelMessageCounts.get(channel.id) ?? 0n),
    });
  }
  for await (const message of reader.readMessages({validateCrcs: true})) {
    result.messages.push(toMessage(message));
  }
  for await (const metadata of reader.readMetadata()) {
    result.metadata.push({name: metadata.name, texts: Object.fromEntries(metadata.metadata)});
  }
  for await (const attachment of reader.readAttachments({validateCrcs: true})) {
    result.attachments.push({name: attachment.name, mediaType: attachment.mediaType,
                             data: text(attachment.data)});
  }
  return result;
}

function toMessage(message) {
  return {channel: message.channelId, sequence: message.sequence, time: String(message.logTime),
          publishTime: String(message.publishTime), data: text(message.data)};
}

function readStreamed(path) {
  const reader = new McapStreamReader({decompressHandlers, validateCrcs: true});
  reader.append(readFileSync(path));
  const result = {messages: [], records: {}};
  for (let record; (record = reader.nextRecord());) {
    result.records[record.type] = (result.records[record.type] ?? 0) + 1;
    if (record.type === 'Message') result.messages.push(toMessage(record));
  }
  result.done = reader.done();
  return result;
}

const [path, option] = process.argv.slice(2);
const streamed = readStreamed(path);
const indexed = option === '--streamed-only' ? null : await readIndexed(path);
process.stdout.write(JSON.stringify({indexed, streamed}));
