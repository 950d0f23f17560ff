// A node of ROS 2 that is Foxglove's own, from the datagrams on: prints who is there, which topics there are, and the first
// value of each of those that are named, by the definitions of ROS 2 Jazzy. Ends when it has them all.
//   node listen.mjs TOPIC=PACKAGE/msg/TYPE ...
import messages from '@foxglove/rosmsg-msgs-common';
import ros2 from '@foxglove/ros2';
import sockets from '@foxglove/ros2/nodejs.js';
import rtps from '@foxglove/rtps';

const wanted = new Map(process.argv.slice(2).map((each) => each.split('=')));
const all = messages.ros2jazzy;
const text = (octets) => Buffer.from(octets ?? []).toString('latin1');
// Lists of numbers as their numbers, and what JSON has no numbers for as texts.
function Plain(_, part) {
  if (ArrayBuffer.isView(part)) return [...part];
  return typeof part === 'bigint' || (typeof part === 'number' && !Number.isFinite(part)) ? String(part) : part;
}

const node = new ros2.RosNode({
  name: 'foxglove',
  addresses: ['127.0.0.1'],
  domainId: Number(process.env.ROS_DOMAIN_ID ?? 0),
  udpSocketCreate: sockets.UdpSocketNode.Create,
});
const participant = node._participant;

// It asks everybody for values that are kept for those who come late and not lost; here for what all writers have, but of
// what does not change.
const subscribe = participant.subscribe.bind(participant);
participant.subscribe = (options) => subscribe(options.topicName === 'rt/tf_static' ? options : {
  ...options,
  durability: rtps.Durability.Volatile,
  reliability: { ...options.reliability, kind: rtps.Reliability.BestEffort },
});

// It takes what may stand before a value (inline QoS: Cyclone's hashes of keys) for the value.
const kInlineQos = 2;
const kEnd = 1;
const handleData = participant.handleDataMsg;
participant.handleDataMsg = (from, data) => {
  if (data.flags & kInlineQos) {
    const end = data.offset + 4 + data.octetsToNextHeader;
    let at = data.offset + 24;
    for (let id = 0; id !== kEnd; at += 4 + data.view.getUint16(at + 2, data.littleEndian)) id = data.view.getUint16(at, data.littleEndian);
    const value = new Uint8Array(data.view.buffer, data.view.byteOffset + at, end - at);
    Object.defineProperty(data, 'serializedData', { value });
  }
  handleData(from, data);
};

const told = new Set();
function Tell(line) {
  if (!told.has(line)) console.log(line);
  told.add(line);
}
node.on('discoveredParticipant', (who) => Tell(`participant ${text(who.userData)}`));
node.on('discoveredPublication', (writer) => {
  Tell(`writer ${writer.topicName} ${writer.typeName} ${text(writer.userData)}`);
  for (const [topic, type] of node.getPublishedTopics()) Tell(`topic ${topic} ${type}`);
});
node.on('discoveredSubscription', (reader) => Tell(`reader ${reader.topicName} ${reader.typeName} ${text(reader.userData)}`));

await node.start();
// What it has to tell it says once; who was not listening yet never hears of it.
setInterval(() => { for (const other of participant._participants.values()) participant.sendInitialHeartbeats(other); }, 500);
for (const [topic, type] of wanted) {
  const { definitions } = all[type.replace('/msg/', '/')];
  node.subscribe({ topic, dataType: type, msgDefinition: [{ definitions }, ...Object.values(all)] })
    .on('message', (_, value) => {
      if (!wanted.delete(topic)) return;
      Tell(`value ${topic} ${JSON.stringify(value, Plain)}`);
      if (wanted.size > 0) return;
      Tell('all have come');
      process.exit(0);
    });
}
