// Reads each file <package>.<message>.<number> of a folder as a message of ROS 2 Jazzy by Foxglove's reader, writes it
// again by Foxglove's writer, and says where the octets differ. Prints what stands in those with the number "shown".
//   node read_and_write.mjs FOLDER
import {readFileSync, readdirSync} from 'node:fs';
import {join} from 'node:path';
import messages from '@foxglove/rosmsg-msgs-common';
import serialization from '@foxglove/rosmsg2-serialization';

const all = messages.ros2jazzy;
const {MessageReader, MessageWriter} = serialization;
const known = new Map();
const ends = (name) => {
  if (!known.has(name)) {
    const {definitions} = all[name];
    const both = [{definitions}, ...Object.values(all)];
    known.set(name, {reader: new MessageReader(both), writer: new MessageWriter(both)});
  }
  return known.get(name);
};

const [folder] = process.argv.slice(2);
let read = 0;
for (const file of readdirSync(folder).sort()) {
  const [package_, message, number] = file.split('.');
  const name = `${package_}/${message}`;
  if (!(name in all)) throw new Error(`Foxglove knows no ${name}`);
  const {reader, writer} = ends(name);
  const octets = readFileSync(join(folder, file));
  let value;
  try {
    value = reader.readMessage(octets);
  } catch (error) {
    throw new Error(`${file}: ${error.message}: ${octets.toString("hex")}`);
  }
  const again = Buffer.from(writer.writeMessage(value));
  if (!again.equals(octets)) throw new Error(`${file}:\n${octets.toString('hex')}\n${again.toString('hex')}`);
  ++read;
  const plain = (_, part) => (ArrayBuffer.isView(part) ? [...part] : typeof part === 'bigint' ? String(part) : part);
  if (number === 'shown') console.log(name, JSON.stringify(value, plain));
}
console.log(`${read} messages are the same`);
