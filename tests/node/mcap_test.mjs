// Reads MCAP recordings as other people's tools do: mcap_test.mjs INSONIFY PYTHON H5_JSON

import { McapIndexedReader, McapStreamReader } from "@mcap/core";
import { parse } from "@foxglove/rosmsg";
import { MessageReader } from "@foxglove/rosmsg2-serialization";
import * as fzstd from "fzstd";
import assert from "node:assert/strict";
import { execFileSync, spawn } from "node:child_process";
import fs from "node:fs";
import os from "node:os";
import path from "node:path";
import { after, before, test } from "node:test";
import { setTimeout as sleep } from "node:timers/promises";

const [INSONIFY, PYTHON, H5_JSON] = process.argv.slice(2);

// A floor 2 m below, seen by a fan and by a head that turns. The vehicle moves and turns.
const SCENARIO = `
world: floor.obj
duration: 0.2
seed: 5
trajectory:
  - {time: 0, position: [0, 0, 0]}
  - {time: 1, position: [1, 0.5, 0.25], orientation_deg: [0, 0, 40]}
sonars:
  - {name: bow-1, beam_count: 12, bin_count: 30, min_range: 1, max_range: 12, frequency: 455000, azimuth_aperture_deg: 70,
     orientation_deg: [0, 25, 10], sampling: {columns_per_beam: 2, rows: 40}}
  - {name: around, preset: tritech-micron-dst, bin_count: 25, max_range: 9, step_deg: 18, orientation_deg: [0, 0, 0],
     sampling: {columns_per_beam: 2, rows: 40}}
`;
const FLOOR = "v -20 -20 -2\nv 20 -20 -2\nv 20 20 -2\nv -20 20 -2\nf 1 2 3\nf 1 3 4\n";

const decompressHandlers = { zstd: (bytes, size) => fzstd.decompress(bytes, new Uint8Array(Number(size))) };
let folder, bow, around;

const run = (...words) => execFileSync(INSONIFY, words, { cwd: folder, encoding: "utf8", stdio: ["ignore", "pipe", "pipe"] });
const tables = (file) => JSON.parse(execFileSync(PYTHON, [H5_JSON, file], { cwd: folder, maxBuffer: 1 << 28 }));

async function indexed(bytes) {
  const readable = {
    size: async () => BigInt(bytes.length),
    read: async (at, length) => new Uint8Array(bytes.buffer, bytes.byteOffset + Number(at), Number(length)),
  };
  return McapIndexedReader.Initialize({ readable, decompressHandlers });
}

// All messages by topic, decoded by the schemas in the file.
async function messages(file) {
  const reader = await indexed(fs.readFileSync(path.join(folder, file)));
  const decoders = new Map();
  const found = {};
  for await (const message of reader.readMessages({ validateCrcs: true })) {
    const channel = reader.channelsById.get(message.channelId);
    const schema = reader.schemasById.get(channel.schemaId);
    assert.equal(schema.encoding, "ros2msg");
    assert.equal(channel.messageEncoding, "cdr");
    if (!decoders.has(schema.name)) {
      decoders.set(schema.name, new MessageReader(parse(new TextDecoder().decode(schema.data), { ros2: true })));
    }
    (found[channel.topic] ??= []).push({ time: message.logTime, schema: schema.name, ...decoders.get(schema.name).readMessage(message.data) });
  }
  return { reader, found };
}

const seconds = (stamp) => stamp.sec + stamp.nanosec * 1e-9;
const near = (value, expected, by, what = "") =>
  assert.ok(Math.abs(value - expected) <= by, `${what} ${value} is not within ${by} of ${expected}`);

before(() => {
  folder = fs.mkdtempSync(path.join(os.tmpdir(), "insonify-node-"));
  fs.writeFileSync(path.join(folder, "floor.obj"), FLOOR);
  fs.writeFileSync(path.join(folder, "s.yaml"), SCENARIO);
  run("run", "s.yaml", "-o", "out", "--record", "h5,mcap", "--no-pictures", "-q");
  run("export", "out/bow-1.h5", "out/around.h5", "-o", "all.mcap");
  bow = tables("out/bow-1.h5");
  around = tables("out/around.h5");
});
after(() => fs.rmSync(folder, { recursive: true }));

// The value of an intensity, by the mapping that docs/reference/messages.md states.
function value(intensity, range, most) {
  const level = 10 * Math.log10(intensity) + 30 * Math.log10(range);
  return most * Math.min(1, Math.max(0, (level + 100) / 60));
}

