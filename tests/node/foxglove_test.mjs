// foxglove_test.mjs -- insonify serve as the clients of Foxglove's WebSocket protocol read it.
//
// foxglove_test.mjs INSONIFY
import assert from "node:assert/strict";
import {spawn} from "node:child_process";
import {mkdtempSync, rmSync, writeFileSync} from "node:fs";
import {tmpdir} from "node:os";
import {join} from "node:path";
import {parse} from "@foxglove/rosmsg";
import {MessageReader} from "@foxglove/rosmsg2-serialization";
import protocol from "@foxglove/ws-protocol";
import WebSocket from "ws";

const insonify = process.argv[2];
const folder = mkdtempSync(join(tmpdir(), "insonify-"));

// A point at 6 m, 20 degrees to starboard, and a second sonar.
writeFileSync(join(folder, "points.yaml"), `
points: [{position: [5.63816, -2.05212, 0], target_strength_db: -40}]
receiver: {noise: false}
sonars:
  - {name: fls, beam_count: 48, bin_count: 100, azimuth_aperture_deg: 90, max_range: 10, ping_period: 0.05}
  - {name: side, beam_count: 8, bin_count: 30, azimuth_aperture_deg: 30, max_range: 8, ping_period: 0.1}
`);

const server = spawn(insonify, ["serve", join(folder, "points.yaml"), "--port", "0", "--no-token"], {cwd: folder});
let said = "";
server.stdout.on("data", (bytes) => (said += bytes));
server.stderr.on("data", (bytes) => process.stderr.write(bytes));
const ended = new Promise((resolve) => server.on("exit", resolve));

async function until(what, condition) {
  for (let i = 0; i < 200; ++i) {
    const value = condition();
    if (value) {
      return value;
    }
    await new Promise((resolve) => setTimeout(resolve, 50));
  }
  throw new Error(`${what} did not come in ten seconds`);
}

// Subscribes to every channel, and returns what came of each topic.
async function messagesOf(address, name) {
  const messages = new Map();
  const channels = new Map();
  const statuses = [];
  const socket = new WebSocket(address, [name]);
  const client = new protocol.FoxgloveClient({ws: socket});
  const topics = new Map();
  let info;
  client.on("serverInfo", (event) => (info = event));
  client.on("status", (event) => statuses.push(event));
  client.on("advertise", (advertised) => {
    for (const channel of advertised) {
      channels.set(channel.topic, channel);
      topics.set(client.subscribe(channel.id), channel);
    }
  });
  client.on("message", ({subscriptionId, timestamp, data}) => {
    const channel = topics.get(subscriptionId);
    const reader = new MessageReader(parse(channel.schema, {ros2: true}));
    const message = reader.readMessage(data);
    messages.set(channel.topic, [...(messages.get(channel.topic) ?? []), {timestamp, message}]);
  });
  await until("every topic", () => channels.size > 0 && [...channels.keys()].every((topic) => messages.has(topic)));
  await until("twenty sonar images", () => messages.get("/fls/sonar_image").length >= 20);
  assert.equal(socket.protocol, name);
  assert.match(info.name, /^insonify /);
  client.close();
  return {messages, channels, statuses};
}

// Subscribes to every channel in one message, and counts what comes of each topic.
async function counting(address) {
  const socket = new WebSocket(address, ["foxglove.sdk.v1"]);
  const counts = new Map();
  const topics = [];
  socket.on("message", (data, binary) => {
    if (binary) {
      const topic = topics[data.readUInt32LE(1)];
      counts.set(topic, counts.get(topic) + 1);
      return;
    }
    const message = JSON.parse(data);
    if (message.op === "advertise") {
      const subscriptions = message.channels.map(({id, topic}) => {
        counts.set(topic, 0);
        return {id: topics.push(topic) - 1, channelId: id};
      });
      socket.send(JSON.stringify({op: "subscribe", subscriptions}));
    }
  });
  await until("the channels", () => topics.length > 0);
  return {socket, counts};
}

