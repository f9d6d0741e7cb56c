// shapes.js -- geometry of what the scene itself does not hold: a vehicle, the insonified sector, echoes and the fan.

import { levelDb } from "../link/decode.js";
import { binRange } from "../sonar.js";
import { sonarPoint } from "../geometry.js";

/** An underwater vehicle of boxes, 0.8 m long, x ahead: [{ colour, vertices }] as triangles. */
export function vehicleParts() {
  const boxes = [
    { colour: [0.98, 0.72, 0.1], from: [-0.4, -0.24, 0.08], to: [0.34, 0.24, 0.22] },
    { colour: [0.16, 0.19, 0.22], from: [-0.36, -0.2, -0.16], to: [0.3, 0.2, 0.08] },
    { colour: [0.09, 0.1, 0.12], from: [-0.38, -0.26, -0.24], to: [0.38, -0.2, -0.18] },
    { colour: [0.09, 0.1, 0.12], from: [-0.38, 0.2, -0.24], to: [0.38, 0.26, -0.18] },
    { colour: [0.25, 0.75, 0.95], from: [0.3, -0.07, -0.08], to: [0.4, 0.07, 0.06] },
    { colour: [0.09, 0.1, 0.12], from: [-0.48, -0.2, -0.06], to: [-0.36, -0.08, 0.06] },
    { colour: [0.09, 0.1, 0.12], from: [-0.48, 0.08, -0.06], to: [-0.36, 0.2, 0.06] },
  ];
  return boxes.map(({ colour, from, to }) => ({ colour, vertices: boxTriangles(from, to) }));
}

function boxTriangles(from, to) {
  const corner = (i) => [0, 1, 2].map((axis) => ((i >> axis) & 1 ? to[axis] : from[axis]));
  const faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
  return new Float32Array(faces.flatMap(([a, b, c, d]) => [a, b, c, a, c, d].flatMap(corner)));
}

/** Lines around the insonified sector, and the triangles of its upper and lower face, in the sonar's frame. */
export function sectorShape(sonar) {
  const [lower, upper] = [-0.5, 0.5].map((part) => sonar.elevationCentre + part * sonar.elevationAperture);
  const half = sonar.azimuthAperture / 2;
  const sectors = sonar.product.sides
    ? sonar.beamAzimuths.map((azimuth) => [azimuth + half, azimuth - half])
    : [[sonar.ports[0], sonar.starboards.at(-1)]];
  const lines = [];
  const faces = [];
  for (const [port, starboard] of sectors) {
    const steps = Math.max(2, Math.ceil((port - starboard) / 0.06));
    const azimuth = (i) => port + ((starboard - port) * i) / steps;
    for (const elevation of [lower, upper]) {
      for (let i = 0; i < steps; ++i) {
        const [a, b] = [sonarPoint(sonar.max_range, azimuth(i), elevation), sonarPoint(sonar.max_range, azimuth(i + 1), elevation)];
        lines.push(...a, ...b);
        faces.push(0, 0, 0, ...a, ...b);
      }
      for (const edge of [port, starboard]) lines.push(0, 0, 0, ...sonarPoint(sonar.max_range, edge, elevation));
    }
    for (const edge of [port, starboard]) {
      lines.push(...sonarPoint(sonar.max_range, edge, lower), ...sonarPoint(sonar.max_range, edge, upper));
    }
  }
  return { lines: new Float32Array(lines), faces: new Float32Array(faces) };
}

/** Crosses at points, three lines each, `reach` [m] to either side. */
export function crossLines(points, reach) {
  const ends = (point, axis) => [-reach, reach].flatMap((shift) => point.map((x, i) => (i === axis ? x + shift : x)));
  return new Float32Array(points.flatMap((point) => [0, 1, 2].flatMap((axis) => ends(point, axis))));
}

/** The fan as triangles of x, y, beam, bin; a side-scan sonar has none. */
export function fanShape(sonar) {
  const corners = [];
  if (sonar.product.sides) return new Float32Array(corners);
  for (let beam = 0; beam < sonar.beams; ++beam) {
    const at = (azimuth, range, u) => {
      const [x, y] = sonarPoint(range, azimuth);
      return [x, y, u, range === sonar.min_range ? 0 : sonar.bins];
    };
    const [port, starboard] = [sonar.ports[beam], sonar.starboards[beam]];
    const quad = [at(port, sonar.min_range, beam), at(port, sonar.max_range, beam), at(starboard, sonar.max_range, beam + 0.999), at(starboard, sonar.min_range, beam + 0.999)];
    corners.push(...quad[0], ...quad[1], ...quad[2], ...quad[0], ...quad[2], ...quad[3]);
  }
  return new Float32Array(corners);
}

const kMostEchoes = 30_000;
const kWeakest = 0.2;  // brightness below which an echo is not drawn

/** Echoes with a known elevation, as x, y, z in the sonar's frame and brightness 0 to 1. */
export function echoPoints(sonar, ping, store) {
  const { level, elevation } = ping.tables;
  const points = new Float32Array(4 * kMostEchoes);
  if (!elevation) return { points, count: 0 };
  const [low, gain, tvg] = [store.get("low"), store.get("gain"), store.get("tvg")];
  const span = Math.max(store.get("high") - low, 0.1);
  const sines = sonar.beamAzimuths.map(Math.sin);
  const cosines = sonar.beamAzimuths.map(Math.cos);
  const stride = Math.ceil(level.length / (5 * kMostEchoes));
  let count = 0;
  for (let bin = 0; bin < ping.bins; ++bin) {
    const range = binRange(sonar, bin);
    const raised = gain + tvg * Math.log10(Math.max(range, 0.01)) - low;
    for (let beam = bin % stride; beam < ping.beams; beam += stride) {
      const i = bin * ping.beams + beam;
      const up = elevation[i];
      if (level[i] === 0 || Number.isNaN(up) || count >= kMostEchoes) continue;
      const value = Math.min(1, (levelDb(level[i]) + raised) / span);
      if (value < kWeakest) continue;
      const flat = range * Math.cos(up);
      points[4 * count] = flat * cosines[beam];
      points[4 * count + 1] = flat * sines[beam];
      points[4 * count + 2] = range * Math.sin(up);
      points[4 * count + 3] = value;
      ++count;
    }
  }
  return { points, count };
}
