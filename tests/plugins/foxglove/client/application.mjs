// A running application, and Foxglove's client connected to it.
import { spawn } from "node:child_process";
import { createRequire } from "node:module";
import WebSocket from "ws";

export const require = createRequire(import.meta.url);
const { FoxgloveClient } = require("@foxglove/ws-protocol"); // CommonJS
const decoder = new TextDecoder();

/// Starts `runnel run` and waits until it says where its inspector is.
export async function startApplication(program, file, ...further) {
  const child = spawn(program, ["run", file, "--inspect=127.0.0.1:0", "--quiet", "--no-control", ...further]);
  let said = "";
  const address = await new Promise((resolve, reject) => {
    const listen = (data) => {
      said += data;
      const found = said.match(/inspector: http:\/\/(\S+)/);
      if (found) resolve(found[1]);
    };
    child.stdout.on("data", listen);
    child.stderr.on("data", listen);
    child.on("exit", (code) => reject(new Error(`it ended with ${code}:\n${said}`)));
  });
  child.removeAllListeners("exit");
  return { address, child, stop: () => child.kill("SIGKILL"), isRunning: () => child.exitCode === null };
}

/// What has been heard, and ways to wait for more.
export class Viewer {
  channels = new Map(); // by topic
  statuses = [];
  parameterValues = [];
  graph = [];
  times = [];
  values = new Map(); // by topic: {stamp, json}
  counts = new Map();
  #topicOf = new Map(); // by subscription
  #closed = false;

  static async connect(address, protocol) {
    const viewer = new Viewer();
    viewer.socket = new WebSocket(`ws://${address}`, [protocol]);
    const client = new FoxgloveClient({ ws: viewer.socket });
    viewer.client = client;
    client.on("error", (error) => viewer.statuses.push({ level: 3, message: `client: ${error.message}` }));
    client.on("close", () => (viewer.#closed = true));
    client.on("serverInfo", (info) => (viewer.info = info));
    client.on("status", (status) => viewer.statuses.push(status));
    client.on("advertise", (channels) => channels.forEach((each) => viewer.channels.set(each.topic, each)));
    client.on("time", ({ timestamp }) => viewer.times.push(timestamp));
    client.on("parameterValues", (values) => viewer.parameterValues.push(values));
    client.on("connectionGraphUpdate", (update) => viewer.graph.push(update));
    client.on("message", ({ subscriptionId, timestamp, data }) => {
      const topic = viewer.#topicOf.get(subscriptionId);
      viewer.values.set(topic, { stamp: timestamp, json: JSON.parse(decoder.decode(data)) });
      viewer.counts.set(topic, (viewer.counts.get(topic) ?? 0) + 1);
    });
    await viewer.until("the server's greeting", () => viewer.info);
    await viewer.until("channels", () => viewer.channels.size > 0);
    return viewer;
  }

  subscribe(topic) {
    const id = this.client.subscribe(this.channels.get(topic).id);
    this.#topicOf.set(id, topic);
    return id;
  }

  async until(what, isSo, seconds = 20) {
    const end = Date.now() + seconds * 1000;
    while (Date.now() < end) {
      const found = isSo();
      if (found) return found;
      if (this.#closed) throw new Error(`the connection was closed while waiting for ${what}`);
      await new Promise((resolve) => setTimeout(resolve, 10));
    }
    throw new Error(`waited in vain for ${what}; statuses: ${JSON.stringify(this.statuses.slice(-3))}`);
  }
  complaint(words) {
    return this.until(`a complaint of '${words}'`, () =>
      this.statuses.find((status) => status.level === 2 && status.message.includes(words)));
  }
  close() {
    this.client.close();
  }
}