function checkChannels(channels) {
  const expected = ["/fls/sonar_image", "/fls/fan", "/fls/points", "/fls/true_points", "/fls/pose", "/side/sonar_image",
    "/side/fan", "/side/points", "/side/true_points", "/side/pose", "/tf", "/scenario"];
  assert.deepEqual([...channels.keys()].sort(), expected.sort());
  for (const channel of channels.values()) {
    assert.equal(channel.encoding, "cdr");
    assert.equal(channel.schemaEncoding, "ros2msg");
  }
  assert.equal(channels.get("/fls/fan").schemaName, "sensor_msgs/msg/Image");
}

// The point is where azimuth = atan2(-y, z) and range say it is: 6 m, and starboard is positive there.
function checkImage(image) {
  assert.equal(image.beam_directions.length, 48);
  assert.equal(image.ranges.length, 100);
  const values = new DataView(image.image.data.buffer, image.image.data.byteOffset);
  const bytes = image.image.dtype === 0 ? 1 : 2;
  let loudest = 0, at = 0;
  for (let i = 0; i < 48 * 100; ++i) {
    const value = bytes === 1 ? values.getUint8(i) : values.getUint16(2 * i, true);
    if (value > loudest) {
      [loudest, at] = [value, i];
    }
  }
  const {y, z} = image.beam_directions[at % 48];
  assert.ok(Math.abs(image.ranges[Math.floor(at / 48)] - 6) < 0.1, "range");
  assert.ok(Math.abs(Math.atan2(-y, z) * 180 / Math.PI - 20) < 1.5, "azimuth");
}

// Pause, speed and range are read, set and told; the time is that of the pings.
async function checkParametersAndTime(address) {
  const client = new protocol.FoxgloveClient({ws: new WebSocket(address, ["foxglove.sdk.v1"])});
  const answers = new Map(), told = new Map(), statuses = [], times = [];
  client.on("parameterValues", ({parameters, id}) => {
    for (const {name, value} of parameters) {
      told.set(name, value);
    }
    answers.set(id, parameters);
  });
  client.on("status", ({message}) => statuses.push(message));
  client.on("time", ({timestamp}) => times.push(timestamp));
  await new Promise((resolve) => client.on("open", resolve));
  await until("a time", () => times.length > 2);
  assert.ok(Math.abs(Number(times[0] / 1000000n) - Date.now()) < 60000);
  client.getParameters(["/fls/max_range", "/speed"], "both");
  await until("two parameters", () => answers.has("both"));
  assert.deepEqual(answers.get("both"), [{name: "/speed", value: 1, type: "float64"},
    {name: "/fls/max_range", value: 10, type: "float64"}]);
  client.subscribeParameterUpdates([]);
  await until("all parameters", () => told.has("/side/max_range"));
  client.setParameters([{name: "/fls/max_range", value: 6.5}], "range");
  await until("the range", () => told.get("/fls/max_range") === 6.5 && answers.has("range"));
  client.setParameters([{name: "/paused", value: true}], "pause");
  await until("the pause", () => told.get("/paused") === true);
  client.setParameters([{name: "/paused", value: false}, {name: "/fls/max_range", value: 10}], "back");
  await until("the range as before", () => answers.has("back") && told.get("/fls/max_range") === 10);
  assert.deepEqual(answers.get("back").map(({name, value}) => [name, value]), [["/paused", false], ["/fls/max_range", 10]]);
  client.setParameters([{name: "/fls/max_range", value: -1}], "wrong");
  await until("a refusal", () => statuses.some((text) => text.includes("max_range")) && answers.has("wrong"));
  assert.deepEqual(answers.get("wrong"), [{name: "/fls/max_range", value: 10, type: "float64"}]);
  client.setParameters([{name: "/deep", value: 1}], "unknown");
  await until("another", () => statuses.includes("there is no parameter /deep"));
  client.close();
}

