// mock_sonar.mjs -- pings of a made-up scene: a wall, a bed and a point target at a known place.

export const kPoint = { position: [12, -3, 0], level: -31.25 };
export const kHostile = '<img src=x onerror="document.title=\'owned\'">';

const azimuthsOf = (beams, aperture) => Array.from({ length: beams }, (_, i) => aperture / 2 - ((i + 0.5) * aperture) / beams);

export function makeSonars() {
  return [
    { name: "fls", type: "fls", product: "image", beams: 128, bins: 250, min_range: 0.2, max_range: 30, azimuths: azimuthsOf(128, 120), elevation_aperture: 20, azimuth_aperture: 120, step: 0, gain_db: 0, period: 0.05, reference: "dB re source at 1 m", levels: [-110, -30] },
    { name: "head", type: "msis", product: "line", beams: 1, bins: 300, min_range: 0.3, max_range: 15, azimuths: [0], elevation_aperture: 35, azimuth_aperture: 3, step: 3.6, gain_db: 0, period: 0.05, reference: "dB re source at 1 m", levels: [-110, -30] },
  ];
}

/** A side-scan sonar, and a multibeam of 61 beams 2 degrees apart. */
export function makeSurveyors() {
  const both = { step: 0, gain_db: 0, period: 0.1, reference: "dB re source at 1 m", levels: [-110, -30], min_range: 0 };
  return [
    { ...both, name: "sides", type: "sss", product: "waterfall", beams: 2, bins: 400, max_range: 20, azimuths: [90, -90], elevation_aperture: 60, elevation_center: -40, azimuth_aperture: 0.5 },
    { ...both, name: "swath", type: "mbes", product: "image", beams: 61, bins: 300, max_range: 15, azimuths: Array.from({ length: 61 }, (_, i) => 60 - 2 * i), elevation_aperture: 2, azimuth_aperture: 122 },
  ];
}

export function setBins(sonar, bins) {
  sonar.bins = bins;
}

const kWallAt = 18;      // x of a wall [m]
const kBedBelow = 3;     // depth of the bed below the sonar [m]

/** A wall of 1 m on the bed, 8 m to starboard of x, from `from` to `to` along it [m]: with the sonar 3 m above the bed its foot is at
 * sqrt(8^2 + 3^2) = 8.544 m, and its shadow ends at 8 * 3 / (3 - 1) = 12 m, sqrt(12^2 + 3^2) = 12.369 m. */
export const kFence = { across: 8, height: 1, from: -1, to: 1 };

// Level of the bed, and of the fence, in a cell of a side-scan sonar [dB]; null in the water and in the shadow.
function sideEcho({ position: [x, , z] }, beam, range) {
  const above = z + kBedBelow;
  if (range < above) return null;
  const across = Math.sqrt(range * range - above * above);
  if (beam === 1 && x >= kFence.from && x <= kFence.to) {
    const end = (kFence.across * above) / (above - kFence.height);
    if (Math.abs(across - kFence.across) < 0.1) return -40;
    if (across > kFence.across && across < end) return null;
  }
  return -55 - 10 * Math.log10(range);
}

function makeSideTables(sonar, vehicle) {
  const level = new Uint16Array(sonar.beams * sonar.bins);
  for (let i = 0; i < level.length; ++i) {
    const range = (Math.floor(i / 2) + 0.5) * (sonar.max_range / sonar.bins);
    const echo = sideEcho(vehicle, i % 2, range);
    level[i] = echo === null ? 0 : Math.round((echo + 400) * 100);
  }
  return { level };
}

// A level bed below; the outermost beam has no sounding, the middle ones are found by amplitude.
function makeSwathTables(sonar, { position: [, , z] }) {
  const { beams, bins } = sonar;
  const ranges = sonar.azimuths.map((azimuth) => (z + kBedBelow) / Math.cos((azimuth * Math.PI) / 180));
  const level = new Uint16Array(beams * bins);
  ranges.forEach((range, beam) => (level[Math.floor((range / sonar.max_range) * bins) * beams + beam] = 35500));
  const sounding_range = Float32Array.from(ranges, (range, beam) => (beam === 0 ? NaN : range));
  const detection = Uint8Array.from(ranges, (_, beam) => (beam === 0 ? 0 : Math.abs(beam - 30) < 10 ? 1 : 2));
  return { level, sounding_range, detection };
}

const kTables = { sss: makeSideTables, mbes: makeSwathTables };

/** Echo in a cell as [level in dB, instance, material, elevation], or null. */
function echo(sonar, vehicle, azimuth, range, binLength, beamWidth, noise) {
  const dx = kPoint.position[0] - vehicle.position[0];
  const dy = kPoint.position[1] - vehicle.position[1];
  const yaw = vehicle.yaw + azimuth;
  const bearing = Math.atan2(dy, dx);
  const off = Math.atan2(Math.sin(yaw - bearing), Math.cos(yaw - bearing));
  if (Math.abs(off) <= beamWidth / 2 && Math.abs(Math.hypot(dx, dy) - range) <= binLength / 2) return [kPoint.level, 0, 0, 0];
  const wall = (kWallAt - vehicle.position[0]) / Math.cos(yaw);
  if (wall > 0 && Math.abs(wall - range) < 0.25) return [-45 - 20 * Math.log10(range) + 6 * noise, 1, 1, 0.01];
  if (wall > 0 && range > wall) return null;
  const grazing = kBedBelow / range;
  if (grazing > 0.35 || range < kBedBelow) return null;
  return [-52 - 30 * Math.log10(range) + 8 * noise, 2, 2, -Math.asin(grazing)];
}