function checkImages(images, h5, name, bits) {
  assert.equal(images.length, h5.time.length);
  images.forEach((image, ping) => {
    assert.equal(image.schema, "marine_acoustic_msgs/msg/ProjectedSonarImage");
    assert.equal(image.header.frame_id, `${name}_beams`);
    near(seconds(image.header.stamp), h5.time[ping], 1e-9, "stamp");
    near(Number(image.time) * 1e-9, h5.time[ping], 1e-9, "log time");
    near(image.ping_info.sound_speed, h5.sound_speed, 1e-3, "sound speed");
    const beams = h5.azimuth.length;
    assert.equal(image.ping_info.tx_beamwidths.length, beams);
    assert.equal(image.ping_info.rx_beamwidths.length, beams);
    assert.equal(image.image.beam_count, beams);
    assert.equal(image.image.is_bigendian, false);
    assert.equal(image.image.dtype, bits === 8 ? 0 : 2);
    image.ranges.forEach((range, bin) => near(range, h5.range[bin], 1e-5, "range"));
    const head = h5.head_angle?.[ping] ?? 0;
    image.beam_directions.forEach((direction, beam) => {
      // As sonar viewers find it: positive to the right.
      const azimuth = Math.atan2(-direction.y, direction.z);
      near(Math.cos(azimuth + h5.azimuth[beam] + head), 1, 1e-9, "azimuth");
      assert.equal(direction.x, 0);
    });
    const bytes = image.image.data.slice();
    const values = bits === 8 ? bytes : new Uint16Array(bytes.buffer);
    assert.equal(values.length, beams * h5.range.length);
    let shown = 0;
    values.forEach((shownValue, cell) => {
      const bin = Math.floor(cell / beams);  // Range-major.
      near(shownValue, value(h5.intensity[ping][bin][cell % beams], h5.range[bin], bits === 8 ? 255 : 65535), 0.6, "value");
      shown += shownValue > 0 ? 1 : 0;
    });
    assert.ok(shown > 3, "an image that is all black tests nothing");
  });
}

// Points are in the middle of the beam, true points at the elevations of the ground truth.
function checkPoints(clouds, h5, name, trueElevations) {
  let known = 0;
  clouds.forEach((cloud, ping) => {
    assert.equal(cloud.header.frame_id, name);
    assert.deepEqual(cloud.fields.map((f) => [f.name, f.offset, f.datatype, f.count]),
      [["x", 0, 7, 1], ["y", 4, 7, 1], ["z", 8, 7, 1], ["intensity", 12, 7, 1]]);
    assert.equal(cloud.height, 1);
    assert.equal(cloud.row_step, cloud.width * cloud.point_step);
    assert.equal(cloud.data.length, cloud.row_step);
    assert.equal(cloud.width, Math.ceil(0.01 * h5.range.length * h5.azimuth.length));
    const floats = new Float32Array(cloud.data.slice().buffer);
    const head = h5.head_angle?.[ping] ?? 0;
    for (let i = 0; i < cloud.width; ++i) {
      const [x, y, z, level] = floats.slice(4 * i, 4 * i + 4);
      const range = Math.hypot(x, y, z);
      const azimuth = Math.atan2(y, x);
      const bin = h5.range.findIndex((r) => Math.abs(r - range) < 1e-4);
      const beam = h5.azimuth.findIndex((a) => Math.cos(a + head - azimuth) > 1 - 1e-9);
      assert.ok(bin >= 0 && beam >= 0, `no cell at ${range} m, ${azimuth} rad`);
      near(level, 10 * Math.log10(h5.intensity[ping][bin][beam]), 1e-3, "level");
      near(Math.asin(z / range), (trueElevations && h5.elevation[ping][bin][beam]) || 0, 1e-5, "elevation");
      known += h5.elevation[ping][bin][beam] !== null ? 1 : 0;
    }
  });
  assert.ok(known > 0, "no point has an elevation");
}

function checkPoses(poses, transforms, h5, name) {
  poses.forEach(({ header, pose }, ping) => {
    const p = pose.position, q = pose.orientation;
    assert.equal(header.frame_id, "world");
    assert.deepEqual([p.x, p.y, p.z, q.w, q.x, q.y, q.z], h5.world_from_sonar[ping]);
    const own = transforms.filter((t) => t.transforms[0].child_frame_id === name)[ping].transforms;
    assert.deepEqual(own.map((t) => [t.header.frame_id, t.child_frame_id]), [["world", name], [name, `${name}_beams`]]);
    assert.deepEqual(own[0].transform.rotation, q);
    near(own[1].transform.rotation.y, Math.SQRT1_2, 1e-12, "turn to the beams");
    near(own[1].transform.rotation.w, Math.SQRT1_2, 1e-12, "turn to the beams");
  });
}

