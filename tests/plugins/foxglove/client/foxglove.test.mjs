// The protocol between a running application and Foxglove's own client library.
import assert from "node:assert/strict";
import { after, before, test } from "node:test";
import { readFileSync } from "node:fs";
import Ajv from "ajv";
import { startApplication, require, Viewer } from "./application.mjs";

const { RUNNEL_PROGRAM, RUNNEL_FILE, RUNNEL_WORLD } = process.env;
const encoder = new TextEncoder();
let application;

before(async () => {
  application = await startApplication(RUNNEL_PROGRAM, RUNNEL_FILE, `world=${RUNNEL_WORLD}`);
});
after(() => application.stop());

const ajv = new Ajv({ strict: false, strictNumbers: false, allErrors: true });

/// What Foxglove reads of JSON Schemas; the rest makes it refuse the channel.
function readableByFoxglove(schema, place) {
  assert.equal(schema.type, "object", place);
  for (const [name, field] of Object.entries(schema.properties)) {
    const at = `${place}.${name}`;
    if (field.oneOf) {
      field.oneOf.forEach((each) => assert.equal(typeof each.const, "number", at));
      continue;
    }
    const item = field.type === "array" ? field.items : field;
    if (item.type === "object") readableByFoxglove(item, at);
    else assert.ok(["boolean", "string", "number", "integer"].includes(item.type), `${at}: ${item.type}`);
  }
}

function withoutWords(schema) {
  if (Array.isArray(schema)) return schema.map(withoutWords);
  if (schema === null || typeof schema !== "object") return schema;
  const isProperties = (key, value) => key === "properties" && typeof value === "object";
  return Object.fromEntries(
    Object.entries(schema)
      .filter(([key]) => key !== "description" && key !== "$comment")
      .map(([key, value]) => [
        key,
        isProperties(key, value)
          ? Object.fromEntries(Object.entries(value).map(([name, field]) => [name, withoutWords(field)]))
          : withoutWords(value),
      ]),
  );
}

for (const protocol of ["foxglove.websocket.v1", "foxglove.sdk.v1"]) {
  test(`greets by ${protocol}`, async () => {
    const viewer = await Viewer.connect(application.address, protocol);
    assert.equal(viewer.socket.protocol, protocol);
    assert.equal(viewer.info.name, "shown");
    assert.deepEqual(viewer.info.supportedEncodings, ["json"]);
    for (const each of ["time", "parameters", "parametersSubscribe", "connectionGraph", "clientPublish"]) {
      assert.ok(viewer.info.capabilities.includes(each), each);
    }
    assert.ok(viewer.info.sessionId.length > 0);
    viewer.close();
  });
}

test("the channels' schemas are good, and Foxglove's are Foxglove's", async () => {
  const viewer = await Viewer.connect(application.address, "foxglove.websocket.v1");
  await viewer.until("all channels", () => viewer.channels.has("/referee/path/foxglove"));
  const drawn = new Set();
  for (const [topic, channel] of viewer.channels) {
    assert.equal(channel.encoding, "json");
    const schema = JSON.parse(channel.schema);
    ajv.compile(schema);
    readableByFoxglove(schema, topic);
    if (!channel.schemaName.startsWith("foxglove.")) continue;
    drawn.add(channel.schemaName);
    const file = require.resolve(`@foxglove/schemas/schemas/jsonschema/${channel.schemaName.slice(9)}.json`);
    assert.deepEqual(schema, withoutWords(JSON.parse(readFileSync(file, "utf8"))), topic);
  }
  assert.deepEqual([...drawn].sort(), ["foxglove.FrameTransform", "foxglove.LaserScan",
    "foxglove.Log", "foxglove.PoseInFrame", "foxglove.PosesInFrame", "foxglove.SceneUpdate"]);
  viewer.close();
});