function makeTables(sonar, vehicle, headAngle, withNoise) {
  const { beams, bins } = sonar;
  const cells = beams * bins;
  const tables = { level: new Uint16Array(cells), instance: new Int32Array(cells).fill(-1), material: new Int32Array(cells).fill(-1), elevation: new Float32Array(cells).fill(NaN), shadow: new Uint8Array(cells), multipath: new Uint8Array(cells) };
  const binLength = (sonar.max_range - sonar.min_range) / bins;
  const beamWidth = ((sonar.azimuth_aperture / beams) * Math.PI) / 180;
  for (let bin = 0; bin < bins; ++bin) {
    const range = sonar.min_range + (bin + 0.5) * binLength;
    for (let beam = 0; beam < beams; ++beam) {
      const azimuth = (sonar.azimuths[beam] * Math.PI) / 180 + headAngle;
      const i = bin * beams + beam;
      const noise = withNoise ? Math.log10(-Math.log(1 - Math.random()) + 1e-3) : 0;
      const found = echo(sonar, vehicle, azimuth, range, binLength, beamWidth, noise);
      const level = found ? found[0] : withNoise ? -105 + 6 * noise : null;
      tables.shadow[i] = found || range < 8 ? 0 : 255;
      if (level === null) continue;
      tables.level[i] = Math.round((level + 400) * 100);
      if (!found) continue;
      [, tables.instance[i], tables.material[i], tables.elevation[i]] = found;
      tables.multipath[i] = found[1] === 1 ? 2 : 1;
    }
  }
  return tables;
}

/** Binary message of one ping. Without noise, tables that `made` has are not made again. */
export function makePing(sonar, number, vehicle, headAngle, wanted, withNoise, made) {
  const key = JSON.stringify([sonar.name, sonar.beams, sonar.bins, sonar.max_range, vehicle, headAngle]);
  const make = kTables[sonar.type] ?? makeTables;
  const tables = (!withNoise && made.get(key)) || make(sonar, vehicle, headAngle, withNoise);
  if (!made.has(key)) made.clear();
  made.set(key, tables);
  const orientation = [Math.cos(vehicle.yaw / 2), 0, 0, Math.sin(vehicle.yaw / 2)];
  const pose = { position: vehicle.position, orientation };
  // The housing of a multibeam looks down: its x axis.
  const [w, , , z] = orientation;
  const beams = sonar.type === "mbes" ? { position: vehicle.position, orientation: [w, -z, w, z].map((part) => part * Math.SQRT1_2) } : pose;
  const header = { sonar: sonar.name, number, time: number * sonar.period, beams: sonar.beams, bins: sonar.bins, ...beams, vehicle: pose, head_angle: (headAngle * 180) / Math.PI, ms: 7.5 };
  return encode(1, header, Object.entries(tables).filter(([name]) => wanted.includes(name)));
}

const kTypes = { Uint8Array: "uint8", Uint16Array: "uint16", Int32Array: "int32", Float32Array: "float32" };

function encode(kind, header, tables) {
  let offset = 0;
  const described = tables.map(([name, table]) => {
    const entry = { name, type: kTypes[table.constructor.name], offset };
    offset += Math.ceil(table.byteLength / 4) * 4;
    return entry;
  });
  const { message, start } = frame(kind, kind === 1 ? { ...header, tables: described } : header, offset);
  tables.forEach(([, table], i) => Buffer.from(table.buffer).copy(message, start + described[i].offset));
  return message;
}

function frame(kind, header, bytes) {
  let text = Buffer.from(JSON.stringify(header));
  text = Buffer.concat([text, Buffer.alloc((4 - (text.length % 4)) % 4, 0x20)]);
  const message = Buffer.alloc(8 + text.length + bytes);
  message.writeUInt32LE(kind, 0);
  message.writeUInt32LE(text.length, 4);
  text.copy(message, 8);
  return { message, start: 8 + text.length };
}

/** Binary message of the scene: a buoy at the point, a wall and a bed. */
export function makeScene() {
  const vertices = new Float32Array([-0.3, -0.3, -0.3, 0.3, -0.3, -0.3, 0, 0.3, -0.3, 0, 0, 0.4, kWallAt, -20, -3, kWallAt, 20, -3, kWallAt, 20, 3, kWallAt, -20, 3, -30, -30, -3, 30, -30, -3, 30, 30, -3, -30, 30, -3]);
  const triangles = new Uint32Array([0, 1, 3, 1, 2, 3, 2, 0, 3, 0, 2, 1, 0, 1, 2, 0, 2, 3, 0, 1, 2, 0, 2, 3]);
  const identity = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1];
  const at = [1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, ...kPoint.position, 1];
  const start = vertices.byteLength;
  const objects = [
    { name: kHostile, material: "steel", colour: [0.9, 0.3, 0.2], matrix: at, vertices: { offset: 0, count: 4 }, triangles: { offset: start, count: 4 } },
    { name: "wall", material: "concrete", colour: [0.6, 0.6, 0.65], matrix: identity, vertices: { offset: 48, count: 4 }, triangles: { offset: start + 48, count: 2 } },
    { name: "bed", material: "sand", colour: [0.65, 0.55, 0.4], matrix: identity, vertices: { offset: 96, count: 4 }, triangles: { offset: start + 72, count: 2 } },
  ];
  const { message, start: data } = frame(2, { objects, sonars: [], points: [kPoint.position] }, vertices.byteLength + triangles.byteLength);
  Buffer.from(vertices.buffer).copy(message, data);
  Buffer.from(triangles.buffer).copy(message, data + vertices.byteLength);
  return message;
}