test("a run's file holds what the HDF5 recording holds", async () => {
  const { reader, found } = await messages("out/bow-1.mcap");
  assert.equal(reader.header.profile, "ros2");
  assert.deepEqual(Object.keys(found).sort(), ["/bow_1/fan", "/bow_1/points", "/bow_1/pose", "/bow_1/sonar_image", "/bow_1/true_points",
    "/scenario", "/tf"]);
  checkImages(found["/bow_1/sonar_image"], bow, "bow_1", 16);
  checkPoints(found["/bow_1/points"], bow, "bow_1", false);
  checkPoints(found["/bow_1/true_points"], bow, "bow_1", true);
  checkPoses(found["/bow_1/pose"], found["/tf"], bow, "bow_1");
  assert.equal(found["/scenario"][0].data, bow.scenario);
  assert.equal(found["/bow_1/sonar_image"][0].ping_info.frequency, 455000);
  for (const fan of found["/bow_1/fan"]) {
    assert.equal(fan.encoding, "rgb8");
    assert.equal(fan.height, 480);
    assert.equal(fan.step, 3 * fan.width);
    assert.equal(fan.data.length, fan.step * fan.height);
    assert.ok(new Set(fan.data).size > 20, "a fan of one colour");
  }
});

test("a scanning head's file turns its beam", async () => {
  const { found } = await messages("out/around.mcap");
  checkImages(found["/around/sonar_image"], around, "around", 16);
  checkPoints(found["/around/points"], around, "around", false);
  checkPoints(found["/around/true_points"], around, "around", true);
  checkPoses(found["/around/pose"], found["/tf"], around, "around");
});

// A floor 8 m below a multibeam whose outer beams reach beyond the range.
const SWATH = `
world: deep.obj
pings: 2
sonars:
  - {name: swath, type: mbes, beam_count: 24, bin_count: 200, max_range: 14, azimuth_aperture_deg: 150, azimuth_resolution_deg: 4,
     elevation_aperture_deg: 4, assumed_sound_speed: 1500, ping_period: 0.25}
`;

test("a multibeam's file holds its soundings", async () => {
  fs.writeFileSync(path.join(folder, "deep.obj"), "v -90 -90 -8\nv 90 -90 -8\nv 90 90 -8\nv -90 90 -8\nf 1 2 3 4\n");
  fs.writeFileSync(path.join(folder, "swath.yaml"), SWATH);
  run("run", "swath.yaml", "-o", "deep", "--record", "h5,mcap", "--no-pictures", "-q");
  const h5 = tables("deep/swath.h5");
  const { found } = await messages("deep/swath.mcap");
  assert.equal(found["/swath/detections"].length, 2);
  found["/swath/detections"].forEach((one, ping) => {
    assert.equal(one.schema, "marine_acoustic_msgs/msg/SonarDetections");
    assert.equal(one.header.frame_id, "swath_swath");
    assert.equal(one.ping_info.sound_speed, 1500);
    const cloud = found["/swath/soundings"][ping];
    assert.equal(cloud.header.frame_id, "swath");
    assert.deepEqual(cloud.fields.map((f) => [f.name, f.offset, f.datatype, f.count]),
      [["x", 0, 7, 1], ["y", 4, 7, 1], ["z", 8, 7, 1], ["intensity", 12, 7, 1], ["uncertainty", 16, 7, 1], ["quality", 20, 7, 1],
       ["beam", 24, 4, 1], ["detection", 26, 2, 1], ["snippet_begin", 28, 5, 1], ["snippet_end", 32, 5, 1]]);
    const data = new DataView(cloud.data.buffer, cloud.data.byteOffset);
    let points = 0;
    h5.azimuth.forEach((azimuth, beam) => {
      const reach = h5.sounding_range[ping][beam], bad = h5.sounding_detection[ping][beam] === 0;
      near(one.rx_angles[beam], -azimuth, 1e-6, "angle");
      assert.deepEqual([one.flags[beam].flag, one.tx_delays[beam], one.tx_angles[beam]], [bad ? 1 : 0, 0, 0]);
      near(one.two_way_travel_times[beam], bad ? 0 : 2 * reach / 1500, 1e-8, "time");
      if (!bad) {
        const at = 36 * points++;
        near(data.getFloat32(at, true), reach * Math.cos(azimuth), 1e-5, "x");
        near(data.getFloat32(at + 4, true), reach * Math.sin(azimuth), 1e-5, "y");
        assert.equal(data.getUint16(at + 24, true), beam);
        near(data.getFloat32(at + 12, true), one.intensities[beam], 1e-6, "intensity");
      }
    });
    assert.equal(cloud.width, points);
    assert.ok(points > 8 && points < 24, `${points} of 24`);
  });
});