test("every channel has values that its schema allows, stamped with the application's time", async () => {
  const viewer = await Viewer.connect(application.address, "foxglove.websocket.v1");
  await viewer.until("all channels", () => viewer.channels.has("/referee/path/foxglove"));
  const topics = [...viewer.channels.keys()].filter((topic) => topic !== "/log");  // in which nothing may have happened
  topics.forEach((topic) => viewer.subscribe(topic));
  await viewer.until("a value of each", () => topics.every((topic) => viewer.values.has(topic)));
  for (const topic of topics) {
    const validate = ajv.compile(JSON.parse(viewer.channels.get(topic).schema));
    const { json } = viewer.values.get(topic);
    assert.ok(validate(json), `${topic}: ${ajv.errorsText(validate.errors)}`);
  }
  const pose = viewer.values.get("/world/pose");
  assert.deepEqual(Object.keys(pose.json), ["x", "y", "heading"]);
  const drawnPose = viewer.values.get("/world/pose/foxglove");
  assert.equal(BigInt(drawnPose.json.timestamp.sec) * 1000000000n + BigInt(drawnPose.json.timestamp.nsec),
    drawnPose.stamp);
  assert.equal(drawnPose.json.frame_id, "world");
  const scan = viewer.values.get("/laser/scan/foxglove").json;
  assert.equal(scan.frame_id, viewer.values.get("/tf").json.child_frame_id);
  assert.ok(scan.ranges.length > 100 && scan.ranges.every((range) => range >= 0));
  assert.ok(viewer.values.get("/world/map/foxglove").json.entities[0].lines.length > 5);
  // They go on coming, as does the time.
  const { stamp } = viewer.values.get("/world/pose");
  await viewer.until("the next pose", () => viewer.values.get("/world/pose").stamp > stamp);
  await viewer.until("time", () => viewer.times.length > 5);
  for (let i = 1; i < viewer.times.length; ++i) assert.ok(viewer.times[i] > viewer.times[i - 1]);
  viewer.close();
});

test("what is changed is told in the log, as its schema allows", async () => {
  const viewer = await Viewer.connect(application.address, "foxglove.websocket.v1");
  await viewer.until("the log", () => viewer.channels.has("/log"));
  viewer.subscribe("/log");
  viewer.client.setParameters([{ name: "/robot/planner/cruise_speed", value: 0.31 }], "log");
  await viewer.until("the change", () => viewer.values.get("/log")?.json.message.includes("cruise_speed"));
  const validate = ajv.compile(JSON.parse(viewer.channels.get("/log").schema));
  assert.ok(validate(viewer.values.get("/log").json), ajv.errorsText(validate.errors));
  viewer.close();
});

test("an unsubscribed channel is silent", async () => {
  const viewer = await Viewer.connect(application.address, "foxglove.websocket.v1");
  const id = viewer.subscribe("/world/pose");
  viewer.subscribe("/world/twist");
  await viewer.until("poses", () => viewer.counts.get("/world/pose") > 2);
  viewer.client.unsubscribe(id);
  const twists = () => viewer.counts.get("/world/twist");
  const soon = twists() + 3;
  await viewer.until("twists", () => twists() > soon);  // what was on its way has come
  const count = viewer.counts.get("/world/pose");
  const later = twists() + 5;
  await viewer.until("twists", () => twists() > later);
  assert.equal(viewer.counts.get("/world/pose"), count);
  viewer.close();
});

test("parameters are read, set, watched; what cannot be is told", async () => {
  const viewer = await Viewer.connect(application.address, "foxglove.websocket.v1");
  const answer = (id) => viewer.until(`the answer ${id}`, () =>
    viewer.parameterValues.find((each) => each.id === id)?.parameters);
  viewer.client.getParameters([], "all");
  const all = await answer("all");
  assert.ok(all.length > 20);
  const stop = all.find((each) => each.name === "/robot/gate/stop");
  assert.deepEqual(stop, { name: "/robot/gate/stop", value: false });
  assert.deepEqual(all.find((each) => each.name === "/robot/gate/wanted_timeout"),
    { name: "/robot/gate/wanted_timeout", value: 0.5, type: "float64" });

  const other = await Viewer.connect(application.address, "foxglove.sdk.v1");
  other.client.subscribeParameterUpdates(["/robot/gate/wanted_timeout"]);
  await other.until("the value now", () => other.parameterValues.length > 0);
  viewer.client.setParameters([{ name: "/robot/gate/wanted_timeout", value: 3, type: "float64" }], "set");
  assert.equal((await answer("set"))[0].value, 3);
  await other.until("the new value", () => other.parameterValues.at(-1).parameters[0].value === 3);
  other.close();

  viewer.client.setParameters([{ name: "/robot/gate/wanted_timeout", value: 10000 }], "too large");
  await viewer.complaint("0 .. 3600");
  assert.equal((await answer("too large"))[0].value, 3);
  viewer.client.setParameters([{ name: "/robot/gate/wanted_timeuot", value: 1 }]);
  await viewer.complaint("did you mean '/robot/gate/wanted_timeout'?");
  viewer.close();
});