try {
  const address = (await until("the address", () => /http:\S+/.exec(said)))[0].replace("http", "ws");
  for (const name of ["foxglove.sdk.v1", "foxglove.websocket.v1"]) {
    const {messages, channels} = await messagesOf(address, name);
    checkChannels(channels);
    checkImage(messages.get("/fls/sonar_image")[0].message);
    const stamps = messages.get("/fls/sonar_image").map(({timestamp}) => timestamp);
    assert.ok(stamps.every((stamp, i) => i === 0 || stamp >= stamps[i - 1]), "stamps rise");
    const off = Math.abs(Number(stamps[0] / 1000000n) - Date.now());
    assert.ok(off < 60000, `stamps are those of the clock, not ${off} ms off`);
    const header = messages.get("/fls/sonar_image")[0].message.header.stamp;
    assert.equal(BigInt(header.sec) * 1000000000n + BigInt(header.nanosec ?? header.nsec), stamps[0]);
    assert.equal(messages.get("/fls/fan")[0].message.encoding, "rgb8");
    assert.match(messages.get("/scenario")[0].message.data, /points/);
    const frames = messages.get("/tf").flatMap(({message}) => message.transforms.map((one) => one.child_frame_id));
    assert.ok(frames.includes("fls") && frames.includes("side"), `frames: ${[...new Set(frames)]}`);
  }

  await checkParametersAndTime(address);

  // While nothing is made, subscriptions to every channel in one message get the last ping of each sonar: a message on
  // each topic of a sonar, one of each sonar on /tf, and the scenario once. A client that was there gets none again.
  const viewer = new WebSocket(address, ["insonify.viewer.v1"]);
  let state = {};
  viewer.on("message", (data, binary) => {
    const text = binary ? {} : JSON.parse(data);
    state = text.op === "state" ? text : state;
  });
  await until("the viewer's state", () => "paused" in state);
  viewer.send(JSON.stringify({op: "pause", on: true}));
  await until("the pause", () => state.paused);
  const of = (topic) => (topic === "/tf" ? 2 : 1);
  const complete = (counts) => [...counts].every(([topic, count]) => count >= of(topic));
  const sockets = [viewer];
  const subscribed = async () => {
    const first = await counting(address);
    await until("every topic, while paused", () => complete(first.counts));
    const second = await counting(address);
    await until("every topic for another client", () => complete(second.counts));
    await new Promise((resolve) => setTimeout(resolve, 300));
    sockets.push(first.socket, second.socket);
    for (const {counts} of [first, second]) {
      assert.deepEqual(Object.fromEntries(counts), Object.fromEntries([...counts.keys()].map((topic) => [topic, of(topic)])));
    }
    return first;
  };
  // A ping that was being made at the pause may come after it, but only once.
  const first = await subscribed().catch(subscribed);
  viewer.send(JSON.stringify({op: "pause", on: false}));
  await until("pings again", () => first.counts.get("/fls/sonar_image") > 10);
  assert.equal(first.counts.get("/scenario"), 1);
  viewer.send(JSON.stringify({op: "set", settings: ["water.salinity=20"]}));
  await until("the scenario after a change", () => first.counts.get("/scenario") === 2);
  for (const socket of sockets) {
    socket.close();
  }

  // What it cannot do is answered, and what is no message ends the connection with a reason.
  const socket = new WebSocket(address, ["foxglove.websocket.v1"]);
  const texts = [];
  socket.on("message", (data, binary) => binary || texts.push(JSON.parse(data)));
  const closed = new Promise((resolve) => socket.on("close", (code, reason) => resolve([code, String(reason)])));
  await until("the greeting", () => texts.length >= 2);
  socket.send(JSON.stringify({op: "subscribe", subscriptions: [{id: 1, channelId: 999}]}));
  socket.send(JSON.stringify({op: "fetchAsset", uri: "package://rov/hull.dae", requestId: 1}));
  await until("two warnings", () => texts.filter(({op}) => op === "status").length === 2);
  socket.send("{}");
  assert.deepEqual(await closed, [1008, "the message is not a JSON object with an op"]);
} finally {
  server.kill("SIGINT");
  assert.equal(await ended, 0);
  rmSync(folder, {recursive: true});
}
console.log("foxglove: both subprotocols, every channel");
