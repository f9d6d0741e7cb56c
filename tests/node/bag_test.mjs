// Reads bags of ROS 1 as another program does, and compares them with the MCAP file of the same recordings:
// bag_test.mjs INSONIFY PYTHON

import { Bag } from "@foxglove/rosbag";
import { FileReader } from "@foxglove/rosbag/node.js";
import { McapIndexedReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader as Ros1Reader } from "@foxglove/rosmsg-serialization";
import { MessageReader as Ros2Reader } from "@foxglove/rosmsg2-serialization";
import * as fzstd from "fzstd";
import assert from "node:assert/strict";
import { execFileSync } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";

const [INSONIFY, PYTHON] = process.argv.slice(2);

// A fan, a head that turns, and a multibeam above a floor; their pings come in turns, some of the first two at the same time.
const SCENARIO = `
world: floor.obj
seed: 9
duration: 1.3
points: [{position: [8, 1, -1], target_strength_db: -10}, {position: [5, -2, 1], target_strength_db: -14}]
trajectory:
  - {time: 0, position: [0, 0, 0]}
  - {time: 1, position: [1, 0.5, 0.25], orientation_deg: [0, 0, 40]}
sonars:
  - {name: bow-1, beam_count: 12, bin_count: 30, min_range: 1, max_range: 12, azimuth_aperture_deg: 70,
     elevation_aperture_deg: 40, ping_period: 0.05, sampling: {columns_per_beam: 2, rows: 40}}
  - {name: around, type: msis, beam_count: 1, bin_count: 25, max_range: 9, step_deg: 18, azimuth_aperture_deg: 4,
     ping_period: 0.07, sampling: {columns_per_beam: 2, rows: 40}}
  - {name: swath, type: mbes, beam_count: 12, bin_count: 100, max_range: 12, azimuth_aperture_deg: 90, azimuth_resolution_deg: 6,
     elevation_aperture_deg: 6, ping_period: 0.1937}
`;
const FLOOR = "v -30 -30 -6\nv 30 -30 -6\nv 30 30 -6\nv -30 30 -6\nf 1 2 3 4\n";

// Checksums in Debian's and in marine_acoustic_msgs' packages for ROS 1.
const CHECKSUMS = {
  "geometry_msgs/PoseStamped": "d3812c3cbc69362b77dc0b19b345f8f5",
  "marine_acoustic_msgs/ProjectedSonarImage": "c72fc8e29ab227a547720a36666022fd",
  "marine_acoustic_msgs/SonarDetections": "588993519ccaab99fb0df80256b440ff",
  "sensor_msgs/Image": "060021388200f6f0f447d0fcd9c64743",
  "sensor_msgs/PointCloud2": "1158d486dd51d683ce2f1be655c3c181",
  "std_msgs/String": "992ce8a1687cec8c8bd883ec73ca41d1",
  "tf2_msgs/TFMessage": "94810edda583a504dfda3829e70d7eec",
};

let folder;
const run = (...words) => execFileSync(INSONIFY, words, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });

before(() => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "insonify-bag-"));
  fs.writeFileSync(path.join(folder, "s.yaml"), SCENARIO);
  fs.writeFileSync(path.join(folder, "floor.obj"), FLOOR);
  run("run", "s.yaml", "-o", "out", "--no-pictures", "-q");
  for (const ending of ["bag", "mcap"]) {
    run("export", "out/bow-1.h5", "out/around.h5", "out/swath.h5", "-o", `all.${ending}`);
  }
});
after(() => fs.rmSync(folder, { recursive: true }));

// What ROS 1 and ROS 2 say in the same words: without `seq`, with the names of times as ROS 2 has them.
function same_words(value) {
  if (Array.isArray(value)) {
    return value.map(same_words);
  }
  if (ArrayBuffer.isView(value)) {
    return Buffer.from(value.buffer, value.byteOffset, value.byteLength).toString("base64");
  }
  if (typeof value !== "object") {
    return typeof value === "boolean" ? Number(value) : value;
  }
  const words = {};
  for (const [key, inner] of Object.entries(value)) {
    if (key !== "seq") {
      words[key === "nsec" ? "nanosec" : key] = same_words(inner);
    }
  }
  return words;
}

async function of_bag() {
  const bag = new Bag(new FileReader(path.join(folder, "all.bag")), { parse: false });
  await bag.open();
  const messages = [];
  const decoders = new Map();
  for await (const { topic, connectionId, timestamp, data } of bag.messageIterator()) {
    const { type, md5sum, messageDefinition } = bag.connections.get(connectionId);
    assert.equal(md5sum, CHECKSUMS[type]);
    if (!decoders.has(type)) {
      decoders.set(type, new Ros1Reader(parse(messageDefinition)));
    }
    messages.push({ topic, type, time: BigInt(timestamp.sec) * 1000000000n + BigInt(timestamp.nsec),
                    message: decoders.get(type).readMessage(data) });
  }
  return { bag, messages };
}