test("the connection graph is told", async () => {
  const viewer = await Viewer.connect(application.address, "foxglove.websocket.v1");
  viewer.client.subscribeConnectionGraph();
  const update = (await viewer.until("the graph", () => viewer.graph))[0] ??
    (await viewer.until("the graph", () => viewer.graph[0]));
  const of = (list, name) => list.find((each) => each.name === name);
  assert.deepEqual(of(update.publishedTopics, "/robot/planner/twist").publisherIds, ["/shown/robot/planner"]);
  assert.deepEqual(of(update.subscribedTopics, "/robot/planner/twist").subscriberIds, ["/shown/robot/gate"]);
  assert.deepEqual(update.removedTopics, []);
  viewer.close();
});

test("what a client publishes arrives in the module", async () => {
  const viewer = await Viewer.connect(application.address, "foxglove.websocket.v1");
  viewer.subscribe("/robot/gate/state");
  await viewer.until("an open gate", () => viewer.values.get("/robot/gate/state")?.json.value === "open");
  const channel = viewer.client.advertise({ topic: "/robot/gate/contact", encoding: "json", schemaName: "Contact" });
  viewer.client.sendMessage(channel, encoder.encode(JSON.stringify({ is_touching: true, bearing: 0.5 })));
  await viewer.until("a closed gate", () => viewer.values.get("/robot/gate/state").json.value !== "open");
  viewer.client.sendMessage(channel, encoder.encode(JSON.stringify({ is_touching: false })));
  await viewer.until("an open gate", () => viewer.values.get("/robot/gate/state").json.value === "open");
  viewer.client.sendMessage(channel, encoder.encode("{\"is_touching\":5}"));
  await viewer.complaint("is_touching: expected true or false");
  viewer.client.unadvertise(channel);
  viewer.client.sendMessage(channel, encoder.encode("{}"));
  await viewer.complaint("is not advertised");
  viewer.client.advertise({ topic: "/robot/gate/contakt", encoding: "json", schemaName: "" });
  await viewer.complaint("did you mean '/robot/gate/contact'?");
  viewer.close();
});

test("clients that mean no good are told, and others go on", async () => {
  const good = await Viewer.connect(application.address, "foxglove.websocket.v1");
  good.subscribe("/world/pose");
  const bad = await Viewer.connect(application.address, "foxglove.websocket.v1");
  const send = (data) => bad.socket.send(data);
  send("garbage");
  await bad.complaint("no JSON");
  send(JSON.stringify({ op: "callService" }));
  await bad.complaint("there is no operation 'callService' here");
  send(JSON.stringify({ op: "subscribe", subscriptions: [{ id: 1, channelId: 99999 }] }));
  await bad.complaint("there is no channel 99999");
  send(Buffer.from([1, 255, 255, 255, 255, 0]));
  await bad.complaint("channel 4294967295 is not advertised");
  send(Buffer.from([77, 1, 2, 3]));
  await bad.complaint("no binary message of this kind");
  for (let i = 0; i < 50; ++i) send(Buffer.from(Array.from({ length: i }, () => (i * 37) & 255)));
  const closed = new Promise((resolve) => bad.socket.on("close", resolve));
  bad.socket.on("error", () => {});
  send("x".repeat(4 << 20));
  await closed;  // too much for one message
  const count = good.counts.get("/world/pose") ?? 0;
  await good.until("more poses", () => (good.counts.get("/world/pose") ?? 0) > count + 10);
  assert.ok(application.isRunning());
  good.close();
});