test("an export holds both sonars in the order of time", async () => {
  const { reader, found } = await messages("all.mcap");
  checkImages(found["/bow_1/sonar_image"], bow, "bow_1", 16);
  checkImages(found["/around/sonar_image"], around, "around", 16);
  checkPoses(found["/around/pose"], found["/tf"], around, "around");
  assert.equal(found["/tf"].length, bow.time.length + around.time.length);
  assert.equal(found["/scenario"].length, 1);
  const times = found["/tf"].map((message) => message.time);
  assert.deepEqual(times, [...times].sort((a, b) => Number(a - b)));
  const total = Object.values(found).reduce((sum, list) => sum + list.length, 0);
  assert.equal(reader.statistics.messageCount, BigInt(total));
  assert.equal(reader.statistics.chunkCount, reader.chunkIndexes.length);
  const metadata = {};
  for await (const record of reader.readMetadata()) {
    metadata[record.name] = record.metadata;
  }
  assert.equal(metadata.insonify.get("seed"), "5");
  assert.equal(metadata["insonify/bow_1"].get("sonar"), "bow-1");
});

test("eight bits", async () => {
  run("export", "out/bow-1.h5", "-o", "eight.mcap", "--bits", "8");
  const { found } = await messages("eight.mcap");
  checkImages(found["/bow_1/sonar_image"], bow, "bow_1", 8);
});

// Topics of all messages that a reader finds that follows the file from its start.
function streamed(bytes) {
  const reader = new McapStreamReader({ validateCrcs: true, decompressHandlers });
  reader.append(bytes);
  const topics = new Map(), found = [];
  for (let record; (record = reader.nextRecord()); ) {
    if (record.type === "Channel") topics.set(record.id, record.topic);
    if (record.type === "Message") found.push(topics.get(record.channelId));
  }
  return { found, done: reader.done() };
}

test("checksums fit, and tell of damage", async () => {
  const bytes = fs.readFileSync(path.join(folder, "all.mcap"));
  assert.ok(streamed(bytes).done);
  const damaged = Buffer.from(bytes);
  damaged[bytes.length - 20] ^= 1;  // In the footer.
  await assert.rejects(indexed(damaged), /crc/i);
  const data = Buffer.from(bytes);
  data[Math.floor(bytes.length / 2)] ^= 1;  // In the messages.
  assert.throws(() => streamed(data));
});

test("a killed run's file can be read up to its last second", async () => {
  const words = ["run", "s.yaml", "-o", "killed", "--record", "h5,mcap", "--no-pictures", "-q", "--duration", "100000"];
  const child = spawn(INSONIFY, words, { cwd: folder, stdio: "ignore" });
  const file = path.join(folder, "killed/bow-1.mcap");
  const ended = new Promise((resolve) => child.on("exit", resolve));
  while (!(fs.existsSync(file) && fs.statSync(file).size > 100_000) && child.exitCode === null) await sleep(10);
  const begun = performance.now();
  await sleep(1500);
  child.kill("SIGKILL");
  await ended;
  const lasted = (performance.now() - begun) / 1000;
  assert.equal(child.signalCode, "SIGKILL");
  const { found, done } = streamed(fs.readFileSync(file));
  assert.equal(done, false);
  const images = found.filter((topic) => topic === "/bow_1/sonar_image").length;
  const info = JSON.parse(run("info", "killed/bow-1.mcap", "killed/bow-1.h5", "--json"));
  assert.equal(info[0].state, "unfinished");
  assert.equal(info[1].state, "unfinished");
  assert.equal(info[0].sonars[0].pings, images);
  // The HDF5 recording has every ping; at most those of the last second, at twice the mean rate, are missing here.
  const made = info[1].sonars[0].pings;
  assert.ok(images > 0 && images <= made, `${images} of ${made}`);
  assert.ok(made - images <= 2 * (made / lasted) + 1, `${images} of ${made} pings in ${lasted} s`);
  run("replay", "killed/bow-1.mcap", "-o", "pictures", "--pictures", "last", "--height", "240");
  assert.ok(fs.existsSync(path.join(folder, "pictures", `bow-1_fan_${String(images - 1).padStart(4, "0")}.png`)));
});