async function of_mcap() {
  const bytes = fs.readFileSync(path.join(folder, "all.mcap"));
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (at, length) => new Uint8Array(bytes.buffer, bytes.byteOffset + Number(at), Number(length)),
  };
  const decompressHandlers = { zstd: (packed, size) => fzstd.decompress(packed, new Uint8Array(Number(size))) };
  const reader = await McapIndexedReader.Initialize({ readable, decompressHandlers });
  const messages = [];
  for await (const message of reader.readMessages()) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    const decoder = new Ros2Reader(parse(new TextDecoder().decode(schema.data), { ros2: true }));
    messages.push({ topic: channel.topic, type: schema.name.replace("/msg/", "/"), time: message.logTime,
                    message: decoder.readMessage(message.data) });
  }
  return messages;
}

test("a bag holds what the MCAP file of the same recordings holds", async () => {
  const { bag, messages } = await of_bag();
  const expected = await of_mcap();
  assert.equal(messages.length, expected.length);
  assert.deepEqual(new Set([...bag.connections.values()].map((one) => one.topic)), new Set(expected.map((one) => one.topic)));
  for (const topic of new Set(expected.map((one) => one.topic))) {
    // Those of the same time come in any order.
    const of_topic = (all) => all.filter((one) => one.topic === topic)
      .sort((a, b) => Number(a.time - b.time) || JSON.stringify(a.message.transforms ?? "").localeCompare(JSON.stringify(b.message.transforms ?? "")));
    const mine = of_topic(messages), theirs = of_topic(expected);
    assert.equal(mine.length, theirs.length, topic);
    mine.forEach((one, i) => {
      assert.equal(one.type, theirs[i].type);
      assert.equal(one.time, theirs[i].time === 0n ? 1n : theirs[i].time);  // ROS 1 knows no message at time 0.
      assert.deepEqual(same_words(one.message), same_words(theirs[i].message), `${topic} ${i}`);
    });
  }
});

test("sequence numbers are those of the pings", async () => {
  const { messages } = await of_bag();
  const numbers = messages.filter((one) => one.topic === "/bow_1/sonar_image").map((one) => one.message.header.seq);
  assert.deepEqual(numbers, [...numbers.keys()]);
  assert.ok(numbers.length > 20);
});

test("soundings are there, each once as a flag and as a point", async () => {
  const { messages } = await of_bag();
  const of_topic = (topic) => messages.filter((one) => one.topic === topic).map((one) => one.message);
  const detections = of_topic("/swath/detections"), clouds = of_topic("/swath/soundings");
  assert.equal(detections.length, 7);
  assert.equal(clouds.length, 7);
  detections.forEach((one, ping) => {
    assert.equal(one.flags.length, 12);
    const good = one.flags.filter(({ flag }) => flag === 0).length;
    assert.ok(good > 6, `${good} of 12`);
    assert.equal(clouds[ping].width, good);
    assert.equal(clouds[ping].data.length, 36 * good);
  });
});

test("rosbag of ROS 1 reads it", (context) => {
  try {
    execFileSync(PYTHON, ["-c", "import rosbag"], { stdio: "ignore" });
  } catch {
    return context.skip("there is no python3-rosbag");
  }
  const code = `import rosbag
bag = rosbag.Bag("all.bag")
facts = bag.get_type_and_topic_info()
print(len(list(bag.read_messages())), facts.topics["/around/sonar_image"].message_count, bag.get_compression_info().compression)`;
  const told = execFileSync(PYTHON, ["-c", code], { cwd: folder, encoding: "utf8" }).split(" ");
  assert.ok(Number(told[0]) > 200);
  assert.equal(Number(told[1]), 19);
  assert.equal(told[2].trim(), "none");
});

test("an export that fails leaves nothing", () => {
  assert.throws(() => run("export", "out/bow-1.h5", "-o", "nowhere/a.bag"), /nowhere/);
  fs.writeFileSync(path.join(folder, "there.bag"), "mine");
  assert.throws(() => run("export", "out/bow-1.h5", "-o", "there.bag"), /exists already/);
  assert.equal(fs.readFileSync(path.join(folder, "there.bag"), "utf8"), "mine");
  run("export", "out/bow-1.h5", "-o", "there.bag", "--force");
  assert.ok(fs.statSync(path.join(folder, "there.bag")).size > 10000);
});
